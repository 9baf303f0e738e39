#include "liggghts_plugin/run/runaway.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"

namespace granulaw::plugin {

namespace {

constexpr const char* runaway_style = "granulaw/runaway";
constexpr int check_every = 100;  // steps

LAMMPS_NS::Fix* make_runaway(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg)
{
  return new FixRunaway(lmp, narg, arg);
}

bool is_finite(const double* v)
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

}  // namespace

void provide_runaway_fix(LAMMPS_NS::LAMMPS* lmp)
{
  register_fix_style(lmp, runaway_style, &make_runaway);
  if (!lmp->domain->box_exist || lmp->modify->find_fix_style_strict(runaway_style, 0)) return;
  const char* arg[] = {"granulaw_runaway", "all", runaway_style};
  lmp->modify->add_fix(3, const_cast<char**>(arg));
}

FixRunaway::FixRunaway(LAMMPS_NS::LAMMPS* lmp_, int narg, char** arg) : Fix(lmp_, narg, arg)
{
  if (narg > 3)
    stop_all(lmp, fmt::format("fix {} granulaw/runaway: found '{}', takes no arguments", id, arg[3]));
  nevery = check_every;
}

int FixRunaway::setmask()
{
  return LAMMPS_NS::FixConst::PRE_EXCHANGE | LAMMPS_NS::FixConst::END_OF_STEP;
}

void FixRunaway::check_sizes() const
{
  for (const auto& [command, types] : Session::of(lmp)->one_size)
    for (int i = 0; i < atom->nlocal; ++i) {
      const auto found = types.find(atom->type[i]);
      if (found != types.end()) try {
          found->second(atom->radius[i]);
        } catch (const Error& failure) {
          stop_one(lmp, fmt::format("step {}: particle {}: {}", update->ntimestep, atom->tag[i], failure.what()));
        }
    }
}

void FixRunaway::check() const
{
  check_sizes();
  if (!moves_particles(*modify)) return;  // they may have any velocity
  const double dt = update->dt;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double *x = atom->x[i], *v = atom->v[i];
    const double step2 = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * dt * dt;
    const double radius = atom->radius[i];
    // a force that is no number shows in the velocity half a step later (and new particles have no force yet)
    if (step2 <= radius * radius && is_finite(x)) [[likely]]
      continue;
    if (is_finite(v) && is_finite(x))
      stop_one(lmp,
               fmt::format("step {}: particle {} at ({:.6g}, {:.6g}, {:.6g}) moves {:.4g} m/s, {:.3g} of "
                           "its radii in one time step: it has run away; take a smaller timestep, or look "
                           "for particles that overlap at the start",
                           update->ntimestep, atom->tag[i], x[0], x[1], x[2], std::sqrt(step2) / dt,
                           std::sqrt(step2) / radius));
    stop_one(lmp, fmt::format(
                      "step {}: particle {} is not a number: position ({:.6g}, {:.6g}, {:.6g}) m, velocity "
                      "({:.6g}, {:.6g}, {:.6g}) m/s",
                      update->ntimestep, atom->tag[i], x[0], x[1], x[2], v[0], v[1], v[2]));
  }
}

}  // namespace granulaw::plugin
