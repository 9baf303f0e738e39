#pragma once

#include <string>

#include "verlet.h"

namespace LAMMPS_NS {
class Variable;
}

namespace granulaw::plugin::plan {

/// LIGGGHTS's own integrator, taking the first and the last step of a run.
class DryRun final : public LAMMPS_NS::Verlet
{
 public:
  explicit DryRun(LAMMPS_NS::LAMMPS* lmp) : Verlet(lmp, 0, nullptr) {}
  void run(int steps) override;
};

/// Puts a DryRun in the place of another integrator, and nothing in that of fixes and computes which need
/// contacts.
void replace_styles(LAMMPS_NS::LAMMPS* lmp);

/// Puts styles without forces in the place of all of `pair_style gran` and `fix wall/gran`.
void replace_contacts();

/// The value that only a run has in the condition of an `if`: of a compute, a fix, a thermo keyword, also by a
/// variable that is computed from it. Empty: it has none, or the line is no `if`.
std::string run_value_of_branch(LAMMPS_NS::Variable* variables, const std::string& line);

}  // namespace granulaw::plugin::plan
