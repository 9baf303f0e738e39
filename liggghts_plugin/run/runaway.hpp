#pragma once

#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// `fix granulaw_runaway all granulaw/runaway`: ends the run with one sentence when a particle's position,
/// velocity or force is not a number, when it has run away, or when its radius is no longer that of its
/// rate-dependent law. LIGGGHTS itself drops such a particle without a word under `thermo_modify lost ignore`, and
/// its neighbour search never gives a NaN to a contact model.
///
/// A particle has run away that moves further than its own radius in one time step and got there by a kick: its
/// speed grew by more than its force explains, or a contact of its type was too stiff for the step. One that
/// is carried as fast, with all around it, has not.
///
/// Looks before particles change rank or leave the box (each rebuild of the neighbour lists, the set-up of a
/// run included) and at every 100th step, so that its cost does not show.
class FixRunaway : public LAMMPS_NS::Fix
{
 public:
  FixRunaway(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  int setmask() override;
  void setup_pre_exchange() override { check(); }
  void pre_exchange() override { check(); }
  void end_of_step() override { check(); }
  void post_run() override { check(); }

 private:
  void check();
  void check_sizes() const;
  bool was_kicked(int particle, double speed_before) const;

  LAMMPS_NS::bigint last_check_ = -1;
};

/// Registers the fix style; adds the fix if the simulation box exists and there is none yet.
void provide_runaway_fix(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin
