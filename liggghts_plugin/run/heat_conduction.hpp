#pragma once

#include "fix_heat_gran_conduction.h"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

class Session;

/// LIGGGHTS's fix heat/gran/conduction; with `heatArea law` in the pair style heat passes through the circle
/// of the law's own contact radius, else through that of the geometric overlap, as LIGGGHTS has it. The
/// formula of the heat flux stays LIGGGHTS's: 4 k_i k_j/(k_i + k_j) sqrt(area) (T_j - T_i).
class FixHeatConduction : public LAMMPS_NS::FixHeatGranCond
{
 public:
  using FixHeatGranCond::FixHeatGranCond;

  void init() override;
  void post_force(int vflag) override;
  void cpl_evaluate(LAMMPS_NS::ComputePairGranLocal* caller) override;

 private:
  bool by_law() const;
  /// `list`: only report to compute pair/gran/local.
  void conduct(LAMMPS_NS::ComputePairGranLocal* list);
};

/// From now on the deck's fix heat/gran and heat/gran/conduction are FixHeatConduction.
void provide_heat_conduction(LAMMPS_NS::LAMMPS* lmp);
/// Throws Error if heat is to pass through the law's contact radius and a fix or wall of the deck cannot
/// know.
void check_heat(LAMMPS_NS::LAMMPS* lmp, const struct Setup& setup);

}  // namespace granulaw::plugin
