#include "characterise/fit/fit_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "atlas/departure.hpp"
#include "atlas/speed_interpolation.hpp"
#include "atlas/fit_spline.hpp"
#include "linear/linear.hpp"

namespace granulaw {

namespace {

/// Share of an elastic press's depth below which the contact spans too few cells.
constexpr double elastic_from = 0.1;
/// The same where it yields. The contact spans 24 cells at the press's depth, 14 at a third of it; below, its
/// force is low: by 0.7 % at a quarter to an eighth, against impacts that end there (E*/Y = 500). A third
/// leaves 0.28 % (rms) of F_max in 60 of the atlas's checks, a tenth 0.33 %, a half, with too few samples
/// left, 0.31 %.
constexpr double yielded_from = 1. / 3;

/// Grid noise of a sample grows as (cell/contact radius)^1.65 (docs/develop/notes.md): its weight falls as
/// x^0.8.
double resolution_weight(double x, double depth)
{
  return std::pow(x / depth, 0.8);
}

/// Samples stand at equal times; what counts is equal steps of ln x.
double weight_of(const ContactRecord& press, std::size_t k)
{
  const auto& l = press.loading;
  const double before = l[k > 0 ? k - 1 : k].x, after = l[std::min(k + 1, l.size() - 1)].x;
  return resolution_weight(l[k].x, press.depth) * std::sqrt(std::max(1e-9, std::log(after / before)));
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

/// k - k_elastic of an unloading's radius at sqrt(u) = j/3.
double radius_measure(const ContactRecord& p, const ElasticCorrection& elastic, std::size_t j)
{
  return p.radius.k[j] - elastic.unloading_radius(std::pow(p.depth, 0.25), static_cast<double>(j) / 3);
}

/// A of an unloading from x along the elastic curve.
double elastic_hertz_share(const ElasticCorrection& elastic, double x)
{
  return elastic.unloading(std::pow(x, 0.25)).hertz_share;
}

using Samples = std::vector<SplineSample>;

/// Adds one function of a law that is known below the first run.
void add_known(Samples& samples, const LawShape* known, std::vector<double> LawShape::*function, double q_first,
               double q_end, double weight)
{
  if (!known) return;
  const std::vector<double>& values = known->*function;
  const auto last = static_cast<double>(values.size() - 1);
  for (std::size_t k = 1; k < values.size(); ++k)
    if (const double q = q_end * static_cast<double>(k) / last; q < q_first)
      samples.push_back({q, values[k], weight});
}

/// A reversal point's function of q: few accurate points, about one knot interval for each. `smoothing`: 0.03
/// is only enough to bridge gaps. `fewer_cells`: power of the depth over the press's with which a reversal counts.
Spline reversal_spline(std::span<const ContactRecord> presses, double onset, double q_end,
                             const auto& of, const LawShape* known, std::vector<double> LawShape::*function,
                             double smoothing = 0.03, double fewer_cells = 0)
{
  Samples samples;
  double q_first = q_end;
  for (const ContactRecord& p : presses) {
    samples.push_back({q_of(p.depth, onset), of(p), p.run_depth > 0 ? std::pow(p.depth / p.run_depth, fewer_cells) : 1.0});
    q_first = std::min(q_first, samples.back().q);
  }
  add_known(samples, known, function, q_first, q_end, 1.0);
  const int intervals = std::max(4, static_cast<int>(samples.size()) - 2);
  return fit_spline(samples, q_end, std::min(intervals, 24), smoothing);
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
  const Eigen::VectorXd c = least_squares(a, b);
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
  const Eigen::VectorXd c = least_squares(a, b);
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
  elastic.measured = std::make_shared<const Spline>(fit_spline(samples, end, intervals, 0.02));
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
  const LawShape* known;                   ///< without a guide: the law below the first run; null: none
  bool guided;
  LawShape shape;                          ///< the guide, or 0; becomes the law's
  std::vector<ContactRecord> reversals{};  ///< those beyond the onset

  FittedShape run()
  {
    fit_loading();
    correct_reversals();
    fit_reversals();
    return {shape, quality()};
  }

 private:
  void fit_loading();
  void correct_reversals();
  void fit_reversals();
  double scatter() const;
  FitQuality quality() const;
  Spline force_reduction() const { return shape.by_q(&LawShape::force_reduction); }
  double q_end() const { return shape.q(shape.end); }
  void add_departure(const std::array<Samples, LawShape::function_count>& samples);
};

/// Adds what runs differ by from the guide.
void ShapeFit::add_departure(const std::array<Samples, LawShape::function_count>& samples)
{
  Departure::Points points;
  for (std::size_t f = 0; f < points.size(); ++f) {
    const Spline of_guide = shape.by_q(LawShape::functions[f]);
    for (const SplineSample& s : samples[f])
      points[f].push_back({std::exp(4 * s.q), s.value - of_guide.value(s.q), s.weight});
  }
  Departure(points).add_to(shape);
}

void ShapeFit::fit_loading()
{
  Samples force, radius;
  double q_first = q_end();
  for (const ContactRecord& press : records.slow)
    for (std::size_t k = 0; k < press.loading.size(); ++k) {
      const auto& [x, f, a] = press.loading[k];
      if (x < std::max(shape.onset, yielded_from * press.depth) || f <= 0 || a <= 0) continue;
      const double s = std::pow(x, 0.25), q = shape.q(x), weight = weight_of(press, k);
      force.push_back({q, -std::log(f / (hertz_force(x) * shape.elastic.force_ratio(s))), weight});
      radius.push_back({q, std::log(a / (std::sqrt(x) * shape.elastic.radius_ratio(s))), weight});
      q_first = std::min(q_first, q);
    }
  if (guided) return add_departure({force, radius});
  if (known) {
    // as much as a press's samples would weigh there, all in all
    double weights = 0;
    for (const auto& s : force) weights += s.weight * s.weight;
    const double weight = std::sqrt(weights / (LawShape::nodes * std::max(0.1, 1 - q_first / q_end())));
    add_known(force, known, &LawShape::force_reduction, q_first, q_end(), weight);
    add_known(radius, known, &LawShape::widening, q_first, q_end(), weight);
  }
  const int intervals = std::clamp(static_cast<int>(std::lround(q_end() / 0.15)), 6, 40);
  shape.force_reduction = fit_spline(force, q_end(), intervals, 0.02).values(LawShape::nodes);
  shape.widening = fit_spline(radius, q_end(), intervals, 0.05).values(LawShape::nodes);
}

/// The recovered work follows the force at the reversal, which swings with the contact edge about the law:
/// only the fraction that is lost depends on it.
void ShapeFit::correct_reversals()
{
  for (const ContactRecord& p : records.slow)
    if (p.depth > shape.onset) reversals.push_back(p);
  if (reversals.size() < 3 && !guided)
    fail("fit", "too few reversal points beyond the onset of yield", std::to_string(reversals.size()),
         "3 or more");
  const Spline reduction = force_reduction();
  for (ContactRecord& p : reversals)
    if (p.reversal_force > 0)
      p.work_ratio *= 1 + (press_force_at(p.depth, shape.elastic, reduction, shape.onset) / p.reversal_force - 1) *
                              (1 - p.work_ratio);
}

void ShapeFit::fit_reversals()
{
  const auto residual = [](const ContactRecord& p) { return residual_measure(p.residual / p.depth); };
  const auto hertz_share = [&](const ContactRecord& p) {
    return p.hertz_share - elastic_hertz_share(shape.elastic, p.depth);
  };
  if (guided) {
    std::array<Samples, LawShape::function_count> samples;
    for (const ContactRecord& p : reversals) {
      const double q = shape.q(p.depth), weight = resolution_weight(p.depth, p.run_depth);
      samples[2].push_back({q, residual(p), weight});
      samples[3].push_back({q, dissipation_measure(p), weight});
      samples[4].push_back({q, hertz_share(p), weight});
      for (std::size_t j = 0; j < 3; ++j)
        samples[LawShape::first_radius + j].push_back({q, radius_measure(p, shape.elastic, j), weight});
    }
    add_departure(samples);
  } else {
    const auto spline = [&](const auto& of, std::vector<double> LawShape::*function, double smoothing) {
      shape.*function = reversal_spline(reversals, shape.onset, q_end(), of, known, function, smoothing)
                            .values(LawShape::nodes);
    };
    spline(residual, &LawShape::residual, 0.03);
    spline(dissipation_measure, &LawShape::dissipation, 0.03);
    // The contact edge's grid noise of a per cent of F moves a Hertz coefficient by 0.3.
    spline(hertz_share, &LawShape::hertz_share, 0.1);
    fit_radii(shape, reversals, known);
  }
  shape.velocity_effects = fit_velocity_effects(records.fast, shape, shape.onset, shape.end);
}

/// Rms of the presses' loading samples about the fit, over the upper half of each.
double ShapeFit::scatter() const
{
  double sum = 0;
  int count = 0;
  const Spline reduction = force_reduction();
  for (const ContactRecord& press : records.slow)
    for (const auto& [x, f, a] : press.loading)
      if (x >= std::max(shape.onset, 0.5 * press.depth) && x <= shape.end) {
        sum += std::pow(f / press_force_at(x, shape.elastic, reduction, shape.onset) - 1, 2);
        ++count;
      }
  return count ? std::sqrt(sum / count) : 0;
}

FitQuality ShapeFit::quality() const
{
  FitQuality quality;
  quality.scatter = scatter();
  const Spline fitted = shape.by_q(&LawShape::dissipation);
  for (const ContactRecord& p : reversals) {
    const double missed = fitted.value(shape.q(p.depth)) - dissipation_measure(p);
    quality.reversal_error = larger(quality.reversal_error, std::abs(std::expm1(-0.5 * missed)));
  }
  return quality;
}

FittedShape checked(const FittedShape& fitted)
{
  // Smoothing differs from a run by a per cent at most; what differs by more contradicts its neighbours.
  constexpr double contradiction = 0.05;
  if (fitted.quality.reversal_error > contradiction)
    fail("fit", "the runs contradict each other: e of one differs from the smooth law of all",
         fmt::format("by {:.2g} %", 100 * fitted.quality.reversal_error),
         fmt::format("up to {:.0f} %", 100 * contradiction));
  return fitted;
}

}  // namespace

void fit_radii(LawShape& shape, std::span<const ContactRecord> reversals, const LawShape* known)
{
  // The contact edge's grid noise moves k by a few per cent, and by tenths where a press passes with half of its cells:
  // such a reversal counts as its depth over the press's to this power.
  constexpr double smoothing = 0.1, fewer_cells = 1.6;
  for (std::size_t j = 0; j < 3; ++j) {
    const auto function = LawShape::functions[LawShape::first_radius + j];
    shape.*function = reversal_spline(reversals, shape.onset, shape.q(shape.end),
                                      [&](const ContactRecord& p) { return radius_measure(p, shape.elastic, j); }, known,
                                      function, smoothing, fewer_cells)
                          .values(LawShape::nodes);
  }
}

ContactRecord without_inertia(const ContactRecord& impact, std::span<const LawShape::VelocityEffect> effects)
{
  std::vector<double> speeds;
  for (const LawShape::VelocityEffect& e : effects) speeds.push_back(e.speed);
  const SpeedInterpolation between(speeds, AxisTable::By::inertia);
  const auto effect = [&](const auto& of) {
    return between.at(impact.speed, [&](std::size_t j) { return of(effects[j]); });
  };
  std::vector<double> force;
  for (std::size_t n = 0; n < LawShape::VelocityEffect::shares; ++n)
    force.push_back(effect([n](const LawShape::VelocityEffect& e) { return e.force[n]; }));
  ContactRecord slow = impact;
  slow.speed = 0;
  const auto last = static_cast<double>(force.size() - 1);
  for (ContactRecord::Sample& s : slow.loading) {
    const double place = std::min(s.x / slow.depth, 1.0) * last;
    const auto k = std::min(static_cast<std::size_t>(place), force.size() - 2);
    s.force /= std::exp(force[k] + (place - static_cast<double>(k)) * (force[k + 1] - force[k]));
  }
  slow.peak /= std::exp(force.back()), slow.reversal_force /= std::exp(force.back());
  slow.work_ratio *= std::exp(effect([](const LawShape::VelocityEffect& e) { return e.dissipation; }));
  slow.residual = slow.depth * (1 - (1 - slow.residual / slow.depth) *
                                        std::exp(effect([](const LawShape::VelocityEffect& e) { return e.residual; })));
  return slow;
}

FittedShape fit_shape(const ContactRecords& records, const ElasticCorrection& elastic, double onset,
                      double x_end, const LawShape* known)
{
  if (records.slow.size() < 3)
    fail("fit", "too few reversal points", std::to_string(records.slow.size()), "3 or more");
  LawShape shape = LawShape::zero(onset, x_end);
  shape.elastic = elastic;
  return checked(ShapeFit{records, known, false, std::move(shape)}.run());
}

FittedShape fit_about(const LawShape& guide, const ContactRecords& records)
{
  return checked(ShapeFit{records, nullptr, true, guide}.run());
}

}  // namespace granulaw
