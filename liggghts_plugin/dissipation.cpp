#include "liggghts_plugin/dissipation.hpp"

namespace granulaw::plugin {

DissipationTable::DissipationTable(const ContactCurve& curve, int intervals)
{
  const double s_end = std::pow(curve.x_end(), 0.25);
  per_h_ = intervals / s_end;
  last_ = intervals * (1.0 - 1e-12);
  ratio_.assign(static_cast<std::size_t>(intervals) + 1, 0.0);
  for (int k = 1; k <= intervals; ++k) {
    const double x = std::min(std::pow(k / per_h_, 4), curve.x_end());
    ratio_[static_cast<std::size_t>(k)] = (curve.work_loading(x) - curve.work_unloading(x)) / (x * x * std::sqrt(x));
  }
}

double thornton_dissipation(const ThorntonPair& pair, double r_eff, double delta_max)
{
  const double d_y = pair.yield_overlap(r_eff);
  if (delta_max <= d_y) return 0.0;
  const double hertz = 4.0 / 3.0 * pair.e_star, f_y = hertz * std::sqrt(r_eff * d_y) * d_y;
  const double k_p = M_PI * pair.yield_pressure * r_eff, plastic = delta_max - d_y;
  const double f_m = f_y + k_p * plastic;
  const double loading = 0.4 * f_y * d_y + plastic * (f_y + 0.5 * k_p * plastic);
  // unloading is Hertz with the flattened radius R_p, from F_m down to zero: 2/5 F_m (d_m - d_p)
  const double radius = hertz / f_m * std::pow((2.0 * f_m + f_y) / (2.0 * M_PI * pair.yield_pressure), 1.5);
  return loading - 0.4 * f_m * std::cbrt(f_m * f_m / (hertz * hertz * radius));
}

}  // namespace granulaw::plugin
