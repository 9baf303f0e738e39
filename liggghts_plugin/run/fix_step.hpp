#pragma once

#include <memory>

#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// `fix granulaw_step all granulaw/step`: calls Session::before_forces in each step. Contacts depend on it; the statistics
/// (fix granulaw) may go.
class FixStep : public LAMMPS_NS::Fix
{
 public:
  FixStep(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  int setmask() override { return LAMMPS_NS::FixConst::PRE_FORCE; }
  void setup_pre_force(int) override { pre_force(0); }
  void pre_force(int) override
  {
    for (const Session::Work& one : session_->before_forces) one(lmp);
  }

 private:
  std::shared_ptr<Session> session_;
};

/// Registers the fix style; adds the fix if the simulation box exists and there is none yet.
void provide_step_fix(LAMMPS_NS::LAMMPS* lmp);
/// When a wall begins a run LIGGGHTS has its list of the fixes of each step: where the fix is missing the run ends with a sentence.
void require_step_fix(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin
