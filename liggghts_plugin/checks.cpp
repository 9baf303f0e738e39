#include <dlfcn.h>
#include <fmt/format.h>
#include <malloc.h>

#include <cstring>

#include "liggghts_plugin/liggghts.hpp"
#include "liggghts_plugin/session.hpp"
#include "liggghts_plugin/shapes.hpp"

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

/// Whether the LIGGGHTS that made `parent`, an object with virtual functions, has superquadrics: the class is
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
  // malloc rounds up to 16 bytes and keeps a word for itself: the block is at most 24 bytes larger than
  // asked.
  const std::size_t block = malloc_usable_size(const_cast<void*>(parent));
  if (block < parent_size || block > parent_size + 24)
    refuse(lmp, fmt::format("its {} takes {} bytes, {} expected", what, block, parent_size));
}

}  // namespace granulaw::plugin
