#include "characterise/fit_curve.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "characterise/smooth_spline.hpp"

namespace granulaw {

namespace {

constexpr double from_share = 0.1;         // of a press's depth: below, the contact spans too few cells
constexpr double target_spacing = 0.0045;  // of table nodes in s: about 128 nodes to x = 0.1

/// Ripple of a sample grows as (cell/contact radius)^1.65 (formulations.md, sect. 3): its weight falls as
/// x^0.8. Samples stand at equal times; what counts is equal steps of ln x.
double weight_of(const Pressing& press, std::size_t k)
{
  const auto& l = press.loading;
  const double before = l[k > 0 ? k - 1 : k].x, after = l[std::min(k + 1, l.size() - 1)].x;
  return std::pow(l[k].x / press.depth, 0.8) * std::sqrt(std::max(1e-9, std::log(after / before)));
}

double hertz_force(double x)
{
  return x * std::sqrt(x);
}

/// The splines of a plastic law, in q = ln(s/s_onset).
struct PlasticFit
{
  double s_onset;
  ElasticCorrection elastic;
  SmoothSpline softening, widening, residual, dissipation;

  double q(double s) const { return std::log(s / s_onset); }
  double force_ratio(double s) const { return elastic.force_ratio(s) * std::exp(softening.value(q(s))); }
  double restitution(double x) const { return std::exp(-0.5 * dissipation.value(q(std::pow(x, 0.25)))); }
};

SmoothSpline turning_spline(std::span<const Pressing> presses, double s_onset, double q_end,
                            double (*of)(const Pressing&))
{
  std::vector<SmoothSpline::Sample> samples;
  for (const Pressing& p : presses)
    samples.push_back({std::log(std::pow(p.depth, 0.25) / s_onset), of(p), 1.0});
  // Few, accurate points: about one knot interval for each, and only enough stiffness to bridge the gaps.
  return {q_end, std::max<int>(4, static_cast<int>(presses.size()) - 2), samples, 0.03};
}

double residual_measure(const Pressing& p)
{
  return -std::log(1 - std::clamp(p.residual / p.depth, 0.0, 0.9999));
}
double dissipation_measure(const Pressing& p)
{
  return -std::log(std::min(1.0, p.work_ratio));
}

PlasticFit fit_splines(std::span<const Pressing> presses, const ElasticCorrection& elastic, double onset,
                       double x_end)
{
  PlasticFit fit{std::pow(onset, 0.25), elastic, {}, {}, {}, {}};
  const double q_end = fit.q(std::pow(x_end, 0.25));
  std::vector<SmoothSpline::Sample> force, radius;
  for (const Pressing& press : presses)
    for (std::size_t k = 0; k < press.loading.size(); ++k) {
      const auto& [x, f, a] = press.loading[k];
      if (x < std::max(onset, from_share * press.depth) || f <= 0 || a <= 0) continue;
      const double s = std::pow(x, 0.25), weight = weight_of(press, k);
      force.push_back({fit.q(s), std::log(f / (hertz_force(x) * elastic.force_ratio(s))), weight});
      radius.push_back({fit.q(s), std::log(a / (std::sqrt(x) * elastic.radius_ratio(s))), weight});
    }
  const int intervals = std::clamp(static_cast<int>(std::lround(q_end / 0.15)), 6, 40);
  fit.softening = SmoothSpline(q_end, intervals, force, 0.02);
  fit.widening = SmoothSpline(q_end, intervals, radius, 0.05);
  fit.residual = turning_spline(presses, fit.s_onset, q_end, residual_measure);
  fit.dissipation = turning_spline(presses, fit.s_onset, q_end, dissipation_measure);
  return fit;
}

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

/// n of an elastic body: F x/W - 1, which makes the work of F_m u^n the work of loading.
double elastic_exponent(const ElasticCorrection& e, double s)
{
  const double y = s * s;  // integral of x^1.5 (1 + c1 x^.5 + c2 x) = x^2.5 (1/2.5 + c1 x^.5/3 + c2 x/3.5)
  return e.force_ratio(s) / (0.4 + e.c1 * y / 3 + e.c2 * y * y / 3.5) - 1;
}

/// Slopes of a smooth function given at uniform nodes from `first` on: fourth-order differences inside,
/// one-sided second order at the ends.
void fill_slopes(const std::vector<double>& value, std::size_t first, std::size_t last, double h,
                 std::vector<double>& slope)
{
  const auto v = [&](std::size_t k) { return value[k]; };
  for (std::size_t k = first; k <= last; ++k) {
    if (k == first)
      slope[k] = (-3 * v(k) + 4 * v(k + 1) - v(k + 2)) / (2 * h);
    else if (k == last)
      slope[k] = (3 * v(k) - 4 * v(k - 1) + v(k - 2)) / (2 * h);
    else if (k == first + 1 || k + 1 == last)
      slope[k] = (v(k + 1) - v(k - 1)) / (2 * h);
    else
      slope[k] = (8 * (v(k + 1) - v(k - 1)) - (v(k + 2) - v(k - 2))) / (12 * h);
  }
}

ContactCurve::Table tabulate(const PlasticFit& fit, double onset, double x_end)
{
  std::vector<double> nodes;
  ContactCurve::Table table = empty_table(fit.s_onset, x_end, nodes);
  table.onset = onset;
  const ElasticCorrection& el = fit.elastic;
  const double h = nodes[1];
  const auto at_onset = static_cast<std::size_t>(std::lround(fit.s_onset / h));
  for (const double s : nodes) {
    const double q = s > fit.s_onset ? fit.q(s) : 0.0;
    const double per_s = s > 0 ? 1.0 / s : 0.0;  // dq/ds; 0 below the onset anyway
    const double g = el.force_ratio(s) * std::exp(fit.softening.value(q));
    const double a = el.radius_ratio(s) * std::exp(fit.widening.value(q));
    table.force_ratio.push_back(g);
    table.force_ratio_slope.push_back(
        g * (el.force_ratio_slope(s) / el.force_ratio(s) + fit.softening.slope(q) * per_s));
    table.radius_ratio.push_back(a);
    table.radius_ratio_slope.push_back(
        a * (el.radius_ratio_slope(s) / el.radius_ratio(s) + fit.widening.slope(q) * per_s));
    const double kept = std::exp(-fit.residual.value(q));
    table.residual_ratio.push_back(1 - kept);
    table.residual_ratio_slope.push_back(kept * fit.residual.slope(q) * per_s);
  }
  // n needs the loading work of this very table: build it once with any exponent.
  const std::size_t count = nodes.size();
  table.exponent.assign(count, 1.5);
  table.exponent_slope.assign(count, 0.0);
  const ContactCurve loading(table, "fitted curve");
  for (std::size_t k = 0; k < count; ++k) {
    const double s = nodes[k], x = s * s * s * s;
    if (k <= at_onset) {
      table.exponent[k] = elastic_exponent(el, s);
      continue;
    }
    const double given_back = loading.work_loading(x) * std::exp(-fit.dissipation.value(fit.q(s)));
    table.exponent[k] = loading.loading(x).force * x * (1 - table.residual_ratio[k]) / given_back - 1;
  }
  fill_slopes(table.exponent, 0, at_onset, h, table.exponent_slope);
  // From the onset on: the onset's own slope must be the one of the plastic side.
  fill_slopes(table.exponent, at_onset, count - 1, h, table.exponent_slope);
  // 1e-7: returned work must not exceed the work put in just past the onset, not even by rounding.
  for (double& n : table.exponent) n += 1e-7;
  return table;
}

FitQuality assess(const PlasticFit& fit, std::span<const Pressing> presses, const ContactCurve& curve,
                  double onset, double x_end)
{
  FitQuality quality;
  double sum = 0;
  int count = 0;
  for (const Pressing& press : presses) {
    for (const auto& [x, f, a] : press.loading) {
      if (x < std::max(onset, 0.5 * press.depth) || x > curve.x_end()) continue;
      const double relative = f / curve.loading(x).force - 1;
      sum += relative * relative;
      ++count;
    }
    quality.turning_error = std::max(
        quality.turning_error, std::abs(fit.restitution(press.depth) / std::sqrt(press.work_ratio) - 1));
  }
  quality.scatter = count ? std::sqrt(sum / count) : 0;
  const double s_end = std::pow(x_end, 0.25);
  for (int k = 1; k < 2000; ++k) {
    const double s = s_end * k / 2000, x = s * s * s * s;
    const double exact = hertz_force(x) * (s > fit.s_onset ? fit.force_ratio(s) : fit.elastic.force_ratio(s));
    quality.table_error = std::max(quality.table_error, std::abs(curve.loading(x).force / exact - 1));
  }
  // Each turning depth but the last left out in turn; the last would be extrapolation.
  for (std::size_t left_out = 0; left_out + 1 < presses.size() && presses.size() > 3; ++left_out) {
    std::vector<Pressing> others;
    for (std::size_t k = 0; k < presses.size(); ++k)
      if (k != left_out) others.push_back({{}, presses[k].depth, presses[k].residual, presses[k].work_ratio});
    const SmoothSpline d = turning_spline(others, fit.s_onset, fit.q(s_end), dissipation_measure);
    const double e = std::exp(-0.5 * d.value(fit.q(std::pow(presses[left_out].depth, 0.25))));
    quality.held_out = std::max(quality.held_out, std::abs(e / std::sqrt(presses[left_out].work_ratio) - 1));
  }
  return quality;
}

}  // namespace

Pressing pressing_from(const RunResult& result)
{
  Pressing press;
  press.depth = result.summary.delta_max;
  press.residual = std::max(0.0, result.summary.delta_residual);
  press.work_ratio = result.summary.work_unload / result.summary.work_load;
  for (const TraceSample& t : result.trace)
    if (t.branch == Branch::load && t.delta > (press.loading.empty() ? 0.0 : press.loading.back().x))
      press.loading.push_back({t.delta, 0.75 * t.force, t.contact_radius});  // F/(4/3 E* R^2)
  return press;
}

ElasticCorrection fit_elastic(const Pressing& press)
{
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < press.loading.size(); ++k)
    if (press.loading[k].x >= from_share * press.depth) used.push_back(k);
  if (used.size() < 10)
    fail("fit", "too few samples in the elastic press", std::to_string(used.size()), "10 or more");
  Eigen::MatrixXd a(used.size(), 2);
  Eigen::VectorXd b(used.size()), root(used.size()), r(used.size());
  for (std::size_t k = 0; k < used.size(); ++k) {
    const auto& [x, f, radius] = press.loading[used[k]];
    const double w = weight_of(press, used[k]);
    const auto row = static_cast<Eigen::Index>(k);
    a(row, 0) = w * std::sqrt(x);
    a(row, 1) = w * x;
    b(row) = w * (f / hertz_force(x) - 1);
    root(row) = w * std::sqrt(x);
    r(row) = w * (radius / std::sqrt(x) - 1);
  }
  const Eigen::VectorXd c = a.colPivHouseholderQr().solve(b);
  return {c(0), c(1), root.dot(r) / root.dot(root)};
}

FittedCurve fit_plastic(std::span<const Pressing> presses, const ElasticCorrection& elastic, double onset,
                        double x_end)
{
  if (presses.size() < 3) fail("fit", "too few presses", std::to_string(presses.size()), "3 or more");
  const PlasticFit fit = fit_splines(presses, elastic, onset, x_end);
  FittedCurve result{tabulate(fit, onset, x_end), {}};
  const ContactCurve curve(result.table, "fitted curve");
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
  result.quality = assess(fit, presses, curve, onset, x_end);
  return result;
}

FittedCurve table_elastic(const ElasticCorrection& elastic, double x_end)
{
  std::vector<double> nodes;
  ContactCurve::Table table = empty_table(std::numeric_limits<double>::infinity(), x_end, nodes);
  table.onset = std::numeric_limits<double>::infinity();
  for (const double s : nodes) {
    table.force_ratio.push_back(elastic.force_ratio(s));
    table.force_ratio_slope.push_back(elastic.force_ratio_slope(s));
    table.radius_ratio.push_back(elastic.radius_ratio(s));
    table.radius_ratio_slope.push_back(elastic.radius_ratio_slope(s));
    table.exponent.push_back(elastic_exponent(elastic, s));
  }
  table.residual_ratio.assign(nodes.size(), 0.0);
  table.residual_ratio_slope = table.residual_ratio;
  table.exponent_slope.assign(nodes.size(), 0.0);
  return {table, {}};
}

}  // namespace granulaw
