#include "atlas/tabulate_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// Force and radius of the elastic body times exp(-reduction) and exp(widening), each with its slope by
/// q = ln(s/s_onset).
struct Loads
{
  double reduction = 0, reduction_slope = 0, widening = 0, widening_slope = 0;
};

void add_loading(CurveTable& table, const ElasticCorrection& el, double x, const Loads& l)
{
  const double s = std::pow(x, 0.25);
  const double force = std::pow(x, 1.5) * el.force_ratio(s) * std::exp(-l.reduction),
               radius = s * s * el.radius_ratio(s) * std::exp(l.widening);
  // d/dx = 1/(4 x) d/d ln s
  table.force.add(
      force, force / x * 0.25 * (6 + s * el.force_ratio_slope(s) / el.force_ratio(s) - l.reduction_slope));
  table.radius.add(
      radius, radius / x * 0.25 * (2 + s * el.radius_ratio_slope(s) / el.radius_ratio(s) + l.widening_slope));
}

/// The fraction that the shape wants, where the unloading rises and is not less stiff than loading; the work
/// is the same with any.
double admissible_hertz_share(double wanted, const Curve::Top& top, double x, double stiffness)
{
  const double mean = top.kept * top.work / (top.force * x * top.span);
  const double least_exponent =
      std::max(UnloadingShape::least_exponent, top.span * x * stiffness / top.force);
  const double least = UnloadingShape::hertz_share_of(mean, least_exponent),
               most = UnloadingShape::largest_hertz_share_of(mean);
  return std::clamp(std::max(wanted, least), 0.0, std::clamp(most, 0.0, UnloadingShape::largest_hertz_share));
}

/// Shares of the table, whose other columns stand.
void make_shares_admissible(CurveTable& table, const std::vector<double>& x)
{
  const Curve wanted(table);
  HermiteColumn& share = table.hertz_share;
  std::vector<bool> changed(x.size(), false);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double at = std::min(x[k], table.end);
    const double admissible =
        admissible_hertz_share(share.value[k], wanted.top(at), at, wanted.loading(at).stiffness);
    changed[k] = admissible != share.value[k];
    share.value[k] = admissible;
  }
  for (std::size_t k = 0; k < x.size(); ++k)
    if (changed[k]) {
      const std::size_t low = k ? k - 1 : 0, high = std::min(k + 1, x.size() - 1);
      share.slope[k] = (share.value[high] - share.value[low]) / (x[high] - x[low]);
    }
}

}  // namespace

Curve fitted_curve(CurveTable table, std::optional<AxisTable> axis)
{
  if (const Fault fault = Curve::fault(table, axis ? &*axis : nullptr))
    fail("fit", fmt::format("{}: the runs are too coarse", fault.what), fault.found, fault.allowed);
  return Curve(std::move(table), std::move(axis));
}

Curve tabulate(const LawShape& shape, double x_end)
{
  const double onset = shape.onset;
  const Spline reduction = shape.by_q(&LawShape::force_reduction), widening = shape.by_q(&LawShape::widening),
               residual = shape.by_q(&LawShape::residual), dissipation = shape.by_q(&LawShape::dissipation),
               share = shape.by_q(&LawShape::hertz_share);
  CurveTable table(onset, x_end);
  for (const double x : table.nodes()) {
    Loads loads;
    if (const double q = shape.q(x); x > onset)
      loads = {reduction.value(q), reduction.slope(q), widening.value(q), widening.slope(q)};
    add_loading(table, shape.elastic, x, loads);
  }
  const std::vector<double> yielding = table.yielding_nodes();
  for (const double x : yielding) {
    const double s = std::pow(x, 0.25), q = shape.q(x), per_q = 0.25 / x;
    const double kept = std::exp(-dissipation.value(q)), span = std::exp(-residual.value(q)),
                 elastic_share = shape.elastic.unloading(s).hertz_share;
    table.kept.add(kept, -kept * dissipation.slope(q) * per_q);
    table.span.add(span, -span * residual.slope(q) * per_q);
    table.hertz_share.add(
        elastic_share + share.value(q),
        per_q * (share.slope(q) - elastic_share * elastic_share * s * shape.elastic.force_ratio_slope(s)));
  }
  make_rise(table.force, table.nodes()), make_rise(table.radius, table.nodes());
  make_fall(table.kept, yielding), make_fall(table.span, yielding);
  if (table.yields()) make_shares_admissible(table, yielding);
  return fitted_curve(std::move(table));
}

Curve tabulate_elastic(const ElasticCorrection& elastic, double x_end)
{
  CurveTable table(std::numeric_limits<double>::infinity(), x_end);
  for (const double x : table.nodes()) add_loading(table, elastic, x, {});
  return fitted_curve(std::move(table));
}

double change_of_restitution(const LawShape& shape, const Curve& curve)
{
  const Spline fitted = shape.by_q(&LawShape::dissipation);
  double most = 0;
  for (int k = 1; k < 1000; ++k) {
    const double q = shape.q(shape.end) * k / 1000, x = shape.onset * std::exp(4 * q);
    if (x >= curve.end()) break;
    most = std::max(most, std::abs(std::sqrt(curve.kept(x)) * std::exp(0.5 * fitted.value(q)) - 1));
  }
  return most;
}

double table_error(const LawShape& shape, const Curve& curve)
{
  const double s_end = std::pow(std::min(curve.end(), shape.end), 0.25);
  const Spline force_reduction = shape.by_q(&LawShape::force_reduction);
  double worst = 0;
  for (int k = 1; k < 2000; ++k) {
    const double s = s_end * k / 2000, x = s * s * s * s;
    const double exact =
        std::pow(x, 1.5) * shape.elastic.force_ratio(s) * std::exp(-force_reduction.value(shape.q(x)));
    worst = std::max(worst, std::abs(curve.force(x) / exact - 1));
  }
  return worst;
}

}  // namespace granulaw
