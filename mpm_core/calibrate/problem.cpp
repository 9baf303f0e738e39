#include "calibrate/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "calibrate/atlas_errors.hpp"

namespace granulaw {

namespace {

using Unknown = CalibrationProblem::Unknown;

constexpr double wall_steepness = 100;  // residual for a factor e beyond what is allowed
constexpr double robust_from = 3;       // sd from which a datum counts in proportion
constexpr double furthest_log = 100;    // of a modulus: a search tries anything, and its ratios stay finite
constexpr Range solid_modulus{1e3, 1e13};  // Pa; gels, and eight times diamond
constexpr double normal95 = 1.959964;      // sd on either side of the mean that hold 95 %

double largest_displacement(const Measurement& m)
{
  return m.data[m.reversal()].x;
}

double largest_force(const Measurement& m)
{
  double most = 0;
  for (const Datum& d : m.data) most = std::max(most, d.y);
  return most;
}

/// Huber's loss as a residual whose square it is.
double tempered(double r)
{
  const double size = std::abs(r);
  return size <= robust_from
             ? r
             : std::copysign(std::sqrt(2 * robust_from * size - robust_from * robust_from), r);
}

/// Overlap of one contact over R* at which its law ends.
double deepest_of(const Measurement& m)
{
  if (m.kind == MeasurementKind::platens) return MidplaneShapes::depth;
  if (m.kind == MeasurementKind::flat) return Atlas::depth;
  // where an elastic contact would be as wide as composed laws go, 0.9 of the smaller radius; others are
  // wider
  const double widest = 0.9 * std::min(m.radius, m.indenter_radius) / m.effective_radius();
  return std::min(Atlas::depth, widest * widest);
}

/// The parameters of the hardening law are fitted or given, no other law's are fitted.
void check_hardening(const CalibrationRequest& r)
{
  const std::vector<Parameter> own = parameters_of(r.known.hardening);
  const auto has = [](const std::vector<Parameter>& all, Parameter p) {
    return std::find(all.begin(), all.end(), p) != all.end();
  };
  std::vector<std::string> known{name_of(Parameter::youngs_modulus), name_of(Parameter::yield_stress)};
  for (const Parameter p : own) known.emplace_back(name_of(p));
  for (const Parameter p : r.fit)
    if (p != Parameter::youngs_modulus && p != Parameter::yield_stress && !has(own, p))
      fail("calibrate", fmt::format("{} is no parameter of this hardening law", name_of(p)),
           r.known.hardens_linearly() ? "linear" : r.known.hardening, list_of(known));
  if (r.known.hardens_linearly()) return;
  for (const Parameter p : own)
    if (!has(r.fit, p) && !(value_of(r.known, p) > 0))
      fail("calibrate", fmt::format("{} is neither to be fitted nor given", name_of(p)));
  for (const Measurement& m : r.measurements)
    if (m.wall || m.ball || m.kind == MeasurementKind::indenter)
      fail(m.source, "a wall that gives way, a ball or an indenter goes with linear hardening only",
           r.known.hardening);
}

/// Impacts faster than the atlas goes for the hardest material of this modulus, or of this yield stress.
void check_speeds(const CalibrationRequest& r, const Atlas& atlas)
{
  const auto fits = [&](Parameter p) { return std::find(r.fit.begin(), r.fit.end(), p) != r.fit.end(); };
  const bool fits_yield = fits(Parameter::yield_stress);
  if (fits_yield && fits(Parameter::youngs_modulus)) return;
  const double least_stiffness = atlas.grid().stiffnesses.front();
  const double hardest = fits_yield ? r.known.e_star() / least_stiffness : r.known.yield_stress;
  for (const Measurement& m : r.measurements) {
    if (!is_impact(m.kind)) continue;
    const double share = m.partner == ImpactPartner::like_sphere ? 0.5 : 1.0;
    const double fastest =
        SphereLaws::fastest * std::sqrt(hardest / m.sphere_density(r.known.density)) / share;
    constexpr double some_noise = 1.02;
    for (const Datum& d : m.data)
      if (d.x > some_noise * fastest)
        fail(fmt::format("{}:{}", m.source, d.line),
             "the impact is faster than the method goes for any material of this " +
                 std::string(fits_yield ? "youngs_modulus" : "yield_stress"),
             fmt::format("{:g} m/s", d.x),
             fmt::format("up to {:.3g} m/s, where rho V^2/Y is {:g}{}: is a value in another unit than SI?",
                         fastest, SphereLaws::fastest * SphereLaws::fastest,
                         fits_yield ? fmt::format(" and E*/Y {:g}", least_stiffness) : ""));
  }
}

void check(const CalibrationRequest& r, const Atlas& atlas)
{
  if (r.measurements.empty()) fail("calibrate", "no measurement was given");
  if (r.fit.empty()) fail("calibrate", "nothing is to be fitted", {}, list_of(parameter_names()));
  const auto fits = [&](Parameter p) { return std::find(r.fit.begin(), r.fit.end(), p) != r.fit.end(); };
  for (const Parameter p : {Parameter::youngs_modulus, Parameter::yield_stress})
    if (!fits(p) && !(value_of(r.known, p) > 0 && std::isfinite(value_of(r.known, p))))
      fail("calibrate", fmt::format("{} is neither to be fitted nor given", name_of(p)));
  check_hardening(r);
  const std::vector<double> ratios = atlas.grid().poisson_ratios();
  if (!(r.known.poisson_ratio >= ratios.front() && r.known.poisson_ratio <= ratios.back()))
    fail("calibrate", "Poisson's ratio is outside the atlas", fmt::format("{:g}", r.known.poisson_ratio),
         fmt::format("{:g} to {:g}", ratios.front(), ratios.back()));
  for (const Measurement& m : r.measurements) {
    if (m.kind != MeasurementKind::indenter && !std::isfinite(m.radius))
      fail(m.source, "only an indenter meets a specimen without a radius: give --radius");
    if (!is_curve(m.kind)) continue;
    const double deepest = largest_displacement(m) / m.effective_radius() / m.contacts(), end = deepest_of(m);
    // some of it may be offset
    if (deepest > 1.3 * end)
      fail(m.source,
           "the curve goes deeper than the atlas knows: overlap of one contact over its effective radius",
           fmt::format("{:.3g}", deepest), fmt::format("up to {:g}", end));
  }
  check_speeds(r, atlas);
}

}  // namespace

CalibrationProblem::CalibrationProblem(const Atlas& atlas, CalibrationRequest request)
    : request_(std::move(request)), laws_(atlas)
{
  check(request_, atlas);
  for (const Parameter p : request_.fit) {
    if (p == Parameter::hardening_modulus)
      unknowns_.push_back({Unknown::Kind::hardening, p, 0, 1, 0.02, name_of(p)});
    else
      unknowns_.push_back({Unknown::Kind::modulus, p, 0, 1, 1e-3, name_of(p)});
  }
  for (std::size_t k = 0; k < request_.measurements.size(); ++k) {
    const Measurement& m = request_.measurements[k];
    data_ += m.data.size();
    if (m.fit_offset)
      unknowns_.push_back({Unknown::Kind::offset,
                           {},
                           k,
                           0.01 * largest_displacement(m),
                           1e-2,
                           fmt::format("offset of {}", m.source)});
    if (m.fit_compliance)
      unknowns_.push_back({Unknown::Kind::compliance,
                           {},
                           k,
                           0.01 * largest_displacement(m) / largest_force(m),
                           1e-2,
                           fmt::format("compliance of {}", m.source)});
    if (is_curve(m.kind) && m.turn_gap() > 0)
      unknowns_.push_back(
          {Unknown::Kind::turn, {}, k, m.turn_gap(), 1e-2, fmt::format("turn of {}", m.source)});
  }
  const std::size_t wanted = std::max<std::size_t>(2, fitted_count());
  if (data_ + request_.priors.size() < wanted)
    fail(request_.measurements.front().source, fmt::format("too few values for {} unknowns", fitted_count()),
         std::to_string(data_), fmt::format("{} or more", wanted));
  for (std::size_t k = 0; k < request_.measurements.size(); ++k)
    for (std::size_t j = 0; j < model_errors_of(request_.measurements[k].kind); ++j)
      unknowns_.push_back({Unknown::Kind::model_error, {}, k, 1, 0.5, "model error"});
  for (const Measurement& m : request_.measurements) {
    indenters_.push_back(m.kind == MeasurementKind::indenter
                             ? std::make_unique<IndenterModel>(atlas, m, request_.fit)
                             : nullptr);
    walls_.push_back(m.wall || m.ball ? std::make_unique<WallModel>(atlas, m, request_.fit) : nullptr);
  }
  // the hardening's reference is a yield stress: the one given, else of the middle of what is likely
  for (Unknown& u : unknowns_)
    if (u.kind == Unknown::Kind::hardening) {
      const std::vector<double> likely = likely_yield_stresses();
      u.scale = likely[likely.size() / 2] / 2;
    }
}

std::size_t CalibrationProblem::fitted_count() const
{
  return static_cast<std::size_t>(std::count_if(unknowns_.begin(), unknowns_.end(), [](const Unknown& u) {
    return u.kind != Unknown::Kind::model_error;
  }));
}

std::size_t CalibrationProblem::index_of(Parameter parameter) const
{
  for (std::size_t k = 0; k < request_.fit.size(); ++k)
    if (request_.fit[k] == parameter) return k;
  fail("calibrate", fmt::format("{} is not fitted", name_of(parameter)));
}

double CalibrationProblem::value(std::size_t unknown, double q) const
{
  const Unknown& u = unknowns_[unknown];
  switch (u.kind) {
    case Unknown::Kind::modulus:
      return std::exp(std::clamp(q, -furthest_log, furthest_log));
    case Unknown::Kind::hardening:
      return u.scale * std::max(0.0, std::expm1(q));
    default:
      return u.scale * q;
  }
}

double CalibrationProblem::coordinate(std::size_t unknown, double value) const
{
  const Unknown& u = unknowns_[unknown];
  switch (u.kind) {
    case Unknown::Kind::modulus:
      return std::log(value);
    case Unknown::Kind::hardening:
      return std::log1p(value / u.scale);
    default:
      return value / u.scale;
  }
}

CandidateMaterial CalibrationProblem::material(const Coordinates& q) const
{
  CandidateMaterial m = request_.known;
  for (std::size_t k = 0; k < request_.fit.size(); ++k)
    set_value(m, request_.fit[k], value(k, q[static_cast<Eigen::Index>(k)]));
  return m;
}

MachineState CalibrationProblem::machine(const Coordinates& q, std::size_t measurement) const
{
  MachineState state;
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    if (unknowns_[k].measurement != measurement) continue;
    const double here = value(k, q[static_cast<Eigen::Index>(k)]);
    if (unknowns_[k].kind == Unknown::Kind::offset) state.offset = here;
    if (unknowns_[k].kind == Unknown::Kind::compliance) state.compliance = here;
    if (unknowns_[k].kind == Unknown::Kind::turn) state.beyond = here;
  }
  return state;
}

const SphereLaws& CalibrationProblem::laws_of(const CandidateMaterial& m) const
{
  return laws_.of(m);
}

Prediction CalibrationProblem::prediction(const Coordinates& q, std::size_t k,
                                          const CandidateMaterial& material, const SphereLaws& laws) const
{
  const Measurement& m = request_.measurements[k];
  if (indenters_[k]) {
    const IndenterModel::Law& law = indenters_[k]->law(material);
    const AtlasErrors errors = errors_of(laws_.atlas(), MaterialRatios::of(material).stiffness);
    // composed laws were held against runs, whose own error comes on top
    Prediction p = predict_curve(
        m, {&law.curve, law.length, law.force, std::hypot(law.force_error, errors.solver), errors.recovery},
        machine(q, k));
    p.beyond = std::log(largest_displacement(m) / (law.length * law.curve.x_end()));
    return p;
  }
  Prediction p = predict(m, material, laws, machine(q, k));
  if (walls_[k]) {
    const std::vector<double> change = walls_[k]->change(material);
    const double error = walls_[k]->error(material);
    for (std::size_t i = 0; i < p.values.size(); ++i) {
      p.values[i] = std::clamp(p.values[i] + change[i], 1e-3, 1.0);
      p.errors[0][i] = std::hypot(p.errors[0][i], error);
    }
  }
  if (m.kind == MeasurementKind::hardness && request_.hardness_ratio) {
    const Range& r = *request_.hardness_ratio;
    const double middle = std::sqrt(r.low * r.high), sd = std::log(r.high / r.low) / (2 * normal95);
    for (std::size_t i = 0; i < p.values.size(); ++i) {
      p.values[i] = middle * material.yield_stress;
      p.errors[0][i] = sd * p.values[i];
    }
  }
  return p;
}

CalibrationProblem::Comparison CalibrationProblem::compare(const Coordinates& q, std::size_t k) const
{
  const CandidateMaterial m = material(q);
  const Prediction p = prediction(q, k, m, laws_of(m));
  Comparison c{p.values, p.values, {}};
  std::size_t error = 0;
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    if (unknowns_[u].kind == Unknown::Kind::model_error && unknowns_[u].measurement == k) {
      for (std::size_t i = 0; i < p.values.size(); ++i)
        c.with_errors[i] += q[static_cast<Eigen::Index>(u)] * p.errors[error][i];
      ++error;
    }
  for (std::size_t i = 0; i < p.values.size(); ++i)
    c.sd.push_back(std::hypot(request_.measurements[k].data[i].sd_at(p.values[i]), p.scatter[i]));
  return c;
}

std::vector<CalibrationProblem::Limit> CalibrationProblem::limits(const CandidateMaterial& m,
                                                                  double beyond) const
{
  using Kind = Limit::Kind;
  const AtlasGrid& grid = laws_.atlas().grid();
  const MaterialRatios r = MaterialRatios::of(m);
  std::vector<Limit> all{{Kind::stiffest, std::log(r.stiffness / grid.stiffnesses.back())},
                         {Kind::softest, std::log(grid.stiffnesses.front() / r.stiffness)},
                         {Kind::hardest, std::log(std::max(r.hardening, 1e-12) / grid.hardenings.back())},
                         {Kind::deepest, beyond},
                         {Kind::modulus, std::log(solid_modulus.low / m.youngs_modulus)},
                         {Kind::modulus, std::log(m.youngs_modulus / solid_modulus.high)}};
  if (m.hardens_linearly()) return all;
  for (const Parameter p : parameters_of(m.hardening)) {
    const Range range = p == Parameter::saturation_stress
                            ? Range{m.yield_stress, std::numeric_limits<double>::infinity()}
                            : range_of(p);
    if (range.low > 0) all.push_back({Kind::parameter_low, std::log(range.low / value_of(m, p)), p});
    all.push_back({Kind::parameter_high, std::log(value_of(m, p) / range.high), p});
  }
  return all;
}

std::string CalibrationProblem::sentence(const Limit& limit) const
{
  using Kind = Limit::Kind;
  const AtlasGrid& grid = laws_.atlas().grid();
  switch (limit.kind) {
    case Kind::stiffest:
      return fmt::format("E*/Y = {:g}, the largest in the atlas", grid.stiffnesses.back());
    case Kind::softest:
      return fmt::format("E*/Y = {:g}, the smallest in the atlas", grid.stiffnesses.front());
    case Kind::hardest:
      return fmt::format("H/E = {:g}, the largest in the atlas", grid.hardenings.back());
    case Kind::deepest:
      return "the fastest impact or the deepest overlap in the atlas";
    case Kind::modulus:
      return fmt::format("a Young's modulus of {:g} to {:g} Pa, as solids have", solid_modulus.low,
                         solid_modulus.high);
    case Kind::parameter_low:
      return fmt::format("the smallest {} that the solver takes", name_of(limit.parameter));
    default:
      return fmt::format("the largest {} that the solver takes", name_of(limit.parameter));
  }
}

std::string CalibrationProblem::bound_met(const Coordinates& q) const
{
  // chi^2 falls by 2 wall_steepness r for each unit that the logarithm goes on beyond a wall of residual r:
  // by 3.8, what a 95 % interval takes, within a fifth
  constexpr double pushed = 0.1;
  const CandidateMaterial m = material(q);
  for (const Limit& limit : limits(m, misses(q, m).beyond))
    if (wall_steepness * limit.outside > pushed) return sentence(limit);
  return {};
}

CalibrationProblem::Misses CalibrationProblem::misses(const Coordinates& q, const CandidateMaterial& m) const
{
  const SphereLaws& laws = laws_of(m);
  Misses found;
  for (std::size_t k = 0; k < request_.measurements.size(); ++k) {
    const Measurement& measurement = request_.measurements[k];
    Prediction p = prediction(q, k, m, laws);
    found.beyond = std::max(found.beyond, p.beyond);
    std::vector<double> sd;
    for (std::size_t i = 0; i < p.values.size(); ++i)
      sd.push_back(std::hypot(measurement.data[i].sd_at(p.values[i]), p.scatter[i]));
    std::size_t error = 0;
    for (std::size_t u = 0; u < unknowns_.size(); ++u)
      if (unknowns_[u].kind == Unknown::Kind::model_error && unknowns_[u].measurement == k) {
        for (std::size_t i = 0; i < p.values.size(); ++i)
          p.values[i] += q[static_cast<Eigen::Index>(u)] * p.errors[error][i];
        ++error;
      }
    for (std::size_t i = 0; i < p.values.size(); ++i)
      found.data.push_back((measurement.data[i].y - p.values[i]) / sd[i]);
  }
  return found;
}

std::vector<double> CalibrationProblem::informed_residuals(const Coordinates& q,
                                                           const CandidateMaterial& m) const
{
  std::vector<double> all;
  for (const ParameterRange& prior : request_.priors) {
    const double middle = 0.5 * std::log(prior.range.low * prior.range.high),
                 sd = std::log(prior.range.high / prior.range.low) / (2 * normal95);
    all.push_back((std::log(std::max(value_of(m, prior.parameter), 1e-300)) - middle) / sd);
  }
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    if (unknowns_[u].kind == Unknown::Kind::model_error) all.push_back(q[static_cast<Eigen::Index>(u)]);
  return all;
}

Eigen::VectorXd CalibrationProblem::residuals(const Coordinates& q) const
{
  const CandidateMaterial m = material(q);
  const Misses found = misses(q, m);
  std::vector<double> all;
  for (const double r : found.data) all.push_back(request_.robust ? tempered(r) : r);
  for (const double r : informed_residuals(q, m)) all.push_back(r);
  const auto wall = [&](double outside) { all.push_back(wall_steepness * std::max(0.0, outside)); };
  for (const Limit& limit : limits(m, found.beyond)) wall(limit.outside);
  for (const ParameterRange& b : request_.bounds) {
    const double here = std::max(value_of(m, b.parameter), 1e-300);
    wall(std::log(here / b.range.high));
    wall(b.range.low > 0 ? std::log(b.range.low / here) : 0.0);
  }
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    using Kind = Unknown::Kind;
    const Kind kind = unknowns_[u].kind;
    const double here = q[static_cast<Eigen::Index>(u)];
    if (kind == Kind::hardening || kind == Kind::compliance || kind == Kind::turn) wall(-here);
    if (kind == Kind::turn) wall(here - 1);
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

CalibrationProblem::Scatter CalibrationProblem::scatter(const Coordinates& q) const
{
  const CandidateMaterial m = material(q);
  const Misses found = misses(q, m);
  Scatter s;
  double within = 0;
  for (const double r : found.data) {
    const bool outlier = request_.robust && std::abs(r) > robust_from;
    s.chi_squared += outlier ? robust_from * robust_from : r * r;
    within += outlier ? 0 : 1;
  }
  s.share_within = std::max(within, 1.0) / static_cast<double>(found.data.size());
  for (const double r : informed_residuals(q, m)) s.chi_squared += r * r;
  return s;
}

Range CalibrationProblem::allowed(std::size_t unknown, const Coordinates& q) const
{
  const Unknown& u = unknowns_[unknown];
  const CandidateMaterial m = material(q);
  const AtlasGrid& grid = laws_.atlas().grid();
  const double softening = 1 - m.poisson_ratio * m.poisson_ratio;
  const auto fits = [&](Parameter p) {
    return std::find(request_.fit.begin(), request_.fit.end(), p) != request_.fit.end();
  };
  Range r{0, std::numeric_limits<double>::infinity()};
  switch (u.kind) {
    case Unknown::Kind::modulus:
      if (u.parameter == Parameter::saturation_stress || u.parameter == Parameter::strength) {
        r = {u.parameter == Parameter::strength ? 1e-4 * m.yield_stress : m.yield_stress,
             1e4 * m.yield_stress};
        break;
      }
      if (u.parameter != Parameter::youngs_modulus && u.parameter != Parameter::yield_stress) {
        r = range_of(u.parameter);
        break;
      }
      // the other modulus follows where it is free: four decades either way stand for no end
      if (u.parameter == Parameter::youngs_modulus)
        r = fits(Parameter::yield_stress) ? Range{1e-4 * m.youngs_modulus, 1e4 * m.youngs_modulus}
                                          : Range{grid.stiffnesses.front() * m.yield_stress * softening,
                                                  grid.stiffnesses.back() * m.yield_stress * softening};
      else
        r = fits(Parameter::youngs_modulus)
                ? Range{1e-4 * m.yield_stress, 1e4 * m.yield_stress}
                : Range{m.e_star() / grid.stiffnesses.back(), m.e_star() / grid.stiffnesses.front()};
      break;
    case Unknown::Kind::hardening:
      r = {0, grid.hardenings.back() * (fits(Parameter::youngs_modulus) ? 100 : 1) * m.youngs_modulus};
      break;
    case Unknown::Kind::compliance:
      return {0, 1e9};
    default:
      return {-1e9, 1e9};
  }
  for (const ParameterRange& b : request_.bounds)
    if (b.parameter == u.parameter) r = {std::max(r.low, b.range.low), std::min(r.high, b.range.high)};
  return {u.kind == Unknown::Kind::modulus ? std::log(r.low) : coordinate(unknown, r.low),
          coordinate(unknown, r.high)};
}

std::vector<double> CalibrationProblem::likely_yield_stresses() const
{
  std::vector<double> likely;
  if (std::find(request_.fit.begin(), request_.fit.end(), Parameter::yield_stress) == request_.fit.end())
    return {request_.known.yield_stress};
  for (const Measurement& m : request_.measurements) {
    if (is_curve(m.kind)) {
      // a mean pressure of 2.8 Y over 2 pi R delta
      const double overlap = largest_displacement(m) / m.contacts();
      const double middle = largest_force(m) / (2 * M_PI * m.effective_radius() * overlap * 2.8);
      for (const double factor : {0.4, 0.7, 1.0, 1.5, 3.0, 10.0}) likely.push_back(factor * middle);
    } else if (m.kind == MeasurementKind::hardness) {
      for (const double ratio : {3.0, 2.5, 2.0, 1.5}) likely.push_back(m.data.front().y / ratio);
    } else if (is_impact(m.kind)) {
      double fastest = 0;
      for (const Datum& d : m.data) fastest = std::max(fastest, d.x);
      for (const double v : {0.28, 0.14, 0.07, 0.035, 0.017, 0.008, 0.004, 0.002, 0.001})
        likely.push_back(m.sphere_density(request_.known.density) * fastest * fastest / (v * v));
    } else {
      for (double y = 1e6; y < 1e10; y *= 3) likely.push_back(y);
    }
  }
  std::sort(likely.begin(), likely.end());
  return likely;
}

namespace {

/// Where a search for the parameters of hardening begins: `gain` is what hardening adds over Y, at about
/// `strain`.
struct HardeningStart
{
  double gain, strain;
  double value(Parameter p, double yield) const
  {
    switch (p) {
      case Parameter::saturation_stress:
        return (1 + gain) * yield;
      case Parameter::strength:
        return 2 * gain * yield;
      case Parameter::exponent:
        return 0.25;
      case Parameter::strain:
      case Parameter::offset:
        return strain;
      default:
        return 0.5 * std::expm1(0.5) * yield;  // on the lattice
    }
  }
};

std::vector<HardeningStart> hardening_starts(const CalibrationRequest& r)
{
  if (r.known.hardens_linearly()) return {{0.3, 0.1}};
  return {{0.2, 0.03}, {0.6, 0.03}, {0.6, 0.15}, {1.5, 0.15}};
}

}  // namespace

std::vector<Coordinates> CalibrationProblem::starts() const
{
  constexpr std::size_t most = 3;
  const bool fits_modulus =
      unknowns_.front().parameter == Parameter::youngs_modulus ||
      std::find(request_.fit.begin(), request_.fit.end(), Parameter::youngs_modulus) != request_.fit.end();
  const bool fits_yield =
      std::find(request_.fit.begin(), request_.fit.end(), Parameter::yield_stress) != request_.fit.end();
  const double softening = 1 - request_.known.poisson_ratio * request_.known.poisson_ratio;
  const std::vector<double> stiffnesses{25, 40, 70, 120, 200, 400, 900, 2500};
  struct Candidate
  {
    double cost;
    Coordinates q;
    double stiffness;
  };
  std::vector<Candidate> candidates;
  const bool composes =
      std::any_of(indenters_.begin(), indenters_.end(), [](const auto& i) { return i != nullptr; });
  const auto consider_one = [&](double modulus, double yield, const HardeningStart& hardening) {
    Coordinates q = Coordinates::Zero(static_cast<Eigen::Index>(count()));
    for (std::size_t k = 0; k < request_.fit.size(); ++k) {
      const Parameter p = request_.fit[k];
      const double v = p == Parameter::youngs_modulus ? modulus
                       : p == Parameter::yield_stress ? yield
                                                      : hardening.value(p, yield);
      q[static_cast<Eigen::Index>(k)] = coordinate(k, v);
    }
    const double cost = residuals(q).squaredNorm();
    if (std::isfinite(cost)) candidates.push_back({cost, q, modulus / (softening * yield)});
  };
  const auto consider = [&](double modulus, double yield) {
    if (composes) modulus = MaterialLattice::nearest(modulus), yield = MaterialLattice::nearest(yield);
    for (const HardeningStart& hardening : hardening_starts(request_))
      consider_one(modulus, yield, hardening);
  };
  const std::vector<double> likely = likely_yield_stresses();
  for (const double k : stiffnesses) {
    if (!fits_yield) {
      consider(fits_modulus ? k * softening * request_.known.yield_stress : request_.known.youngs_modulus,
               request_.known.yield_stress);
    } else if (!fits_modulus) {
      consider(request_.known.youngs_modulus, request_.known.youngs_modulus / softening / k);
    } else {
      for (const double yield : likely) consider(k * softening * yield, yield);
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  std::vector<Coordinates> chosen;
  std::vector<double> taken;
  for (const Candidate& c : candidates) {
    if (std::any_of(taken.begin(), taken.end(), [&](double s) { return s == c.stiffness; })) continue;
    chosen.push_back(c.q);
    taken.push_back(c.stiffness);
    if (chosen.size() == most) break;
  }
  if (chosen.empty()) fail("calibrate", "no material of the atlas comes near these data");
  return chosen;
}

}  // namespace granulaw
