#include <dlfcn.h>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"
#include "liggghts_plugin/engine/shapes.hpp"
#include "liggghts_plugin/run/heat_conduction.hpp"

/// Virtual functions of LIGGGHTS's AtomVecSuperquadric; null where there is no such class.
extern "C" [[gnu::weak]] const char superquadric_functions[] __asm__("_ZTVN9LAMMPS_NS19AtomVecSuperquadricE");

namespace granulaw::plugin {

namespace {

constexpr const char* built_for = "LIGGGHTS-PUBLIC 3.8.0";

constexpr const char* built_shapes =
    superquadrics_built ? "with superquadrics" : "without superquadrics (Debian's liggghts)";

[[noreturn]] void refuse(LAMMPS_NS::LAMMPS* lmp, const std::string& why)
{
  stop_all(lmp, fmt::format("granulaw was built for {} {}: {}", built_for, built_shapes, why));
}

/// True if the LIGGGHTS that made `parent`, an object with virtual functions, has superquadrics: the class is
/// then in the file that has the parent's own functions (a second LIGGGHTS may have been loaded with us).
bool has_superquadrics(const void* parent)
{
  Dl_info of_class{}, of_parent{};
  if (!superquadric_functions || !dladdr(superquadric_functions, &of_class)) return false;
  return dladdr(*static_cast<void* const*>(parent), &of_parent) && of_class.dli_fbase == of_parent.dli_fbase;
}

}  // namespace

void check_liggghts(LAMMPS_NS::LAMMPS* lmp, const void* parent, std::size_t parent_size, const char* what)
{
  const char* version = lmp->universe && lmp->universe->version ? lmp->universe->version : "unknown";
  if (!std::strstr(version, built_for)) refuse(lmp, fmt::format("this is '{}'", version));
  // Builds with superquadrics lay out their structures differently.
  if (has_superquadrics(parent) != superquadrics_built)
    refuse(lmp, superquadrics_built ? "this LIGGGHTS was built without superquadrics"
                                    : "this LIGGGHTS was built with superquadrics");
  // Allocators round up, each in its own way: an object of the expected size shows by how much. glibc's may
  // leave 24 bytes more to the one that it finds first.
  const std::size_t block = malloc_usable_size(const_cast<void*>(parent));
  const std::unique_ptr<char[]> alike(new char[parent_size]);
  const std::size_t expected = std::max(malloc_usable_size(alike.get()), parent_size) + 24;
  if (block < parent_size || block > expected)
    refuse(lmp, fmt::format("its {} takes {} bytes, {} expected", what, block, parent_size));
}

namespace {

/// A wall takes what its own command leaves open from the pair style: from the one that stands before it.
void check_inherited(const Setup& setup)
{
  const Session& session = *setup.session;
  if (!setup.wall || !session.pair_options) return;
  Options now = setup.own;
  now.inherit(*session.pair_options);
  if (now != setup.options || setup.energy != (session.energy != nullptr) ||
      setup.contact_map != session.contact_map)
    fail(setup.where,
         "it stands before the pair_style whose words it should take (energy, contactMap, stretch, damping, "
         "law, "
         "materials): put it behind");
}

/// Histories of another meaning would be read as what they are not, unless their number differs.
void check_restarted(const Setup& setup)
{
  std::map<std::string, HistoryMeaning>& restarted = setup.session->restarted;
  const auto found = restarted.find(setup.command());
  if (found == restarted.end()) return;
  const HistoryMeaning& written = found->second;
  if (written != setup.meaning)
    fail(setup.where,
         "the restart file was written with other models or words, whose contact histories mean something else",
         describe(setup.meaning), describe(written));
  restarted.erase(found);
}

}  // namespace

void check_run(LAMMPS_NS::LAMMPS* lmp, const Setup& setup)
{
  constexpr int multi = 2;  // Neighbor::style of `neighbor ... multi`
  if (lmp->neighbor->style == multi)
    fail(setup.where,
         "'neighbor ... multi' lets spheres of unlike size pass through each other: use 'neighbor ... bin'");
  check_inherited(setup);
  check_heat(lmp, setup);
  check_restarted(setup);
  const bool respa =
      lmp->update->integrate_style && std::strncmp(lmp->update->integrate_style, "respa", 5) == 0;
  if (respa && setup.wall)
    fail(setup.where,
         "'run_style respa' of this LIGGGHTS does not call fix wall/gran, of no model: spheres would fall "
         "through the wall; use 'run_style verlet'");
  if (respa && setup.energy)
    fail(setup.where, "'energy on' books one force a step: it needs 'run_style verlet', not respa");
}

}  // namespace granulaw::plugin
