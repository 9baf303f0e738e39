#pragma once

#include "calibrate/measurement.hpp"

namespace granulaw {

/// Scatter of a curve of force whose file states no standard deviation: sd^2 = constant^2 + (share F)^2.
struct ForceScatter
{
  double constant = 0;  ///< N
  double share = 0;     ///< of the force
  double at(double force) const;
};

/// From the curve alone, no model: each force against the cubic through its two neighbours on either side on
/// the same branch (after Gasser, Sroka and Jennen-Steinmetz, Biometrika 73, 1986); of constant and share the
/// likeliest.
ForceScatter scatter_of(const Measurement& curve);

/// Fills in the standard deviations that are not stated, as the kind does: of a curve its scatter, of other
/// kinds `relative_sd` of the value. Throws Error where a value is over Column::most by more than its noise.
void complete_standard_deviations(Measurement& measurement, double relative_sd);

}  // namespace granulaw
