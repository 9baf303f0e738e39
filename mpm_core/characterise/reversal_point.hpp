#pragma once

#include <algorithm>
#include <cmath>

#include "contact/unloading.hpp"

namespace granulaw {

/// A reversal and its slopes by a coordinate z in which the law is tabulated.
struct ReversalPoint
{
  double log_slope;                 ///< d ln x/dz
  double force_exponent;            ///< d ln F/d ln x of loading
  double mean_force;                ///< W_L/(F x)
  double loss, loss_slope;          ///< d = -ln(W_u/W_L), dd/dz
  double residual, residual_slope;  ///< r = -ln(1 - delta_r/delta_m), dr/dz

  /// Mean unloading force over F, W_u/(F (delta_m - delta_r)), and its slope:
  /// d ln w = (F x/W_L - d ln F/d ln x - 1) d ln x - dd + dr.
  double work() const { return mean_force * std::exp(residual - loss); }
  double work_slope() const
  {
    return work() * ((1 / mean_force - force_exponent - 1) * log_slope - loss_slope + residual_slope);
  }
  /// The mean of a rising unloading lies between that of the steepest and that of the flattest shape. What
  /// has to return less or more over its length has the length that fits: from the residual overlap.
  void fit_length(const UnloadingShape& steepest, const UnloadingShape& flattest)
  {
    const double wanted = std::clamp(work(), steepest.work(), flattest.work());
    if (wanted == work()) return;
    residual = std::log(wanted / mean_force) + loss;
    residual_slope = loss_slope - (1 / mean_force - force_exponent - 1) * log_slope;
    if (residual < 0) residual = residual_slope = 0;
  }
  void fit_length()
  {
    fit_length({UnloadingShape::largest_exponent(0), 0},
               {UnloadingShape::least_exponent, UnloadingShape::largest_hertz_share});
  }
  void fit_length(double hertz_share)
  {
    fit_length({UnloadingShape::largest_exponent(hertz_share), hertz_share},
               {UnloadingShape::least_exponent, hertz_share});
  }
  /// d ln F/d ln u with which it unloads as stiffly as it loads: the least exponent.
  double least_exponent() const
  {
    return std::max(UnloadingShape::least_exponent, std::exp(-residual) * force_exponent);
  }
};

}  // namespace granulaw
