#include "liggghts_plugin/hot_table.hpp"

namespace granulaw::plugin {

namespace {

/// Coefficients in t of the cubic through v[k] at t = width k/3.
void fit(const double (&v)[4], double width, double (&c)[4])
{
  c[0] = v[0];
  c[1] = 0.5 * (-11.0 * v[0] + 18.0 * v[1] - 9.0 * v[2] + 2.0 * v[3]);
  c[2] = 4.5 * (2.0 * v[0] - 5.0 * v[1] + 4.0 * v[2] - v[3]);
  c[3] = 4.5 * (-v[0] + 3.0 * v[1] - 3.0 * v[2] + v[3]);
  for (int power = 1; power < 4; ++power) c[power] /= std::pow(width, power);
}

}  // namespace

HotTable::HotTable(const ContactCurve& curve)
    : curve_(&curve), lowest_(std::ldexp(1.0, lowest_exponent)), x_end_(curve.x_end()), onset_(curve.onset())
{
  const auto count =
      static_cast<std::size_t>((std::bit_cast<std::uint64_t>(x_end_) - first_bits) >> shift) + 1;
  intervals_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double low = std::bit_cast<double>(first_bits + (static_cast<std::uint64_t>(k) << shift));
    const double high = std::bit_cast<double>(first_bits + (static_cast<std::uint64_t>(k + 1) << shift));
    // the last interval is sampled up to x_end only: beyond, the curve's residual and exponent stand still
    const double width = (std::min(high, x_end_) - low) / (high - low);
    double force[4], residual[4], exponent[4], work[4];
    for (int p = 0; p < 4; ++p) {
      const double x = low + width * (high - low) * p / 3.0;
      const ContactCurve::Turning turning = curve.turning(x);
      force[p] = turning.force;
      residual[p] = turning.residual / x;
      exponent[p] = turning.exponent;
      work[p] = curve.work_loading(x) - curve.work_unloading(x);
    }
    fit(force, width, intervals_[k].force);
    fit(residual, width, intervals_[k].residual);
    fit(exponent, width, intervals_[k].exponent);
    fit(work, width, intervals_[k].work);
  }
}

double HotTable::slow_unloading(double x_max, double ratio) const
{
  const ContactCurve::Turning turning = curve_->turning(x_max);
  const double residual = turning.residual / x_max, u = (ratio - residual) / (1.0 - residual);
  return u <= 0.0 ? 0.0 : turning.force * std::pow(u, turning.exponent);
}

}  // namespace granulaw::plugin
