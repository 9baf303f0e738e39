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

/// True of an `if` whose condition contains a value that only a run has: of a compute, a fix, a thermo
/// keyword, or of a variable that is computed from one.
bool branches_on_run(LAMMPS_NS::Variable* variables, const std::string& line);

}  // namespace granulaw::plugin::plan
