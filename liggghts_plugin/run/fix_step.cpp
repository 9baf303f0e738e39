#include "liggghts_plugin/run/fix_step.hpp"

#include <fmt/format.h>

#include "liggghts_plugin/engine/fix_style.hpp"

namespace granulaw::plugin {

namespace {

constexpr const char* step_style = "granulaw/step";

}  // namespace

FixStep::FixStep(LAMMPS_NS::LAMMPS* lmp_, int narg, char** arg) : Fix(lmp_, narg, arg), session_(Session::of(lmp_))
{
  if (narg > 3) stop_all(lmp, fmt::format("fix {} granulaw/step: found '{}', takes no arguments", id, arg[3]));
}

void provide_step_fix(LAMMPS_NS::LAMMPS* lmp) { provide_fix<FixStep>(lmp, "granulaw_step", step_style); }

void require_step_fix(LAMMPS_NS::LAMMPS* lmp)
{
  if (!lmp->modify->find_fix_style_strict(step_style, 0))
    stop_all(lmp, "fix granulaw_step is missing, without which contacts do not follow their bodies: leave out 'unfix granulaw_step'");
}

}  // namespace granulaw::plugin
