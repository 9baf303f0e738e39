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

/// The nodes may be sane and the cubics between them not, where a slope is wild: both turning points count.
void check_between(const double (&c)[4], double low, double high, const std::string& where, const char* name,
                   std::size_t node)
{
  const auto check = [&](double t) {
    const double value = c[0] + t * (c[1] + t * (c[2] + t * c[3]));
    if (!(value >= low && value <= high))
      fail(where, fmt::format("'{}' between nodes {} and {} is out of range", name, node, node + 1),
           fmt::format("{:.6g}", value), fmt::format("{:.6g} to {:.6g}", low, high));
  };
  // c1 + 2 c2 t + 3 c3 t^2 = 0, with q so that neither root cancels
  const double root = c[2] * c[2] - 3.0 * c[1] * c[3];
  if (!(root >= 0)) return;
  const double q = -(c[2] + std::copysign(std::sqrt(root), c[2]));
  for (const double t : {q / (3.0 * c[3]), c[1] / q})
    if (t > 0 && t < 1) check(t);
}

}  // namespace

ContactCurve::ContactCurve(const Table& table, const std::string& where) : table_(table)
{
  const std::size_t count = table.force_ratio.size();
  if (count < 4 || count > 65536)
    fail(where, "a contact curve has an unusable number of nodes", std::to_string(count), "4 to 65536");
  if (!(table.s_end >= 1e-6 && table.s_end <= 2.0))  // below, x_end = s_end^4 and its powers underflow
    fail(where, "'s_end' is out of range", fmt::format("{:.6g}", table.s_end), "1e-06 to 2");
  if (!(table.onset >= 0))
    fail(where, "'onset' is out of range", fmt::format("{:.6g}", table.onset), "0 or more");

  const double h = table.s_end / static_cast<double>(count - 1);
  per_h_ = 1.0 / h;
  onset_ = table.onset;
  intervals_.resize(count - 1);
  // Between nodes a cubic may overshoot a little (residual_ratio and exponent do about the onset), but not so
  // far that a force could turn negative or infinite.
  struct Function
  {
    const char* name;
    const std::vector<double>&value, &slope;
    double low, high, low_between, high_between;
    double (Interval::*cubic)[4];
  };
  const Function functions[] = {
      {"force_ratio", table.force_ratio, table.force_ratio_slope, 1e-5, 1e3, 1e-6, 2e3, &Interval::g},
      {"residual_ratio", table.residual_ratio, table.residual_ratio_slope, 0, 0.99999, -0.1, 0.999995,
       &Interval::rho},
      {"exponent", table.exponent, table.exponent_slope, 1, 10, 0.9, 12, &Interval::n},
      {"radius_ratio", table.radius_ratio, table.radius_ratio_slope, 0, 1e3, 0, 2e3, &Interval::a}};
  for (const Function& f : functions) {
    constexpr double big = 1e12;
    check_values(f.value, count, f.low, f.high, where, f.name);
    check_values(f.slope, count, -big, big, where, fmt::format("{}_slope", f.name).c_str());
    for (std::size_t k = 0; k + 1 < count; ++k) {
      hermite(intervals_[k].*f.cubic, f.value[k], f.value[k + 1], h * f.slope[k], h * f.slope[k + 1]);
      check_between(intervals_[k].*f.cubic, f.low_between, f.high_between, where, f.name, k);
    }
  }
  x_end_ = table.s_end * table.s_end * table.s_end * table.s_end;

  work_.assign(count, 0.0);
  for (std::size_t k = 0; k + 1 < count; ++k) work_[k + 1] = work_[k] + interval_work(k, 1.0);

  // x_end_ itself lies in the last interval: evaluate it there for the linear continuation.
  const Position p{&intervals_.back(), 1.0, table.s_end, table.s_end * table.s_end};
  const double g = cubic(p.interval->g, 1.0), dg = cubic_slope(p.interval->g, 1.0) * per_h_;
  end_ = {x_end_ * p.root * g, p.root * (1.5 * g + 0.25 * p.s * dg), p.root * cubic(p.interval->a, 1.0)};
  if (!(end_.stiffness >= 0))
    fail(where, "the force falls at the last overlap, and beyond it would turn negative");
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
