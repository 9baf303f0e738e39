// `confinement`: what it refuses, and the fix that does it.
#include <fmt/format.h>

#include <cstring>

#include "base/error.hpp"
#include "liggghts_plugin/confine/fix_confined.hpp"
#include "liggghts_plugin/contact/contact_pieces.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"

namespace granulaw::plugin {

bool says_confinement(const Options& options)
{
  const auto& words = options.own_words("confinement");
  return !words.empty() && words[0] != "off";
}

void provide_confinement(LAMMPS_NS::LAMMPS* lmp, const Options& options)
{
  if (!says_confinement(options)) return;
  provide_fix<FixConfined>(lmp, "granulaw_confined", FixConfined::style_name);
  if (auto* const fix = dynamic_cast<FixConfined*>(Session::of(lmp)->confinement); fix && !is_planning) fix->widen_lists();
}

void check_confinement(LAMMPS_NS::LAMMPS* lmp, const Setup& setup)
{
  if (!says_confinement(setup.options)) return;
  const auto refuse = [&](const std::string& why) { fail(setup.where, fmt::format("'confinement {}' {}", setup.options.own_words("confinement")[0], why)); };
  const ModelIds ids = ModelIds::of(setup.meaning.combination);
  if (ids.superquadric()) refuse("is for spheres, not for 'surface superquadric'");
  if (ids.cohesion != cm::COHESION_OFF) refuse("knows no cohesion: leave out 'cohesion'");
  if (ids.rolling != cm::ROLLING_OFF) refuse("knows no rolling model: leave out 'rolling_friction'; contacts of a pressed particle hold it by their faces");
  if (ids.tangential == cm::TANGENTIAL_NO_HISTORY) refuse("needs 'tangential history', 'plastic' or 'off': its tangential force is a spring");
  const Options& options = setup.options;
  if (options.deformable_wall) refuse("needs rigid walls: leave out 'wall deformable'");
  if (options.stretch.value_or(1.0) != 1.0) refuse("and 'stretch' exclude each other: faces of a stretched particle would meet too late");
  if (options.body_compliance.value_or(false)) refuse("and 'bodyCompliance on' exclude each other: a sphere's own deformation is in the law");
  if (options.contact_map) refuse("and 'contactMap on' exclude each other: contacts are not counted as impacts");
  const LAMMPS_NS::Domain& domain = *lmp->domain;
  if (domain.triclinic) refuse("is for boxes with right angles: a tilted one may flip, and contacts would not find their neighbours");
  for (int f = 0; f < lmp->modify->nfix; ++f) {
    const LAMMPS_NS::Fix& fix = *lmp->modify->fix[f];
    if (std::strncmp(fix.style, "multisphere", 11) == 0 || std::strncmp(fix.style, "rigid", 5) == 0)
      refuse(fmt::format("is for single spheres, not for the bodies of fix {} {}", fix.id, fix.style));
    if (std::strncmp(fix.style, "heat/gran", 9) == 0)
      refuse(fmt::format("and fix {} {} exclude each other: heat would pass through circles of overlap, not through the faces", fix.id, fix.style));
    const auto* wall = dynamic_cast<const FixWallGran*>(&fix);
    if (wall && !setup.session->styles.contains(wall))
      refuse(fmt::format("needs walls of this model: fix {} wall/gran is of another, and its forces would not press the particles", fix.id));
  }
  if (lmp->update->integrate_style && std::strncmp(lmp->update->integrate_style, "respa", 5) == 0) refuse("needs 'run_style verlet'");
}

}  // namespace granulaw::plugin
