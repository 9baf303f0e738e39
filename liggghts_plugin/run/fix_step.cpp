#include "liggghts_plugin/run/fix_step.hpp"

#include <fmt/format.h>

#include "liggghts_plugin/engine/fix_style.hpp"

namespace granulaw::plugin {

namespace {

constexpr const char* step_style = "granulaw/step";

LAMMPS_NS::Fix* make_step(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg)
{
  return new FixStep(lmp, narg, arg);
}

}  // namespace

FixStep::FixStep(LAMMPS_NS::LAMMPS* lmp_, int narg, char** arg) : Fix(lmp_, narg, arg), session_(Session::of(lmp_))
{
  if (narg > 3) stop_all(lmp, fmt::format("fix {} granulaw/step: found '{}', takes no arguments", id, arg[3]));
}

void provide_step_fix(LAMMPS_NS::LAMMPS* lmp)
{
  register_fix_style(lmp, step_style, &make_step);
  if (!lmp->domain->box_exist || lmp->modify->find_fix_style_strict(step_style, 0)) return;
  const char* arg[] = {"granulaw_step", "all", step_style};
  lmp->modify->add_fix(3, const_cast<char**>(arg));
}

void require_step_fix(LAMMPS_NS::LAMMPS* lmp)
{
  if (!lmp->modify->find_fix_style_strict(step_style, 0))
    stop_all(lmp, "fix granulaw_step is missing, without which contacts do not follow their bodies: leave out 'unfix granulaw_step'");
}

}  // namespace granulaw::plugin
