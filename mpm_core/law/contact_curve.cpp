#include "law/contact_curve.hpp"

#include <fmt/format.h>

#include <limits>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// Cubic Hermite coefficients in t on [0,1] from end values and end slopes d/dt.
void hermite(double (&c)[4], double v0, double v1, double m0, double m1)
{
  c[0] = v0;
  c[1] = m0;
  c[2] = 3.0 * (v1 - v0) - 2.0 * m0 - m1;
  c[3] = 2.0 * (v0 - v1) + m0 + m1;
}

void check_values(const std::vector<double>& values, std::size_t count, double low, double high,
                  const std::string& where, const char* name)
{
  if (values.size() != count)
    fail(where, fmt::format("'{}' has the wrong length", name), std::to_string(values.size()),
         std::to_string(count));
  for (std::size_t k = 0; k < count; ++k)
    if (!(values[k] >= low && values[k] <= high))  // NaN fails as well
      fail(where, fmt::format("'{}' at node {} is out of range", name, k), fmt::format("{:.6g}", values[k]),
           fmt::format("{:.6g} to {:.6g}", low, high));
}

}  // namespace

ContactCurve::ContactCurve(const Table& table, const std::string& where) : table_(table)
{
  const std::size_t count = table.force_ratio.size();
  constexpr double big = 1e12;
  if (count < 4 || count > 65536)
    fail(where, "a contact curve has an unusable number of nodes", std::to_string(count), "4 to 65536");
  if (!(table.s_end > 0 && table.s_end <= 2.0))
    fail(where, "'s_end' is out of range", fmt::format("{:.6g}", table.s_end), "over 0, up to 2");
  if (!(table.onset >= 0))
    fail(where, "'onset' is out of range", fmt::format("{:.6g}", table.onset), "0 or more");
  check_values(table.force_ratio, count, 0.0, 1e3, where, "force_ratio");
  check_values(table.residual_ratio, count, 0.0, 0.99999, where, "residual_ratio");
  check_values(table.exponent, count, 1.0, 10.0, where, "exponent");
  check_values(table.radius_ratio, count, 0.0, 1e3, where, "radius_ratio");
  check_values(table.force_ratio_slope, count, -big, big, where, "force_ratio_slope");
  check_values(table.residual_ratio_slope, count, -big, big, where, "residual_ratio_slope");
  check_values(table.exponent_slope, count, -big, big, where, "exponent_slope");
  check_values(table.radius_ratio_slope, count, -big, big, where, "radius_ratio_slope");

  const double h = table.s_end / static_cast<double>(count - 1);
  per_h_ = 1.0 / h;
  onset_ = table.onset;
  intervals_.resize(count - 1);
  for (std::size_t k = 0; k + 1 < count; ++k) {
    Interval& i = intervals_[k];
    hermite(i.g, table.force_ratio[k], table.force_ratio[k + 1], h * table.force_ratio_slope[k],
            h * table.force_ratio_slope[k + 1]);
    hermite(i.rho, table.residual_ratio[k], table.residual_ratio[k + 1], h * table.residual_ratio_slope[k],
            h * table.residual_ratio_slope[k + 1]);
    hermite(i.n, table.exponent[k], table.exponent[k + 1], h * table.exponent_slope[k],
            h * table.exponent_slope[k + 1]);
    hermite(i.a, table.radius_ratio[k], table.radius_ratio[k + 1], h * table.radius_ratio_slope[k],
            h * table.radius_ratio_slope[k + 1]);
  }
  x_end_ = table.s_end * table.s_end * table.s_end * table.s_end;

  work_.assign(count, 0.0);
  for (std::size_t k = 0; k + 1 < count; ++k) work_[k + 1] = work_[k] + interval_work(k, 1.0);

  // x_end_ itself lies in the last interval: evaluate it there for the linear continuation.
  const Position p{&intervals_.back(), 1.0, table.s_end, table.s_end * table.s_end};
  const double g = cubic(p.interval->g, 1.0), dg = cubic_slope(p.interval->g, 1.0) * per_h_;
  end_ = {x_end_ * p.root * g, p.root * (1.5 * g + 0.25 * p.s * dg), p.root * cubic(p.interval->a, 1.0)};
}

double ContactCurve::work_loading(double x) const
{
  if (x > x_end_) {
    const double beyond = x - x_end_;
    return work_.back() + beyond * (end_.force + 0.5 * end_.stiffness * beyond);
  }
  const Position p = locate(x);
  const auto k = static_cast<std::size_t>(p.interval - intervals_.data());
  return work_[k] + interval_work(k, p.t);
}

double ContactCurve::interval_work(std::size_t k, double t_end) const
{
  // integral of F dx = x^1.5 g dx = 4 s^9 g ds: 7-point Gauss-Legendre is exact (degree 12 of 13).
  static constexpr double node[7] = {-0.9491079123427585, -0.7415311855993945, -0.4058451513773972, 0.0,
                                     0.4058451513773972,  0.7415311855993945,  0.9491079123427585};
  static constexpr double weight[7] = {0.1294849661688697, 0.2797053914892766, 0.3818300505051189,
                                       0.4179591836734694, 0.3818300505051189, 0.2797053914892766,
                                       0.1294849661688697};
  double sum = 0;
  for (int q = 0; q < 7; ++q) {
    const double t = 0.5 * t_end * (1.0 + node[q]);
    const double s = (static_cast<double>(k) + t) / per_h_;
    sum += 0.5 * weight[q] * 4.0 * std::pow(s, 9) * cubic(intervals_[k].g, t);
  }
  return sum * t_end / per_h_;
}

double ContactCurve::work_unloading(double x_m) const
{
  if (x_m <= onset_) return work_loading(x_m);
  const Turning top = turning(x_m);
  return top.force * (x_m - top.residual) / (top.exponent + 1.0);
}

double ContactCurve::admissibility_margin() const
{
  double margin = std::numeric_limits<double>::infinity();
  // A turn just past the onset must not give back more than was put in.
  if (const double first = onset_ * (1.0 + 1e-9); onset_ > 0 && first < x_end_)
    margin = 1.0 - work_unloading(first) / work_loading(first);
  const std::size_t samples = 4 * intervals_.size();
  for (std::size_t k = 1; k < samples; ++k) {
    const double s = table_.s_end * static_cast<double>(k) / static_cast<double>(samples);
    const double x = s * s * s * s, step = 1e-4 * x;
    if (x - step <= onset_ || x + step >= x_end_) continue;
    const double slope = (work_unloading(x + step) - work_unloading(x - step)) / (2.0 * step);
    const double force = loading(x).force;
    margin = std::min(margin, (force - slope) / force);
  }
  return margin;
}

}  // namespace granulaw
