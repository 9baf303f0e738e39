#include "characterise/law_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "characterise/shape_function.hpp"

namespace granulaw {

namespace {

// Of the work: just past the onset, where next to nothing is lost, rounding must not give back more than was
// put in. e is .01 % lower.
constexpr double rounding_spare = 2e-4;
constexpr double least_hertz_share = 0.03;  // about: a smooth floor of A, whose cubics must not pass below 0
constexpr double spare_hertz_share = 2e-4;  // below what still rises: the rounding of cubics between nodes
constexpr double target_spacing = 0.0045;   // of table nodes in s: about 128 nodes to x = 0.1

/// Nodes uniform in s, the onset on a node: everything is smooth on either side of it.
ContactCurve::Table empty_table(double s_onset, double x_end, std::vector<double>& nodes)
{
  const double wanted = std::pow(x_end, 0.25);
  double spacing = target_spacing;
  if (std::isfinite(s_onset) && s_onset < wanted)
    spacing = s_onset / std::max(4.0, std::round(s_onset / target_spacing));
  const auto intervals = static_cast<std::size_t>(std::ceil(wanted / spacing - 1e-9));
  for (std::size_t k = 0; k <= intervals; ++k) nodes.push_back(spacing * static_cast<double>(k));
  ContactCurve::Table table;
  table.s_end = nodes.back();
  return table;
}

void add_to(std::vector<double>& sum, double weight, const std::vector<double>& values)
{
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * values[k];
}

}  // namespace

LawShape LawShape::zero()
{
  const std::vector<double> none(nodes, 0.0);
  LawShape shape{{}, none, none, none, none, none, {}};
  for (const double v : impact_speeds)
    shape.velocity_effects.push_back({v, 0, 0, 0, std::vector<double>(VelocityEffect::shares, 0.0)});
  return shape;
}

const std::array<std::vector<double> LawShape::*, 5> LawShape::functions = {
    &LawShape::force_reduction, &LawShape::widening, &LawShape::residual, &LawShape::dissipation,
    &LawShape::hertz_share};

void ElasticCorrection::add(double weight, const ElasticCorrection& other)
{
  c1 += weight * other.c1, c2 += weight * other.c2, c3 += weight * other.c3;
  d1 += weight * other.d1;
}

void LawShape::add(double weight, const LawShape& other)
{
  add_loading(weight, other);
  add_unloading(weight, other);
}

void LawShape::add_loading(double weight, const LawShape& other)
{
  elastic.add(weight, other.elastic);
  add_to(force_reduction, weight, other.force_reduction);
  add_to(widening, weight, other.widening);
}

void LawShape::add_unloading(double weight, const LawShape& other)
{
  add_to(residual, weight, other.residual);
  add_to(dissipation, weight, other.dissipation);
  add_to(hertz_share, weight, other.hertz_share);
  for (std::size_t k = 0; k < velocity_effects.size(); ++k) {
    velocity_effects[k].log_overlap += weight * other.velocity_effects[k].log_overlap;
    velocity_effects[k].dissipation += weight * other.velocity_effects[k].dissipation;
    velocity_effects[k].residual += weight * other.velocity_effects[k].residual;
    add_to(velocity_effects[k].force, weight, other.velocity_effects[k].force);
  }
}

LawShape LawShape::rescaled(double share) const
{
  LawShape result = zero();
  result.elastic = elastic;
  for (const auto member : functions) {
    const ShapeFunction function(this->*member, 1.0);
    for (int k = 0; k < nodes; ++k)
      (result.*member)[static_cast<std::size_t>(k)] = function.value(std::min(1.0, share * k / (nodes - 1)));
  }
  return result;
}

LawShape LawShape::as_skin_of(const ElasticCorrection& body, double onset, double end, double known) const
{
  const ContactCurve sphere = tabulate(*this, onset, end, known);
  const double compliance = 2.0 / 3.0 * (elastic.c1 - body.c1);
  const double range = std::log(end / onset);
  LawShape result = *this;
  result.elastic = body;
  result.velocity_effects = zero().velocity_effects;
  for (std::size_t k = 1; k < nodes; ++k) {
    const double x = onset * std::exp(range * static_cast<double>(k) / (nodes - 1));
    if (x > known) {
      for (const auto member : functions) (result.*member)[k] = (result.*member)[k - 1];
      continue;
    }
    double skin = x;  // x'
    for (int round = 0; round < 20; ++round) skin = x - compliance * sphere.loading(skin).force;
    const ContactCurve::Reversal top = sphere.reversal(skin);
    const double s = std::pow(x, 0.25), below = 0.5 * compliance * top.force * top.force;  // work
    const double work = sphere.work_loading(skin), returned = sphere.work_unloading(skin);
    result.force_reduction[k] = -std::log(top.force / (std::pow(x, 1.5) * body.force_ratio(s)));
    result.widening[k] = std::log(top.radius / (std::sqrt(x) * body.radius_ratio(s)));
    result.residual[k] = -std::log1p(-top.residual / x);
    result.dissipation[k] = -std::log((returned + below) / (work + below));
  }
  return result;
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

ContactCurve tabulate(const LawShape& shape, double onset, double shape_end, double x_end)
{
  const double s_onset = std::pow(onset, 0.25), q_end = 0.25 * std::log(shape_end / onset);
  const ShapeFunction force_reduction(shape.force_reduction, q_end), widening(shape.widening, q_end),
      residual(shape.residual, q_end, ShapeFunction::Kind::rising),
      dissipation(shape.dissipation, q_end, ShapeFunction::Kind::rising),
      hertz_share(shape.hertz_share, q_end);
  std::vector<double> nodes;
  ContactCurve::Table table = empty_table(s_onset, x_end, nodes);
  table.onset = onset;
  const ElasticCorrection& el = shape.elastic;
  const double h = nodes[1];
  const auto at_onset = static_cast<std::size_t>(std::lround(s_onset / h));
  for (const double s : nodes) {
    const double q = s > s_onset ? std::log(s / s_onset) : 0.0;
    const double per_s = s > 0 ? 1.0 / s : 0.0;  // dq/ds; 0 below the onset anyway
    const double g = el.force_ratio(s) * std::exp(-force_reduction.value(q));
    const double a = el.radius_ratio(s) * std::exp(widening.value(q));
    table.force_ratio.push_back(g);
    table.force_ratio_slope.push_back(
        g * (el.force_ratio_slope(s) / el.force_ratio(s) - force_reduction.slope(q) * per_s));
    table.radius_ratio.push_back(a);
    table.radius_ratio_slope.push_back(
        a * (el.radius_ratio_slope(s) / el.radius_ratio(s) + widening.slope(q) * per_s));
    const double kept = std::exp(-residual.value(q));
    table.residual_ratio.push_back(std::max(0.0, 1 - kept));
    table.residual_ratio_slope.push_back(kept * residual.slope(q) * per_s);
  }
  // n needs the loading work of this very table: build it once with any unloading.
  const std::size_t count = nodes.size();
  table.exponent.assign(count, UnloadingShape{}.exponent);
  table.hertz_share.assign(count, UnloadingShape{}.hertz_share);
  table.exponent_slope.assign(count, 0.0);
  table.hertz_share_slope.assign(count, 0.0);
  const ContactCurve loading(table, "fitted curve");
  const auto yielded = [&](double s) {
    const double x = s * s * s * s, q = std::log(s / s_onset), kept = std::exp(-residual.value(q));
    const ContactCurve::Loading top = loading.loading(x);
    const double returned = loading.work_loading(x) * std::exp(-dissipation.value(q) - rounding_spare);
    const double work = returned / (top.force * x * kept);
    const double fitted = el.unloading(s).hertz_share + hertz_share.value(q);
    const double floored = 0.5 * (fitted + std::hypot(fitted, 2 * least_hertz_share));
    // The work is as computed whatever the Hertz share; with it the Hertz share may not be so small that at
    // its reversal the contact unloads less stiffly than it loads, nor so large that the unloading would
    // fall.
    const double stiff = std::max(UnloadingShape::least_exponent, kept * x * top.stiffness / top.force);
    const double smallest = UnloadingShape::hertz_share_of(work, stiff),
                 largest = UnloadingShape::largest_hertz_share_of(work) - spare_hertz_share;
    const double a = std::clamp(std::max(floored, smallest), 0.0, std::max(0.0, largest));
    return UnloadingShape{std::min(UnloadingShape::exponent_of(work, a),
                                   UnloadingShape::largest_exponent(0) - spare_hertz_share),
                          a};
  };
  const auto elastic = [&](double s) { return el.unloading(s); };
  for (std::size_t k = 0; k < count; ++k) {
    const double s = nodes[k], step = 0.02 * h;
    // one-sided at the ends; the onset's own slope must be the one of the plastic side
    const auto fill = [&](const auto& unloading, bool begins, bool ends) {
      const int from = begins ? 0 : ends ? -2 : -1;
      const UnloadingShape at[3] = {unloading(s + from * step), unloading(s + (from + 1) * step),
                                    unloading(s + (from + 2) * step)};
      const auto slope = [&](double UnloadingShape::*of) {
        const double a = at[0].*of, b = at[1].*of, c = at[2].*of;
        return (begins ? -3 * a + 4 * b - c : ends ? a - 4 * b + 3 * c : c - a) / (2 * step);
      };
      table.exponent[k] = at[-from].exponent;
      table.hertz_share[k] = at[-from].hertz_share;
      table.exponent_slope[k] = slope(&UnloadingShape::exponent);
      table.hertz_share_slope[k] = slope(&UnloadingShape::hertz_share);
    };
    if (k < at_onset)
      fill(elastic, k == 0, false);
    else
      fill(yielded, k == at_onset, k + 1 == count);
  }
  // A cubic whose values are not negative and whose slopes are 3/h of them at most passes nowhere below 0:
  // between two nodes an unloading may meet the bounds of one that rises, Hertz share >= 0 and Hertz share +
  // 4 exponent
  // <= 10.
  for (std::size_t k = 0; k < count; ++k) {
    double &hertz_share_slope = table.hertz_share_slope[k], &exponent_slope = table.exponent_slope[k];
    const double steepest = 3 / h * table.hertz_share[k],
                 room = 3 / h *
                        std::max(0.0,
                                 UnloadingShape::largest_exponent(table.hertz_share[k]) - table.exponent[k]);
    hertz_share_slope = std::clamp(hertz_share_slope, -steepest, steepest);
    exponent_slope =
        std::clamp(exponent_slope, -room - 0.25 * hertz_share_slope, room - 0.25 * hertz_share_slope);
  }
  // 1e-7: returned work must not exceed the work put in just past the onset, not even by rounding.
  for (double& n : table.exponent) n += 1e-7;
  ContactCurve curve(table, "fitted curve");
  require_admissible(curve);
  return curve;
}

ContactCurve::Table tabulate_elastic(const ElasticCorrection& elastic, double x_end)
{
  std::vector<double> nodes;
  ContactCurve::Table table = empty_table(std::numeric_limits<double>::infinity(), x_end, nodes);
  table.onset = std::numeric_limits<double>::infinity();
  for (const double s : nodes) {
    table.force_ratio.push_back(elastic.force_ratio(s));
    table.force_ratio_slope.push_back(elastic.force_ratio_slope(s));
    table.radius_ratio.push_back(elastic.radius_ratio(s));
    table.radius_ratio_slope.push_back(elastic.radius_ratio_slope(s));
    table.exponent.push_back(elastic.unloading(s).exponent);
    table.hertz_share.push_back(elastic.unloading(s).hertz_share);
  }
  table.residual_ratio.assign(nodes.size(), 0.0);
  table.residual_ratio_slope = table.residual_ratio;
  table.exponent_slope = table.hertz_share_slope = table.residual_ratio;
  return table;
}

}  // namespace granulaw
