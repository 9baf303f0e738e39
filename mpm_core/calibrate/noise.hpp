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

}  // namespace granulaw
