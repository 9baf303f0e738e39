#include "characterise/tabulate_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "characterise/node_slopes.hpp"
#include "characterise/reversal_point.hpp"
#include "characterise/shape_function.hpp"

namespace granulaw {

namespace {

constexpr double target_spacing = 0.0045;  // of table nodes in s: about 128 nodes to x = 0.1

/// Share of the work that every yielded contact loses at least: the contact loop's own table (FastCurve)
/// follows the work of loading and that of unloading to 1e-4 each, and must not return more than was put in.
constexpr double least_loss = 2e-4;

/// Nodes uniform in s = x^(1/4), the onset on a node: everything is smooth on either side of it.
struct Nodes
{
  std::vector<double> s;
  double spacing;
  std::size_t onset;  ///< the node that it is; beyond the last: the table ends before

  Nodes(double x_onset, double x_end) : spacing(target_spacing)
  {
    const double wanted = std::pow(x_end, 0.25), s_onset = std::pow(x_onset, 0.25);
    const bool yields = std::isfinite(s_onset) && s_onset < wanted;
    if (yields) spacing = s_onset / std::max(4.0, std::round(s_onset / target_spacing));
    const auto intervals = static_cast<std::size_t>(std::ceil(wanted / spacing - 1e-9));
    for (std::size_t k = 0; k <= intervals; ++k) s.push_back(spacing * static_cast<double>(k));
    onset = yields ? static_cast<std::size_t>(std::lround(s_onset / spacing)) : s.size();
  }
  double overlap(std::size_t k) const { return s[k] * s[k] * s[k] * s[k]; }
};

/// Loading force and contact radius over Hertz's.
void tabulate_loading(ContactCurve::Table& table, const CurveSource& source, const Nodes& nodes)
{
  for (std::size_t k = 0; k < nodes.s.size(); ++k) {
    const double s = nodes.s[k], x = nodes.overlap(k);
    if (k == 0) {
      table.force_ratio.push_back(1), table.force_ratio_slope.push_back(0);
      table.radius_ratio.push_back(1);
      continue;
    }
    const ContactCurve::Loading l = source.loading(x);
    const double ratio = l.force / (s * s * x);
    table.force_ratio.push_back(ratio);
    // F = s^6 g: d ln g/d ln s = 4 d ln F/d ln x - 6
    table.force_ratio_slope.push_back(ratio / s * (4 * x * l.stiffness / l.force - 6));
    table.radius_ratio.push_back(l.radius / (s * s));
  }
  table.radius_ratio_slope = difference_slopes(table.radius_ratio, nodes.spacing);
}

/// A reversal of the body while it is elastic: it unloads as it loads, F = F_L(x u).
UnloadingShape elastic_unloading(const ReversalPoint& point)
{
  return {point.force_exponent, UnloadingShape::hertz_share_of(point.mean_force, point.force_exponent)};
}

/// The reversal points at the nodes: losses of the source, made to rise, and work of the table's loading.
std::vector<ReversalPoint> reversal_points(const CurveSource& source, const ContactCurve& loading,
                                           const Nodes& nodes)
{
  const std::size_t count = nodes.s.size();
  std::vector<double> residual, dissipation;
  for (std::size_t k = nodes.onset; k < count; ++k) {
    const double x = nodes.overlap(k);
    residual.push_back(k == nodes.onset ? 0.0 : source.residual(x));
    dissipation.push_back(k == nodes.onset ? 0.0 : source.dissipation(x));
  }
  const Rising risen_residual(residual, nodes.spacing), risen_dissipation(dissipation, nodes.spacing);
  std::vector<ReversalPoint> points(count);
  for (std::size_t k = 1; k < count; ++k) {
    const double x = nodes.overlap(k);
    const ContactCurve::Loading top = loading.loading(x);
    ReversalPoint& p = points[k];
    p.log_slope = 4 / nodes.s[k];
    p.force_exponent = x * top.stiffness / top.force;
    p.mean_force = loading.work_loading(x) / (top.force * x);
    if (k < nodes.onset) continue;
    const std::size_t j = k - nodes.onset;
    p.residual = risen_residual.value[j], p.residual_slope = risen_residual.slope[j];
    p.loss = least_loss + risen_dissipation.value[j], p.loss_slope = risen_dissipation.slope[j];
    p.fit_length();
  }
  return points;
}

/// The share that the source wants, where the unloading rises and is not less stiff than loading; the work
/// is the same with any.
double admissible_hertz_share(double wanted, const ReversalPoint& point)
{
  const double least = UnloadingShape::hertz_share_of(point.work(), point.least_exponent()),
               most = UnloadingShape::largest_hertz_share_of(point.work());
  return std::clamp(std::max(wanted, least), 0.0, std::max(0.0, most));
}

/// Residual and unloading, from the loading that the table has.
void tabulate_unloading(ContactCurve::Table& table, const CurveSource& source, const ContactCurve& loading,
                        const Nodes& nodes)
{
  const std::vector<ReversalPoint> points = reversal_points(source, loading, nodes);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ReversalPoint& p = points[k];
    UnloadingShape shape;
    if (k > 0 && k < nodes.onset) shape = elastic_unloading(p);
    if (k >= nodes.onset) {
      shape.hertz_share = admissible_hertz_share(source.hertz_share(nodes.overlap(k)), p);
      shape.exponent = std::min(UnloadingShape::exponent_of(p.work(), shape.hertz_share),
                                UnloadingShape::largest_exponent(shape.hertz_share));
    }
    table.hertz_share[k] = shape.hertz_share, table.exponent[k] = shape.exponent;
    table.residual_ratio[k] = -std::expm1(-p.residual);
    table.residual_ratio_slope[k] = std::exp(-p.residual) * p.residual_slope;
  }
  const double h = nodes.spacing;
  table.hertz_share_slope = difference_slopes_in_parts(table.hertz_share, nodes.onset, h);
  for (std::size_t k = 1; k < points.size(); ++k) {
    // A >= 0 and 10 - A - 4 n >= 0 between nodes too: UnloadingShape's force rises
    double& share_slope = table.hertz_share_slope[k];
    share_slope = slope_of_a_positive(share_slope, table.hertz_share[k], h);
    const double room = 10 - table.hertz_share[k] - 4 * table.exponent[k];
    const double room_slope = 42 * points[k].work_slope() - 1.8 * share_slope;
    table.exponent_slope[k] = -0.25 * (share_slope + slope_of_a_positive(room_slope, room, h));
  }
}

}  // namespace

ContactCurve tabulate(const CurveSource& source, double x_end)
{
  const Nodes nodes(source.onset, x_end);
  const std::size_t count = nodes.s.size();
  ContactCurve::Table table;
  table.s_end = nodes.s.back();
  table.onset = source.onset;
  tabulate_loading(table, source, nodes);
  table.residual_ratio.assign(count, 0.0), table.residual_ratio_slope.assign(count, 0.0);
  table.exponent.assign(count, UnloadingShape{}.exponent), table.exponent_slope.assign(count, 0.0);
  table.hertz_share.assign(count, UnloadingShape{}.hertz_share), table.hertz_share_slope.assign(count, 0.0);
  // the exponent needs the loading work of this very table
  tabulate_unloading(table, source, ContactCurve(table, "fitted curve"), nodes);
  ContactCurve curve(table, "fitted curve");
  require_admissible(curve);
  return curve;
}

CurveSource curve_source(const LawShape& shape, double onset, double shape_end)
{
  using Kind = ShapeFunction::Kind;
  const double q_end = 0.25 * std::log(shape_end / onset);
  const auto q_of = [onset](double x) { return 0.25 * std::log(x / onset); };
  const auto of_q = [q_of](ShapeFunction f) {
    return [f = std::move(f), q_of](double x) { return f.value(q_of(x)); };
  };
  CurveSource source;
  source.onset = onset;
  source.loading = [el = shape.elastic, q_of, reduction = ShapeFunction(shape.force_reduction, q_end),
                    widening = ShapeFunction(shape.widening, q_end)](double x) {
    const double s = std::pow(x, 0.25), q = q_of(x);
    const double force = std::pow(x, 1.5) * el.force_ratio(s) * std::exp(-reduction.value(q));
    const double per_log_s = 6 + s * el.force_ratio_slope(s) / el.force_ratio(s) - reduction.slope(q);
    return ContactCurve::Loading{force, force / x * 0.25 * per_log_s,
                                 s * s * el.radius_ratio(s) * std::exp(widening.value(q))};
  };
  source.residual = of_q(ShapeFunction(shape.residual, q_end, Kind::rising));
  source.dissipation = of_q(ShapeFunction(shape.dissipation, q_end, Kind::rising));
  source.hertz_share = [el = shape.elastic, more = of_q(ShapeFunction(shape.hertz_share, q_end))](double x) {
    return el.unloading(std::pow(x, 0.25)).hertz_share + more(x);
  };
  return source;
}

ContactCurve tabulate(const LawShape& shape, double onset, double shape_end, double x_end)
{
  return tabulate(curve_source(shape, onset, shape_end), x_end);
}

ContactCurve::Table tabulate_elastic(const ElasticCorrection& elastic, double x_end)
{
  const double never = std::numeric_limits<double>::infinity();
  const Nodes nodes(never, x_end);
  ContactCurve::Table table;
  table.s_end = nodes.s.back();
  table.onset = never;
  for (const double s : nodes.s) {
    table.force_ratio.push_back(elastic.force_ratio(s));
    table.force_ratio_slope.push_back(elastic.force_ratio_slope(s));
    table.radius_ratio.push_back(elastic.radius_ratio(s));
    table.radius_ratio_slope.push_back(elastic.radius_ratio_slope(s));
    table.exponent.push_back(elastic.unloading(s).exponent);
    table.hertz_share.push_back(elastic.unloading(s).hertz_share);
  }
  table.residual_ratio.assign(nodes.s.size(), 0.0);
  table.residual_ratio_slope = table.residual_ratio;
  table.exponent_slope = table.hertz_share_slope = table.residual_ratio;
  return table;
}

void require_admissible(const ContactCurve& curve)
{
  for (int k = 1; k <= 1000; ++k) {
    const double x = std::pow(curve.table().s_end * k / 1000, 4);
    if (curve.loading(x).stiffness <= 0)
      fail("fit",
           fmt::format("the loading force does not rise at delta/R = {:.4g}: the runs are too coarse", x));
  }
  if (const double margin = curve.admissibility_margin(); margin < 0)
    fail("fit",
         fmt::format("the law would gain energy in a closed cycle (margin {:.3g}): the runs are too coarse",
                     margin));
}

double change_of_restitution(const LawShape& shape, double onset, double shape_end, const ContactCurve& curve)
{
  const double q_end = 0.25 * std::log(shape_end / onset);
  const ShapeFunction fitted(shape.dissipation, q_end);
  double most = 0;
  for (int k = 1; k < 1000; ++k) {
    const double q = q_end * k / 1000, x = onset * std::exp(4 * q);
    if (x >= curve.x_end()) break;
    const double e = std::sqrt(curve.work_unloading(x) / curve.work_loading(x));
    most = std::max(most, std::abs(e * std::exp(0.5 * fitted.value(q)) - 1));
  }
  return most;
}

double table_error(const LawShape& shape, double onset, double shape_end, const ContactCurve& curve)
{
  const double s_onset = std::pow(onset, 0.25);
  const ShapeFunction force_reduction(shape.force_reduction, 0.25 * std::log(shape_end / onset));
  double worst = 0;
  for (int k = 1; k < 2000; ++k) {
    const double s = curve.table().s_end * k / 2000, x = s * s * s * s;
    if (x > shape_end) break;
    const double q = s > s_onset ? std::log(s / s_onset) : 0.0;
    const double exact =
        std::pow(x, 1.5) * shape.elastic.force_ratio(s) * std::exp(-force_reduction.value(q));
    worst = std::max(worst, std::abs(curve.loading(x).force / exact - 1));
  }
  return worst;
}

}  // namespace granulaw
