#include "characterise/fit/fit_curve.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "atlas/spline.hpp"

namespace granulaw {

namespace {

/// Share of an elastic press's depth below which the contact spans too few cells.
constexpr double elastic_from = 0.1;
/// The same where it yields. The contact spans 24 cells at the press's depth, 14 at a third of it; below, its
/// force is low: by 0.7 % at a quarter to an eighth, against impacts that end there (E*/Y = 500). A third
/// leaves 0.28 % (rms) of F_max in 60 of the atlas's checks, a tenth 0.33 %, a half, with too few samples
/// left, 0.31 %.
constexpr double yielded_from = 1. / 3;

/// Grid noise of a sample grows as (cell/contact radius)^1.65 (formulations.md, sect. 3): its weight falls as
/// x^0.8. Samples stand at equal times; what counts is equal steps of ln x.
double weight_of(const ContactRecord& press, std::size_t k)
{
  const auto& l = press.loading;
  const double before = l[k > 0 ? k - 1 : k].x, after = l[std::min(k + 1, l.size() - 1)].x;
  return std::pow(l[k].x / press.depth, 0.8) * std::sqrt(std::max(1e-9, std::log(after / before)));
}

double hertz_force(double x)
{
  return x * std::sqrt(x);
}

/// ln(s/s_onset) of an overlap.
double q_of(double x, double onset)
{
  return 0.25 * std::log(x / onset);
}

/// Loading force of a slow press; `force_reduction`: -ln(F/F_elastic) over q.
double press_force_at(double x, const ElasticCorrection& elastic, const auto& force_reduction, double onset)
{
  return hertz_force(x) * elastic.force_ratio(std::pow(x, 0.25)) *
         std::exp(-force_reduction.value(q_of(x, onset)));
}

/// `ratio`: delta_r/delta_m.
double residual_measure(double ratio)
{
  return -std::log(1 - std::clamp(ratio, 0.0, 0.99999));
}
double dissipation_measure(const ContactRecord& p)
{
  return -std::log(std::clamp(p.work_ratio, 1e-6, 1.0));
}

/// A of an unloading from x along the elastic curve.
double elastic_hertz_share(const ElasticCorrection& elastic, double x)
{
  return elastic.unloading(std::pow(x, 0.25)).hertz_share;
}

using Samples = std::vector<Spline::Sample>;

/// Adds what a prior knows of one function below the first run.
void add_prior(Samples& samples, const ShapePrior* prior, std::vector<double> LawShape::*function,
               double q_first, double q_end, double weight)
{
  if (!prior) return;
  const std::vector<double>& values = prior->shape.*function;
  const auto last = static_cast<double>(values.size() - 1);
  for (std::size_t k = 1; k < values.size() && std::isfinite(prior->error[k]); ++k)
    if (const double q = q_end * static_cast<double>(k) / last; q < q_first)
      samples.push_back({q, values[k], weight});
}

/// A reversal point's function of q: few accurate points, about one knot interval for each. `smoothing`: 0.03
/// is only enough to bridge gaps.
Spline reversal_spline(std::span<const ContactRecord> presses, double onset, double q_end,
                             const auto& of, const ShapePrior* prior, std::vector<double> LawShape::*function,
                             double smoothing = 0.03)
{
  Samples samples;
  double q_first = q_end;
  for (const ContactRecord& p : presses) {
    samples.push_back({q_of(p.depth, onset), of(p), 1.0});
    q_first = std::min(q_first, samples.back().q);
  }
  add_prior(samples, prior, function, q_first, q_end, 1.0);
  const int intervals = std::max(4, static_cast<int>(samples.size()) - 2);
  return Spline::fit(samples, q_end, std::min(intervals, 24), smoothing);
}

/// ln(F/F_press) of an impact at shares of its overlap: a least-squares polynomial in sqrt(share), which
/// cannot follow the grid noise, but follows the body's ringing: with six terms F_max of 314 checks was off
/// by 0.40 % (rms), with eight by 0.37, with ten by 0.36. Below the first share that the grid resolves it
/// keeps its value. At its reversal it has the impact's peak: which takes 700 checks of F_max from 0.27 % off
/// to 0.23. A rate-dependent impact peaks before it reverses, and falls; a law rises until then.
std::vector<double> impact_force_ratios(const ContactRecord& impact, const auto& press_force)
{
  constexpr int terms = 10;
  constexpr double first = 0.04;
  const auto basis = [first](double share, int k) { return std::pow(std::max(share, first), 0.5 * k); };
  std::vector<const ContactRecord::Sample*> used;
  for (const ContactRecord::Sample& s : impact.loading)
    if (s.x >= first * impact.depth && s.force > 0) used.push_back(&s);
  if (used.size() < 3 * terms)
    fail("fit", "too few samples in an impact", std::to_string(used.size()),
         fmt::format("{} or more", 3 * terms));
  Eigen::MatrixXd a(used.size(), terms);
  Eigen::VectorXd b(used.size());
  for (Eigen::Index row = 0; row < a.rows(); ++row) {
    const ContactRecord::Sample& s = *used[static_cast<std::size_t>(row)];
    for (int k = 0; k < terms; ++k) a(row, k) = basis(s.x / impact.depth, k);
    b(row) = std::log(s.force / press_force(s.x));
  }
  const Eigen::VectorXd c = a.colPivHouseholderQr().solve(b);
  std::vector<double> values;
  for (int n = 0; n < LawShape::VelocityEffect::shares; ++n) {
    const double share = static_cast<double>(n) / (LawShape::VelocityEffect::shares - 1);
    double value = 0;
    for (int k = 0; k < terms; ++k) value += c(k) * basis(share, k);
    values.push_back(value);
  }
  if (impact.peak > 0) values.back() = std::log(impact.peak / press_force(impact.depth));
  return values;
}

}  // namespace

namespace {

/// `terms` of the force: 2 or 3.
ElasticCorrection fit_elastic_terms(std::span<const ContactRecord> presses, int terms)
{
  struct Used
  {
    const ContactRecord* press;
    std::size_t k;
  };
  std::vector<Used> used;
  for (const ContactRecord& press : presses)
    for (std::size_t k = 0; k < press.loading.size(); ++k)
      if (press.loading[k].x >= elastic_from * press.depth) used.push_back({&press, k});
  if (used.size() < 10)
    fail("fit", "too few samples in the elastic press", std::to_string(used.size()), "10 or more");
  const auto rows = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd a(rows, terms);
  Eigen::VectorXd b(rows), root(rows), r(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto& [press, k] = used[static_cast<std::size_t>(row)];
    const auto& [x, f, radius] = press->loading[k];
    const double w = weight_of(*press, k);
    for (int term = 0; term < terms; ++term) a(row, term) = w * std::pow(x, 0.5 * (term + 1));
    b(row) = w * (f / hertz_force(x) - 1);
    root(row) = w * std::sqrt(x);
    r(row) = w * (radius / std::sqrt(x) - 1);
  }
  const Eigen::VectorXd c = a.colPivHouseholderQr().solve(b);
  return {c(0), c(1), root.dot(r) / root.dot(root), terms > 2 ? c(2) : 0.0};
}

}  // namespace

ElasticCorrection fit_elastic(const ContactRecord& press)
{
  return fit_elastic_terms({&press, 1}, 2);
}

ElasticCorrection measured_elastic(const ContactRecord& press, std::span<const ContactRecord> slow,
                                   double onset)
{
  ElasticCorrection elastic = fit_elastic(press);
  Samples samples;
  const auto take = [&](const ContactRecord& run, double end) {
    for (std::size_t k = 0; k < run.loading.size(); ++k) {
      const auto& [x, f, radius] = run.loading[k];
      if (x < elastic_from * run.depth || x > end || f <= 0) continue;
      const double s = std::pow(x, 0.25);
      samples.push_back({s, std::log(f / (hertz_force(x) * elastic.force_ratio(s))), weight_of(run, k)});
    }
  };
  take(press, press.depth);
  for (const ContactRecord& run : slow) take(run, onset);
  // As a function of s = x^(1/4) it begins with zero value and slope; the contact radius goes as s^2, so that
  // a layer of 0.01 R or more is as thick as several knots.
  constexpr int intervals = 24;
  const double end = std::pow(press.depth, 0.25);
  elastic.measured = std::make_shared<const Spline>(Spline::fit(samples, end, intervals, 0.02));
  return elastic;
}

ElasticFit fit_elastic(std::span<const ContactRecord> presses)
{
  ElasticFit fit{fit_elastic_terms(presses, 3)};
  for (const ContactRecord& press : presses) {
    constexpr int parts = 8;  // of the contact radius between a third of it and all: two cells and more each
    double sum[parts] = {};
    int count[parts] = {};
    for (const auto& [x, f, radius] : press.loading) {
      const double place = (std::sqrt(x / press.depth) - 1. / 3) * 1.5 * parts;
      if (place < 0) continue;
      const int part = std::min(static_cast<int>(place), parts - 1);
      sum[part] += f / (hertz_force(x) * fit.correction.force_ratio(std::pow(x, 0.25))) - 1;
      ++count[part];
    }
    for (int part = 0; part < parts; ++part)
      if (count[part] > 0) fit.error = larger(fit.error, std::abs(sum[part] / count[part]));
  }
  return fit;
}

std::vector<LawShape::VelocityEffect> fit_velocity_effects(std::span<const ContactRecords::Impact> impacts,
                                                           const LawShape& slow, double onset, double x_end)
{
  const double q_end = q_of(x_end, onset);
  const Spline force_reduction = Spline::through(slow.force_reduction, q_end),
               residual = Spline::through(slow.residual, q_end),
               dissipation = Spline::through(slow.dissipation, q_end),
               hertz_share = Spline::through(slow.hertz_share, q_end);
  const auto press_force = [&](double x) { return press_force_at(x, slow.elastic, force_reduction, onset); };
  std::vector<LawShape::VelocityEffect> all;
  for (const auto& [speed, impact] : impacts) {
    const double q = q_of(impact.depth, onset);
    // an impact's unloading swings with the body: it has the press's Hertz coefficient
    double residual_overlap = impact.residual;
    if (!impact.unloading.empty())
      residual_overlap = std::max(
          0.0, residual_as_long(
                   impact.unloading, impact.reversal_force,
                   std::max(0.0, elastic_hertz_share(slow.elastic, impact.depth) + hertz_share.value(q))));
    LawShape::VelocityEffect effect{speed, std::log(impact.depth / speed), 0, 0,
                                    impact_force_ratios(impact, press_force)};
    effect.dissipation = dissipation_measure(impact) - dissipation.value(q);
    effect.residual = residual_measure(residual_overlap / impact.depth) - residual.value(q);
    all.push_back(std::move(effect));
  }
  return all;
}

namespace {

/// One fit: what its steps share.
struct ShapeFit
{
  const ContactRecords& records;
  const ElasticCorrection& elastic;
  double onset, x_end, q_end;
  const ShapePrior* prior;
  Spline force_reduction, widening;
  std::vector<ContactRecord> reversals;  ///< those beyond the onset

  ShapeFit(const ContactRecords& found, const ElasticCorrection& correction, double begin, double end,
           const ShapePrior* known)
      : records(found), elastic(correction), onset(begin), x_end(end), q_end(q_of(end, begin)), prior(known)
  {
  }
  double press_force(double x) const { return press_force_at(x, elastic, force_reduction, onset); }
  void fit_loading();
  void correct_reversals();
  Spline dissipation(std::span<const ContactRecord> points) const
  {
    return reversal_spline(points, onset, q_end, dissipation_measure, prior, &LawShape::dissipation);
  }
  LawShape shape() const;
  double scatter() const;
  FitQuality quality() const;
};

void ShapeFit::fit_loading()
{
  Samples force, radius;
  double q_first = q_end;
  for (const ContactRecord& press : records.slow)
    for (std::size_t k = 0; k < press.loading.size(); ++k) {
      const auto& [x, f, a] = press.loading[k];
      if (x < std::max(onset, yielded_from * press.depth) || f <= 0 || a <= 0) continue;
      const double s = std::pow(x, 0.25), q = q_of(x, onset), weight = weight_of(press, k);
      force.push_back({q, -std::log(f / (hertz_force(x) * elastic.force_ratio(s))), weight});
      radius.push_back({q, std::log(a / (std::sqrt(x) * elastic.radius_ratio(s))), weight});
      q_first = std::min(q_first, q);
    }
  if (prior) {
    // as much as a press's samples would weigh there, all in all
    double weights = 0;
    for (const auto& s : force) weights += s.weight * s.weight;
    const double weight = std::sqrt(weights / (LawShape::nodes * std::max(0.1, 1 - q_first / q_end)));
    add_prior(force, prior, &LawShape::force_reduction, q_first, q_end, weight);
    add_prior(radius, prior, &LawShape::widening, q_first, q_end, weight);
  }
  const int intervals = std::clamp(static_cast<int>(std::lround(q_end / 0.15)), 6, 40);
  force_reduction = Spline::fit(force, q_end, intervals, 0.02);
  widening = Spline::fit(radius, q_end, intervals, 0.05);
}

/// The recovered work follows the force at the reversal, which swings with the contact edge about the law:
/// only the fraction that is lost depends on it.
void ShapeFit::correct_reversals()
{
  for (const ContactRecord& p : records.slow)
    if (p.depth > onset && p.reversal_counts) reversals.push_back(p);
  if (reversals.size() < 3)
    fail("fit", "too few reversal points beyond the onset of yield", std::to_string(reversals.size()),
         "3 or more");
  for (ContactRecord& p : reversals)
    if (p.reversal_force > 0)
      p.work_ratio *= 1 + (press_force(p.depth) / p.reversal_force - 1) * (1 - p.work_ratio);
}

LawShape ShapeFit::shape() const
{
  LawShape shape = LawShape::zero(onset, x_end);
  shape.elastic = elastic;
  shape.force_reduction = force_reduction.values(LawShape::nodes);
  shape.widening = widening.values(LawShape::nodes);
  const auto residual = [](const ContactRecord& p) { return residual_measure(p.residual / p.depth); };
  const auto hertz_share = [&](const ContactRecord& p) {
    return p.hertz_share - elastic_hertz_share(elastic, p.depth);
  };
  shape.residual =
      reversal_spline(reversals, onset, q_end, residual, prior, &LawShape::residual).values(LawShape::nodes);
  shape.dissipation = dissipation(reversals).values(LawShape::nodes);
  // The contact edge's grid noise of a per cent of F moves a Hertz coefficient by 0.3.
  constexpr double smoothing = 0.1;
  shape.hertz_share =
      reversal_spline(reversals, onset, q_end, hertz_share, prior, &LawShape::hertz_share, smoothing)
          .values(LawShape::nodes);
  shape.velocity_effects = fit_velocity_effects(records.fast, shape, onset, x_end);
  return shape;
}

/// Rms of the presses' loading samples about the fit, over the upper half of each.
double ShapeFit::scatter() const
{
  double sum = 0;
  int count = 0;
  for (const ContactRecord& press : records.slow)
    for (const auto& [x, f, a] : press.loading)
      if (x >= std::max(onset, 0.5 * press.depth) && x <= x_end) {
        sum += std::pow(f / press_force(x) - 1, 2);
        ++count;
      }
  return count ? std::sqrt(sum / count) : 0;
}

FitQuality ShapeFit::quality() const
{
  FitQuality quality;
  quality.scatter = scatter();
  const Spline fitted = dissipation(reversals);
  for (const ContactRecord& p : reversals) {
    const double missed = fitted.value(q_of(p.depth, onset)) - dissipation_measure(p);
    quality.reversal_error = larger(quality.reversal_error, std::abs(std::expm1(-0.5 * missed)));
  }
  return quality;
}

}  // namespace

FittedShape fit_shape(const ContactRecords& records, const ElasticCorrection& elastic, double onset,
                      double x_end, const ShapePrior* prior)
{
  if (records.slow.size() < 3)
    fail("fit", "too few reversal points", std::to_string(records.slow.size()), "3 or more");
  ShapeFit fit(records, elastic, onset, x_end, prior);
  fit.fit_loading();
  fit.correct_reversals();
  const FittedShape fitted{fit.shape(), fit.quality()};
  // Smoothing differs from a run by a per cent at most; what differs by more contradicts its neighbours.
  constexpr double contradiction = 0.05;
  if (fitted.quality.reversal_error > contradiction)
    fail("fit", "the runs contradict each other: e of one differs from the smooth law of all",
         fmt::format("by {:.2g} %", 100 * fitted.quality.reversal_error),
         fmt::format("up to {:.0f} %", 100 * contradiction));
  return fitted;
}

FittedCurve fit_plastic(const std::vector<ContactRecord>& presses, const ElasticCorrection& elastic,
                        double onset, double x_end)
{
  ContactRecords records;
  records.slow = presses;
  const FittedShape fitted = fit_shape(records, elastic, onset, x_end);
  const Curve curve = tabulate(fitted.shape, x_end);
  return {curve, fitted.quality, table_error(fitted.shape, curve)};
}

}  // namespace granulaw
