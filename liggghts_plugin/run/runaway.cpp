#include "liggghts_plugin/run/runaway.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"
#include "liggghts_plugin/particles/particle_columns.hpp"

namespace granulaw::plugin {

namespace {

constexpr const char* runaway_style = "granulaw/runaway";
constexpr int check_every = 100;  // steps

/// Speed at the last check, and 1: a particle that is new has 0.
constexpr ParticleColumns::Spec speeds{.name = "granulaw_speed", .columns = 2, .restart = false, .to_ghosts = false, .from_ghosts = false};

/// (dt/period)^2 (2 pi)^2: of a contact within twelve steps of its period a kick ends within half an overlap a step.
constexpr double resolved = 0.25;

bool is_finite(const double* v)
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

}  // namespace

void provide_runaway_fix(LAMMPS_NS::LAMMPS* lmp)
{
  if (provide_fix<FixRunaway>(lmp, "granulaw_runaway", runaway_style)) ParticleColumns::provide(lmp, speeds);
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

bool FixRunaway::was_kicked(int i, double speed_before) const
{
  const double dt = update->dt, *v = atom->v[i], *f = atom->f[i];
  const double steps = static_cast<double>(update->ntimestep - last_check_);
  const double force = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  const double growth = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) - speed_before;
  // twice the way that the force of now goes: one that fades, as a fluid's drag, was larger before
  if (speed_before >= 0 && growth * dt > atom->radius[i] && growth > 2 * steps * dt * force / atom->rmass[i]) return true;
  for (const auto& [key, counts] : Session::of(lmp)->statistics.pairs) {
    const bool is_of_type = key.i == atom->type[i] || (key.kind == PairKey::particles && key.j == atom->type[i]);
    if (is_of_type && counts.frequency2 * dt * dt > resolved) return true;
  }
  return false;
}

void FixRunaway::check()
{
  check_sizes();
  if (!moves_particles(*modify)) return;  // they may have any velocity
  const double dt = update->dt;
  const ParticleColumns columns = ParticleColumns::find(lmp, speeds);
  for (int i = 0; i < atom->nlocal; ++i) {
    const double *x = atom->x[i], *v = atom->v[i];
    const double step2 = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * dt * dt;
    const double radius = atom->radius[i];
    double before = -1;
    if (columns) {
      double* kept = columns.rows()[i];
      if (kept[1] != 0) before = kept[0];
      kept[0] = std::sqrt(step2) / dt, kept[1] = 1;
    }
    // a force that is no number shows in the velocity half a step later (and new particles have no force yet)
    if (step2 <= radius * radius && is_finite(x)) [[likely]]
      continue;
    if (is_finite(v) && is_finite(x) && !was_kicked(i, before)) continue;
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
  last_check_ = update->ntimestep;
}

}  // namespace granulaw::plugin
