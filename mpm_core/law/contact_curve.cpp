#include "law/contact_curve.hpp"

#include <fmt/format.h>

#include <limits>

#include "base/error.hpp"
#include "base/gauss.hpp"
#include "law/table_checks.hpp"

namespace granulaw {

namespace {

constexpr double largest_ratio = VelocityAxis::ReversalCorrection::largest_ratio;

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
      {"residual_ratio", table.residual_ratio, table.residual_ratio_slope, 0, 0.99999, -0.1, largest_ratio,
       &Interval::rho},
      {"exponent", table.exponent, table.exponent_slope, UnloadingShape::least_exponent, 2.5, 0.9, 2.5,
       &Interval::n},
      {"foot", table.hertz_share, table.hertz_share_slope, 0, UnloadingShape::largest_hertz_share, -1e-6,
       UnloadingShape::largest_hertz_share, &Interval::hertz_share},
      {"radius_ratio", table.radius_ratio, table.radius_ratio_slope, 0, 1e3, 0, 2e3, &Interval::a}};
  for (const Function& f : functions) {
    constexpr double big = 1e12;
    check_values(f.value, count, f.low, f.high, where, f.name);
    check_values(f.slope, count, -big, big, where, fmt::format("{}_slope", f.name));
    for (std::size_t k = 0; k + 1 < count; ++k) {
      hermite(intervals_[k].*f.cubic, f.value[k], f.value[k + 1], h * f.slope[k], h * f.slope[k + 1]);
      check_between(intervals_[k].*f.cubic, f.low_between, f.high_between, where, f.name, k);
    }
  }
  check_unloading_rises(where);
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

ContactCurve::ContactCurve(const Table& table, const VelocityAxis::Table& axis, const std::string& where)
    : ContactCurve(table, where)
{
  axis_.emplace(axis, where);
  check_axis(where);
}

void ContactCurve::check_unloading_rises(const std::string& where) const
{
  // A + 4 n <= 10 between nodes, too: a cubic as A and n are
  for (std::size_t k = 0; k < intervals_.size(); ++k) {
    double sum[4];
    for (int power = 0; power < 4; ++power)
      sum[power] = intervals_[k].hertz_share[power] + 4.0 * intervals_[k].n[power];
    constexpr double most = 10.0 + 1e-9;  // rounding
    for (const double at : {cubic(sum, 0.0), cubic(sum, 1.0)})
      if (!(at <= most))
        fail(where, fmt::format("the unloading would fall: 'foot' + 4 'exponent' about node {}", k),
             fmt::format("{:.6g}", at), "up to 10");
    check_between(sum, 0.0, most, where, "foot + 4 exponent", k);
  }
}

void ContactCurve::check_axis(const std::string& where) const
{
  const double end = axis_->overlap_end();
  if (end > 1.05 * x_end_)  // 5 %: so far the linear continuation is still within about a percent
    fail(where, "the velocity axis goes deeper than the curve: 'impact_overlap' at the last node",
         fmt::format("{:.6g}", end), fmt::format("up to {:.6g}", 1.05 * x_end_));
  const auto columns = 8 * (axis_->table().ratio_nodes() - 1);
  for (const double overlap : axis_->examined_overlaps())
    for (std::size_t l = 1; l <= columns; ++l) {
      const double ratio = axis_->table().ratio_end * static_cast<double>(l) / static_cast<double>(columns);
      const double x = ratio * overlap;
      const auto here = [&](const char* what) {
        return fmt::format("with the velocity axis {} at overlap {:.4g} after an impact to {:.4g}", what, x,
                           overlap);
      };
      const Loading now = loading(x, overlap);
      if (!(now.stiffness >= -1e-9 * now.force / x))  // 1e-9: rounding of a force that stands still
        fail(where, here("the loading force falls"));
      if (x <= onset_ || x > x_end_) continue;
      const Position p = locate(x);
      const VelocityAxis::ReversalCorrection reversal = axis_->reversal(x, overlap);
      const double residual = cubic(p.interval->rho, p.t) + reversal.residual,
                   n = cubic(p.interval->n, p.t) + reversal.exponent;
      if (!(residual >= -0.1 && residual <= largest_ratio))  // between nodes, as the quasi-static ratio's
        fail(where, here("the residual ratio is out of range"), fmt::format("{:.6g}", residual),
             fmt::format("-0.1 to {:.6f}", largest_ratio));
      if (!(n >= 0.9 && n <= 12))
        fail(where, here("the exponent is out of range"), fmt::format("{:.6g}", n), "0.9 to 12");
    }
}

double ContactCurve::quasi_static_work(double x) const
{
  if (x > x_end_) {
    const double beyond = x - x_end_;
    return work_.back() + beyond * (end_.force + 0.5 * end_.stiffness * beyond);
  }
  const Position p = locate(x);
  const auto k = static_cast<std::size_t>(p.interval - intervals_.data());
  return work_[k] + interval_work(k, p.t);
}

double ContactCurve::work_loading(double x, double impact_overlap) const
{
  return quasi_static_work(x) + (corrected(impact_overlap) ? correction_work(0.0, x, impact_overlap) : 0.0);
}

std::vector<double> ContactCurve::work_loading(std::span<const double> ascending, double impact_overlap) const
{
  std::vector<double> works;
  double correction = 0, before = 0;
  for (const double x : ascending) {
    if (corrected(impact_overlap)) correction += correction_work(before, x, impact_overlap);
    works.push_back(quasi_static_work(x) + correction);
    before = x;
  }
  return works;
}

double ContactCurve::correction_work(double from, double to, double impact_overlap) const
{
  // integral of F_qs A dx over s = x^(1/4), piece by piece between the nodes of curve and axis, where the
  // integrand is a polynomial (of degree 24: 7 points leave 1e-12 on so short pieces)
  const double ratio_end = axis_->table().ratio_end;
  const double per_ratio = static_cast<double>(axis_->table().ratio_nodes() - 1) / ratio_end;
  const double s_stop = std::pow(std::min(to, ratio_end * impact_overlap), 0.25);
  double sum = 0, s = std::pow(from, 0.25);
  auto curve_node = static_cast<std::size_t>(s * per_h_) + 1,
       axis_node = static_cast<std::size_t>(from / impact_overlap * per_ratio) + 1;
  while (s < s_stop) {
    const double s_curve = curve_node < intervals_.size() ? static_cast<double>(curve_node) / per_h_
                           : s < table_.s_end             ? table_.s_end
                                                          : s_stop;
    const double s_axis = std::pow(static_cast<double>(axis_node) / per_ratio * impact_overlap, 0.25);
    const double next = std::min({s_curve, s_axis, s_stop});
    if (next > s)
      sum += gauss<7>(s, next, [&](double at) {
        const double here = at * at * at * at;
        return 4.0 * at * at * at * quasi_static(here).force * axis_->force(here, impact_overlap).value;
      });
    if (s_curve <= next) ++curve_node;
    if (s_axis <= next) ++axis_node;
    s = next;
  }
  return sum;
}

double ContactCurve::interval_work(std::size_t k, double t_end) const
{
  // integral of F dx = x^1.5 g dx = 4 s^9 g ds: of degree 12
  return gauss<7>(0.0, t_end,
                  [&](double t) {
                    return 4.0 * std::pow((static_cast<double>(k) + t) / per_h_, 9) *
                           cubic(intervals_[k].g, t);
                  }) /
         per_h_;
}

double ContactCurve::work_unloading(double x_m, double impact_overlap) const
{
  if (x_m <= onset_) return work_loading(x_m, impact_overlap);
  const Reversal top = reversal(x_m, impact_overlap);
  return top.force * (x_m - top.residual) * top.shape.work();
}

double ContactCurve::admissibility_margin() const
{
  double margin = admissibility_margin(0.0);
  if (!axis_) return margin;
  for (const double overlap : axis_->examined_overlaps())
    margin = std::min(margin, admissibility_margin(overlap));
  return margin;
}

double ContactCurve::admissibility_margin(double impact_overlap) const
{
  double margin = std::numeric_limits<double>::infinity();
  // A reversal just past the onset must not give back more than was put in.
  if (const double first = onset_ * (1.0 + 1e-9); onset_ > 0 && first < x_end_)
    margin = 1.0 - work_unloading(first, impact_overlap) / work_loading(first, impact_overlap);
  for (const double x : margin_overlaps(impact_overlap))
    margin = std::min(margin, margin_at(x, impact_overlap));
  return margin;
}

std::vector<double> ContactCurve::margin_overlaps(double impact_overlap) const
{
  // an axis bends the curve on a scale of its own: at least 512
  const std::size_t samples =
      corrected(impact_overlap) ? std::max<std::size_t>(4 * intervals_.size(), 512) : 4 * intervals_.size();
  std::vector<double> overlaps;
  for (std::size_t k = 1; k < samples; ++k) {
    const double s = table_.s_end * static_cast<double>(k) / static_cast<double>(samples);
    overlaps.push_back(s * s * s * s);
  }
  return overlaps;
}

double ContactCurve::margin_at(double x, double impact_overlap) const
{
  const double step = 1e-4 * x;
  if (x - step <= onset_ || x + step >= x_end_) return std::numeric_limits<double>::infinity();
  const double slope =
      (work_unloading(x + step, impact_overlap) - work_unloading(x - step, impact_overlap)) / (2.0 * step);
  const double force = loading(x, impact_overlap).force;
  return (force - slope) / force;
}

}  // namespace granulaw
