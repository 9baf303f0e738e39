#pragma once

#include "base/progress.hpp"
#include "calibrate/calibrate.hpp"
#include "contact/curve.hpp"

namespace granulaw {

/// A fit of hardening that the atlas does not know, and what it took.
struct CalibrationByRuns
{
  Calibration calibration;
  int laws = 0;  ///< made by runs
  /// Relative difference between the last run and the fit: of force, and of e.
  double miss_force = 0, miss_restitution = 0;
};

/// The slow law of a material on a rigid flat to this overlap/R, by runs of the solver.
using LawByRuns = std::function<Curve(const std::string& name, const Material& material, double depth,
                                      const Progress& progress)>;

/// Fits a hardening law that is not linear, by space mapping (Bandler et al., IEEE Trans. Microw. Theory
/// Tech. 42, 1994): stand_in() is the coarse model. The law of the material that it finds is made by runs
/// of the solver; its departure from the coarse one is added to all materials, and the fit goes on. It
/// ends where the law by runs is within `close_enough` of what was fitted; after `most_laws` in any case.
CalibrationByRuns calibrate_by_runs(CalibrationProblem& problem, const LawByRuns& law_by_runs,
                                    const Progress& progress = {});

inline constexpr double close_enough = 0.003;  ///< relative: the error of one run of 24 cells
inline constexpr int most_laws = 4;

}  // namespace granulaw
