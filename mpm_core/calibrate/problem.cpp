#include "calibrate/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/error.hpp"
#include "calibrate/kind/composed.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

constexpr double wall_steepness = 100;  // residual for a factor e beyond what is allowed
constexpr double robust_from = 3;       // sd from which a datum counts in proportion
constexpr double furthest_log = 100;    // of a modulus: a search tries anything, and its ratios stay finite
constexpr Range solid_modulus{1e3, 1e13};  // Pa; gels, and eight times diamond
constexpr double unbounded = 1e9;          // of a coordinate: no fit goes further

Eigen::Index index(std::size_t k)
{
  return static_cast<Eigen::Index>(k);
}

/// Huber's loss as a residual whose square it is.
double tempered(double r)
{
  const double size = std::abs(r);
  return size <= robust_from
             ? r
             : std::copysign(std::sqrt(2 * robust_from * size - robust_from * robust_from), r);
}

/// Misses of a measurement's data, over their sd, each less what those before it along the curve say of the
/// model's own error there (a Kalman filter). That error decays with the distance as exp(-distance) (Ornstein
/// and Uhlenbeck 1930), so data that lie closer than its length say little more than one of them does. A
/// robust fit takes an outlier for one at its limit.
std::vector<double> independent_misses(const CalibrationRequest& request, std::size_t measurement,
                                       const CalibrationProblem::Comparison& c)
{
  const Measurement& m = request.measurements[measurement];
  const std::size_t count = c.sd.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  const bool correlated = !c.place.empty() && (m.kind->has_machine || !request.planned);
  if (correlated && !m.kind->has_machine)
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return c.place[a] < c.place[b]; });
  std::vector<double> misses(count);
  double mean = 0, variance = 1, last = 0;  // of the model's own error there, over its sd
  for (const std::size_t k : order) {
    const double kept = correlated ? std::exp(-std::abs(c.place[k] - last)) : 0;
    mean *= kept, variance = kept * kept * variance + 1 - kept * kept;
    const double sd = std::hypot(c.noise[k], c.scatter[k] * std::sqrt(variance));
    misses[k] = (m.data[k].y - c.with_errors[k] - c.scatter[k] * mean) / sd;
    const double gain = variance * c.scatter[k] / sd, limit = request.robust ? robust_from : unbounded;
    mean += gain * std::clamp(misses[k], -limit, limit), variance -= gain * gain;
    if (correlated) last = c.place[k];
  }
  return misses;
}

/// One law is held against both measurements: of curves, to depths within a factor of two.
bool share_a_law(const Measurement& a, const Measurement& b)
{
  const auto partner = [](const Measurement& m) {
    return std::tuple(m.indenter_radius, m.counterpart ? m.counterpart->name : "", m.counterpart_is_ball);
  };
  return a.kind == b.kind && partner(a) == partner(b) &&
         (!a.kind->has_machine || std::abs(std::log2(a.largest_overlap() / b.largest_overlap())) < 1);
}

/// The parameters of the hardening law are fitted or given, no other law's are fitted.
void check_hardening(const CalibrationRequest& r)
{
  const std::vector<Parameter> own = parameters_of(r.known.hardening.name);
  std::vector<Parameter> known{Parameter::youngs_modulus, Parameter::yield_stress};
  known.insert(known.end(), own.begin(), own.end());
  std::vector<std::string> names;
  for (const Parameter p : known) names.push_back(name_of(p));
  for (const Parameter p : r.fit)
    if (std::find(known.begin(), known.end(), p) == known.end())
      fail("calibrate", fmt::format("{} is no parameter of this hardening law", name_of(p)),
           r.known.hardens_linearly() ? "linear" : r.known.hardening.name, list_of(names));
  if (r.known.hardens_linearly()) return;
  for (const Parameter p : own)
    if (!r.fits(p) && !(value_of(r.known, p) > 0))
      fail("calibrate", fmt::format("{} is neither to be fitted nor given", name_of(p)));
  for (const Measurement& m : r.measurements)
    if (m.is_composed())
      fail(m.source, "a wall that gives way, a ball or an indenter goes with linear hardening only",
           r.known.hardening.name);
}

void check(const CalibrationRequest& r, const Atlas& atlas)
{
  if (r.measurements.empty()) fail("calibrate", "no measurement was given");
  if (r.fit.empty()) fail("calibrate", "nothing is to be fitted", {}, list_of(parameter_names()));
  for (const Parameter p : {Parameter::youngs_modulus, Parameter::yield_stress})
    if (!r.fits(p) && !(value_of(r.known, p) > 0 && std::isfinite(value_of(r.known, p))))
      fail("calibrate", fmt::format("{} is neither to be fitted nor given", name_of(p)));
  check_hardening(r);
  const std::vector<double> ratios = atlas.grid().poisson_ratios();
  if (!(r.known.poisson_ratio >= ratios.front() && r.known.poisson_ratio <= ratios.back()))
    fail("calibrate", "Poisson's ratio is outside the atlas", fmt::format("{:g}", r.known.poisson_ratio),
         fmt::format("{:g} to {:g}", ratios.front(), ratios.back()));
  for (const Measurement& m : r.measurements) {
    if (m.indenter_radius == 0 && !std::isfinite(m.radius))
      fail(m.source, "only an indenter meets a specimen without a radius: give --radius");
    m.kind->check_request(m, r, atlas);
  }
}

}  // namespace

bool CalibrationRequest::fits(Parameter parameter) const
{
  return std::find(fit.begin(), fit.end(), parameter) != fit.end();
}

CalibrationProblem::CalibrationProblem(const Atlas& atlas, CalibrationRequest request)
    : request_(std::move(request)), laws_(std::make_unique<SphereLawsCache>(atlas))
{
  check(request_, atlas);
  for (const Parameter p : request_.fit) {
    Unknown& u = unknowns_.emplace_back(Unknown{.parameter = p});
    if (u.is_hardening()) u.step = 0.02, u.least = 0;
  }
  for (std::size_t k = 0; k < request_.measurements.size(); ++k) {
    const Measurement& m = request_.measurements[k];
    data_ += m.data.size();
    const auto add = [&](double MachineState::*of, double scale, double least, double most) {
      unknowns_.push_back(
          {.machine = of, .measurement = k, .scale = scale, .step = 1e-2, .least = least, .most = most});
    };
    constexpr double none = std::numeric_limits<double>::infinity();
    if (m.fit_offset) add(&MachineState::offset, 0.01 * m.largest_x(), -none, none);
    if (m.fit_compliance) add(&MachineState::compliance, 0.01 * m.largest_x() / m.largest_y(), 0, none);
    if (!m.kind->has_machine) continue;
    const std::vector<Unloading> unloadings = m.unloadings();
    for (std::size_t u = 0; u < unloadings.size(); ++u)
      if (unloadings[u].gap > 0)
        unknowns_.push_back({.unloading = u, .measurement = k, .scale = unloadings[u].gap, .step = 1e-2, .least = 0, .most = 1});
  }
  check_count();
  for (std::size_t k = 0; k < request_.measurements.size(); ++k) {
    const Measurement& m = request_.measurements[k];
    const auto all = request_.measurements.begin();
    sharers_.push_back(static_cast<std::size_t>(
        std::find_if(all, all + static_cast<std::ptrdiff_t>(k), [&](const Measurement& o) { return share_a_law(m, o); }) - all));
    if (sharers_[k] == k) unknowns_.insert(unknowns_.end(), m.kind->smooth_errors, {.measurement = k, .step = 0.5});
    composed_.push_back(m.is_composed() ? std::make_unique<ComposedModel>(atlas, m, request_.fit) : nullptr);
  }
  // the hardening's reference is a yield stress: the one given, else of the middle of what is likely
  for (Unknown& u : unknowns_)
    if (u.is_hardening()) {
      const std::vector<double> likely = likely_yield_stresses();
      u.scale = likely[likely.size() / 2] / 2;
    }
}

CalibrationProblem::~CalibrationProblem() = default;

/// A number of the material alone (hardness, by a tester's rebound, too) is a datum: the model's error is its interval. One impact or one row of a
/// curve is none: nothing shows whether the model describes it.
void CalibrationProblem::check_count() const
{
  const auto& all = request_.measurements;
  const bool has_number =
      std::any_of(all.begin(), all.end(), [](const Measurement& m) { return !m.kind->x.exists() || m.is_leeb; });
  const std::size_t wanted = std::max<std::size_t>(has_number ? 1 : 2, fitted_count());
  if (data_ + request_.priors.size() < wanted)
    fail(all.front().source,
         fmt::format("too few values for {} unknown{}", fitted_count(), fitted_count() == 1 ? "" : "s"),
         std::to_string(data_), fmt::format("{} or more; each --prior counts as one", wanted));
}

std::size_t CalibrationProblem::fitted_count() const
{
  return static_cast<std::size_t>(std::count_if(unknowns_.begin(), unknowns_.end(),
                                                [](const Unknown& u) { return !u.is_model_error(); }));
}

double CalibrationProblem::value(std::size_t unknown, double q) const
{
  const Unknown& u = unknowns_[unknown];
  if (u.is_hardening()) return u.scale * std::max(0.0, std::expm1(q));
  return u.parameter ? std::exp(std::clamp(q, -furthest_log, furthest_log)) : u.scale * q;
}

double CalibrationProblem::coordinate(std::size_t unknown, double value) const
{
  const Unknown& u = unknowns_[unknown];
  if (u.is_hardening()) return std::log1p(value / u.scale);
  return u.parameter ? std::log(value) : value / u.scale;
}

CandidateMaterial CalibrationProblem::material(const Coordinates& q) const
{
  CandidateMaterial m = request_.known;
  for (std::size_t k = 0; k < request_.fit.size(); ++k) set_value(m, request_.fit[k], value(k, q[index(k)]));
  return m;
}

MachineState CalibrationProblem::machine(const Coordinates& q, std::size_t measurement) const
{
  MachineState state;
  for (std::size_t k = 0; k < count(); ++k)
    if (const Unknown& u = unknowns_[k]; u.measurement == measurement) {
      if (u.machine) state.*u.machine = value(k, q[index(k)]);
      if (!u.unloading) continue;
      state.beyond.resize(*u.unloading + 1);
      state.beyond[*u.unloading] = value(k, q[index(k)]);
    }
  return state;
}

CalibrationProblem::Comparison CalibrationProblem::compare(const Coordinates& q, std::size_t k,
                                                           const CandidateMaterial& material,
                                                           const SphereLaws& laws) const
{
  const Measurement& m = request_.measurements[k];
  const Prediction p = m.kind->predict(m, {material, laws, machine(q, k), composed_[k].get()});
  Comparison c{p.values, p.values, {}, p.scatter, {}, p.place, p.beyond};
  for (std::size_t i = 0; i < p.values.size(); ++i) {
    c.noise.push_back(m.data[i].sd_at(p.values[i]));
    c.sd.push_back(std::hypot(c.noise[i], c.scatter[i]));
  }
  auto error = p.errors.begin();
  for (std::size_t u = 0; u < count(); ++u)
    if (unknowns_[u].is_model_error() && unknowns_[u].measurement == sharers_[k]) {
      for (std::size_t i = 0; i < p.values.size(); ++i) c.with_errors[i] += q[index(u)] * (*error)[i];
      ++error;
    }
  return c;
}

CalibrationProblem::Comparison CalibrationProblem::compare(const Coordinates& q, std::size_t k) const
{
  const CandidateMaterial m = material(q);
  return compare(q, k, m, *laws_->of(m));
}

void CalibrationProblem::limits(const CandidateMaterial& m, double beyond,
                                const std::function<void(double, const Sentence&)>& use) const
{
  const AtlasGrid& grid = laws_->atlas().grid();
  const MaterialRatios r = MaterialRatios::of(m);
  const double softest = grid.stiffnesses.front(), stiffest = grid.stiffnesses.back(),
               hardest = grid.hardenings.back();
  use(std::log(r.stiffness / stiffest),
      [&] { return fmt::format("E*/Y = {:g}, the largest in the atlas", stiffest); });
  use(std::log(softest / r.stiffness),
      [&] { return fmt::format("E*/Y = {:g}, the smallest in the atlas", softest); });
  use(std::log(std::max(r.hardening, 1e-12) / hardest),
      [&] { return fmt::format("H/E = {:g}, the largest in the atlas", hardest); });
  use(beyond, [] { return std::string("the fastest impact or the deepest overlap in the atlas"); });
  const Sentence solid = [] {
    return fmt::format("a Young's modulus of {:g} to {:g} Pa, as solids have", solid_modulus.low,
                       solid_modulus.high);
  };
  use(std::log(solid_modulus.low / m.youngs_modulus), solid);
  use(std::log(m.youngs_modulus / solid_modulus.high), solid);
  if (m.hardens_linearly()) return;
  for (const Parameter p : parameters_of(m.hardening.name)) {
    const Range range = range_of(m, p);
    use(std::log(range.low / value_of(m, p)),
        [&] { return fmt::format("the smallest {} that the solver takes", name_of(p)); });
    use(std::log(value_of(m, p) / range.high),
        [&] { return fmt::format("the largest {} that the solver takes", name_of(p)); });
  }
}

std::string CalibrationProblem::bound_met(const Coordinates& q) const
{
  // chi^2 falls by 2 wall_steepness r for each unit that the logarithm goes on beyond a wall of residual r:
  // by 3.8, what a 95 % interval takes, within a fifth
  constexpr double pushed = 0.1;
  const CandidateMaterial m = material(q);
  std::string met;
  limits(m, misses(q, m).beyond, [&](double outside, const Sentence& sentence) {
    if (met.empty() && wall_steepness * outside > pushed) met = sentence();
  });
  return met;
}

CalibrationProblem::Misses CalibrationProblem::misses(const Coordinates& q, const CandidateMaterial& m) const
{
  const std::shared_ptr<const SphereLaws> kept = laws_->of(m);
  const SphereLaws& laws = *kept;
  Misses found;
  for (std::size_t k = 0; k < request_.measurements.size(); ++k) {
    const Comparison c = compare(q, k, m, laws);
    found.beyond = std::max(found.beyond, c.beyond);
    for (const double r : independent_misses(request_, k, c)) found.data.push_back(r);
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
  for (std::size_t u = 0; u < count(); ++u)
    if (unknowns_[u].is_model_error()) all.push_back(q[index(u)]);
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
  limits(m, found.beyond, [&](double outside, const Sentence&) { wall(outside); });
  for (const ParameterRange& b : request_.bounds) {
    const double here = std::max(value_of(m, b.parameter), 1e-300);
    wall(std::log(here / b.range.high));
    wall(b.range.low > 0 ? std::log(b.range.low / here) : 0.0);
  }
  for (std::size_t u = 0; u < count(); ++u) {
    if (std::isfinite(unknowns_[u].least)) wall(unknowns_[u].least - q[index(u)]);
    if (std::isfinite(unknowns_[u].most)) wall(q[index(u)] - unknowns_[u].most);
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), index(all.size()));
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
  if (!u.parameter) return {std::max(u.least, -unbounded), std::min(u.most, unbounded)};
  const CandidateMaterial m = material(q);
  const AtlasGrid& grid = laws_->atlas().grid();
  const double softest = grid.stiffnesses.front(), stiffest = grid.stiffnesses.back(),
               softening = 1 - m.poisson_ratio * m.poisson_ratio;
  constexpr double decades = 1e4;  // either way stand for no end: the other modulus follows where it is free
  const double modulus = m.youngs_modulus, yield = m.yield_stress;
  Range r;
  if (u.parameter == Parameter::youngs_modulus)
    r = request_.fits(Parameter::yield_stress)
            ? Range{modulus / decades, decades * modulus}
            : Range{softest * yield * softening, stiffest * yield * softening};
  else if (u.parameter == Parameter::yield_stress)
    r = request_.fits(Parameter::youngs_modulus) ? Range{yield / decades, decades * yield}
                                                 : Range{m.e_star() / stiffest, m.e_star() / softest};
  else if (u.is_hardening())
    r = {0, grid.hardenings.back() * (request_.fits(Parameter::youngs_modulus) ? 100 : 1) * modulus};
  else if (r = range_of(m, *u.parameter); is_stress(*u.parameter))
    r = {std::max(r.low, yield / decades), decades * yield};
  for (const ParameterRange& b : request_.bounds)
    if (b.parameter == u.parameter) r = {std::max(r.low, b.range.low), std::min(r.high, b.range.high)};
  return {coordinate(unknown, r.low), coordinate(unknown, r.high)};
}

std::vector<double> CalibrationProblem::likely_yield_stresses() const
{
  if (!request_.fits(Parameter::yield_stress)) return {request_.known.yield_stress};
  std::vector<double> likely;
  for (const Measurement& m : request_.measurements) m.kind->starts(m, request_.known, likely);
  std::sort(likely.begin(), likely.end());
  return likely;
}

std::vector<Coordinates> CalibrationProblem::starts() const
{
  constexpr std::size_t most = 3;
  const bool fits_modulus = request_.fits(Parameter::youngs_modulus),
             fits_yield = request_.fits(Parameter::yield_stress), linear = request_.known.hardens_linearly(),
             composes = std::any_of(request_.measurements.begin(), request_.measurements.end(),
                                    [](const Measurement&m) { return m.indenter_radius > 0; });
  const double softening = 1 - request_.known.poisson_ratio * request_.known.poisson_ratio;
  struct Candidate
  {
    double cost;
    Coordinates q;
    double stiffness;
  };
  std::vector<Candidate> candidates;
  const auto consider = [&](double modulus, double yield) {
    if (composes) modulus = ComposedModel::nearest(modulus), yield = ComposedModel::nearest(yield);
    CandidateMaterial m = request_.known;
    m.youngs_modulus = modulus, m.yield_stress = yield;
    // of what hardening adds over Y, and at about which strain
    for (const auto& [gain, strain] : {std::pair{0.01, 0.03}, {0.2, 0.03}, {0.6, 0.03}, {0.6, 0.15}, {1.5, 0.15}}) {
      Coordinates q = Coordinates::Zero(index(count()));
      for (std::size_t k = 0; k < request_.fit.size(); ++k) {
        const Parameter p = request_.fit[k];
        const bool of_hardening = p != Parameter::youngs_modulus && p != Parameter::yield_stress;
        q[index(k)] = coordinate(k, unknowns_[k].is_hardening() ? gain / strain * yield
                                    : of_hardening              ? start_of(m, p, gain, strain)
                                                                : value_of(m, p));
      }
      const double cost = residuals(q).squaredNorm();
      if (std::isfinite(cost)) candidates.push_back({cost, q, modulus / (softening * yield)});
      if (linear && !request_.fits(Parameter::hardening_modulus)) break;
    }
  };
  const std::vector<double> likely = likely_yield_stresses();
  for (const double k : {25.0, 40.0, 70.0, 120.0, 200.0, 400.0, 900.0, 2500.0}) {
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
    if (std::find(taken.begin(), taken.end(), c.stiffness) != taken.end()) continue;
    chosen.push_back(c.q);
    taken.push_back(c.stiffness);
    if (chosen.size() == most) break;
  }
  if (chosen.empty()) fail("calibrate", "no material of the atlas comes near these data");
  return chosen;
}

}  // namespace granulaw
