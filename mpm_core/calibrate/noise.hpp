#pragma once

#include "calibrate/measurement.hpp"

namespace granulaw {

/// Scatter of a curve of force whose file states no standard deviation: sd^2 = constant^2 + (share F)^2.
struct ForceScatter
{
  double constant = 0;     ///< N
  double share = 0;        ///< of the force
  bool averages = false;   ///< rows are independent: the mean of n of them has 1/sqrt(n) of it
  double at(double force, int rows = 1) const;
};

/// From the curve alone, no model: each force against the cubic through its two neighbours on either side on
/// the same branch (after Gasser, Sroka and Jennen-Steinmetz, Biometrika 73, 1986); of constant, share and
/// averaging the likeliest.
ForceScatter scatter_of(const Measurement& curve);
/// The same of data that are means of rows: scatter of a row, were rows independent.
ForceScatter scatter_of_means(const Measurement& means);

}  // namespace granulaw
