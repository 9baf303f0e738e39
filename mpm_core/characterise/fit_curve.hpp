#pragma once

#include <span>
#include <vector>

#include "law/contact_curve.hpp"
#include "solver/trace.hpp"

namespace granulaw {

/// One dimensionless press (R = E* = rho = 1): virgin loading to `depth`, then complete unloading.
struct Pressing
{
  struct Sample
  {
    double x, force, radius;
  };                            ///< overlap/R; F/(4/3 E* R^2); a/R
  std::vector<Sample> loading;  ///< ascending x
  double depth = 0;             ///< x_m, largest overlap/R
  double residual = 0;          ///< overlap/R at which the force ended
  double work_ratio = 0;        ///< work given back/work put in, W_u/W_L = e^2
};

/// Takes a press of a sphere of unit radius, density and E* apart.
Pressing pressing_from(const RunResult& result);

/// F/F_Hertz = 1 + c1 sqrt(x) + c2 x and a/a_Hertz = 1 + d1 sqrt(x) of the elastic body: the finite sphere.
struct ElasticCorrection
{
  double c1 = 0, c2 = 0, d1 = 0;
  double force_ratio(double s) const { return 1 + s * s * (c1 + c2 * s * s); }
  double force_ratio_slope(double s) const { return s * (2 * c1 + 4 * c2 * s * s); }
  double radius_ratio(double s) const { return 1 + d1 * s * s; }
  double radius_ratio_slope(double s) const { return 2 * d1 * s; }
};

/// Weighted least squares through one elastic press.
ElasticCorrection fit_elastic(const Pressing& press);

/// How well the curve represents the runs it was made from.
struct FitQuality
{
  double scatter = 0;        ///< relative rms of loading samples, over the upper half of each press
  double table_error = 0;    ///< largest relative difference of F between table and fit
  double held_out = 0;       ///< largest relative error of e at a turning depth left out of the fit
  double turning_error = 0;  ///< largest relative residual of e at the turning depths of the fit
};

struct FittedCurve
{
  ContactCurve::Table table;
  FitQuality quality;
};

/// The law of a yielding body from presses of several depths. With q = ln(s/s_onset), s = x^(1/4), smooth
/// splines that start with zero value and slope at the onset give
///     ln(F_L/F_elastic),  ln(a/a_elastic),  -ln(1 - delta_r/delta_m),  -ln(W_u/W_L).
/// The last two come from the turning points, and n = F_m (delta_m - delta_r)/W_u - 1 from all: then the
/// unloading work, and so e, is that of the runs by construction.
/// `onset`: x at which yield begins; the table reaches from 0 to at least `x_end`. Throws Error where the fit
/// is not admissible (see ContactCurve) or F_L not monotone.
FittedCurve fit_plastic(std::span<const Pressing> presses, const ElasticCorrection& elastic, double onset,
                        double x_end);

/// The law of a body that never yields.
FittedCurve table_elastic(const ElasticCorrection& elastic, double x_end);

}  // namespace granulaw
