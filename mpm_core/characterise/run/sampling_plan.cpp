#include "characterise/run/sampling_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/run/estimates.hpp"
#include "solver/solver_id.hpp"

namespace granulaw {

namespace {

/// Depth of a press over its shallowest partial unloading, whose contact then spans half the cells.
constexpr double press_span = 4;
/// Single precision changes e and F by less than 1e-6 and takes two thirds of the time.
constexpr Precision precision = Precision::single;

std::string key(const CharacterisedBody& s, int resolution, int shifted_grids, const std::string& what)
{
  return fmt::format("{} {} resolution={} phases={} single solver={}", what, s.description, resolution,
                     shifted_grids, solver_id());
}

RunOptions own(RunOptions options, int resolution, int shifted_grids)
{
  options.resolution = resolution;
  options.shifted_grids = shifted_grids;
  options.precision = precision;
  return options;
}

/// Dilatational wave speed of the fastest material over c* at the pole.
double wave_of(const CharacterisedBody& s)
{
  double fastest = 0;
  for (const Material& m : s.particle.materials) {
    const double nu = m.poisson_ratio, modulus = m.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    fastest = std::max(fastest, std::sqrt(modulus / m.density) / s.scale.velocity());
  }
  return fastest;
}

/// CPU seconds, about: points times steps times what a step of a point takes. Cells are a fraction of the contact
/// radius, steps one of a cell over the wave speed. Beyond the block a sphere's grid has few cells. The graded grid of
/// other bodies (solver/grid/rectilinear_body.cpp) has lines on both axes whose distance grows by 1.15 up to 0.15 R,
/// two cells in a thin layer, and three points where lines cross. Cut cells halve its steps.
double cost_of(const CharacterisedBody& s, double depth, double duration, int resolution, int shifted_grids)
{
  double cell = std::sqrt(2 * depth) / resolution;
  if (s.particle.is_homogeneous_sphere())
    return 1.1e-4 * duration * wave_of(s) / cell * resolution * resolution / 576.0 * shifted_grids;
  constexpr double step_of_point = 2.7e-8;
  for (const Particle::Layer& layer : s.particle.layers)
    cell = std::min(cell, std::max(0.5 * layer.thickness / s.scale.length, 0.5 * cell));
  const double across = std::sqrt(2 * depth) / cell, beyond = std::log(std::max(1.0, 0.15 / cell)) / std::log(1.15);
  const double points = 3 * (across + beyond) * (0.8 * across + beyond + 7), steps = 2 * duration * wave_of(s) / cell;
  return step_of_point * points * steps * shifted_grids;
}

/// `count` overlaps from `low` on, by equal factors, the next of which would be `high`.
std::vector<double> between(double low, double high, int count)
{
  std::vector<double> values;
  for (int k = 0; k < count; ++k)
    values.push_back(low * std::pow(high / low, static_cast<double>(k) / count));
  return values;
}

/// Loading time whose largest speed squared, over E*/rho, is this.
double top_speed_ramp(double depth, double speed_squared)
{
  return 0.5 * M_PI * depth / std::sqrt(speed_squared);
}

}  // namespace

double expected_depth(double velocity, const CharacterisedBody& s)
{
  const double hertz = hertz_overlap(s.mass, 1.0, 1.0, velocity);
  return s.yields() ? std::max(hertz, plastic_overlap(s.mass, 1.0, s.yield, velocity)) : hertz;
}

double velocity_to(double x, const CharacterisedBody& s)
{
  return std::min(std::sqrt(std::pow(x, 2.5) * 16.0 / (15.0 * s.mass)), x / plastic_overlap(s.mass, 1.0, s.yield, 1.0));
}

double loading_ramp(const CharacterisedBody& s, double depth, double tolerance)
{
  if (!s.yields() || tolerance <= 0) return 0;
  const double allowed = std::min(tolerance, 0.01);
  const double inertial = top_speed_ramp(depth, negligible_damage_number(tolerance) * s.yield);
  const double vibrational = 42.0 * std::pow(0.01 / s.yield, 0.25) * std::pow(0.01 / allowed, 0.2);
  return std::max({60.0, vibrational, inertial});
}

RunJob press_job(const CharacterisedBody& body, const SamplingPlan::Press& press, const RunSource& source)
{
  std::string path;
  for (const double stop : press.stops) path += fmt::format(" unload={:.17g}", stop);
  if (press.ramp > 0) path += fmt::format(" ramp={:.17g}", press.ramp);
  const double ramp = press.ramp > 0 ? press.ramp : default_press_ramp(press.depth, body.yield);
  const auto stops = static_cast<double>(press.stops.size());  // off and on again takes 0.4 of the ramp each
  return {fmt::format("press to {:.3g} R", press.depth),
          key(body, press.resolution, press.shifted_grids,
              fmt::format("press {} depth={:.17g}{}", press.support == Support::free ? "free" : "midplane",
                          press.depth, path)),
          cost_of(body, press.depth, (1.4 + 0.8 * stops) * ramp, press.resolution, press.shifted_grids),
          [body, press, &source](const RunOptions& options) {
            PressPlan plan{press.depth * body.scale.length, press.support, press.stops, press.ramp};
            for (double& stop : plan.partial_unloads) stop *= body.scale.length;
            return dimensionless(
                source.press(body.particle, plan, own(options, press.resolution, press.shifted_grids)),
                body.scale);
          }};
}

RunJob impact_job(const CharacterisedBody& body, double velocity, int resolution, int shifted_grids,
                  const RunSource& source)
{
  const double depth = expected_depth(velocity, body);
  // an elastic contact lasts 2.94 depth/velocity; what does not rebound, pi/2
  const bool yields_much = depth > 20 * body.onset;
  return {fmt::format("impact at {:.3g} c*", velocity),
          key(body, resolution, shifted_grids, fmt::format("impact velocity={:.17g}", velocity)),
          cost_of(body, depth, (yields_much ? 1.6 : 2.9) * depth / velocity, resolution, shifted_grids),
          [body, velocity, resolution, shifted_grids, &source](const RunOptions& options) {
            return dimensionless(source.impact(body.particle, velocity * body.scale.velocity(),
                                               own(options, resolution, shifted_grids)),
                                 body.scale);
          }};
}

RunJob with_estimate(RunJob job)
{
  job.key += " estimated";
  job.run = [plain = std::move(job.run)](const RunOptions& options) {
    RunOptions both = options;
    both.estimate_error = true;
    return plain(both);
  };
  return job;
}

SamplingPlan plan_sampling(const CharacterisedBody& body)
{
  constexpr double slowest_press = 1e-3, shallowest = 2e-4;    // overlaps
  constexpr double press_depths[] = {0.0075, 0.03, 0.13, 0.5};  // about press_span apart
  constexpr double exact_end = 0.2;  // beyond, no pair law is exact: fewer cells and one grid will do
  SamplingPlan plan;
  const double first = std::max(shallowest, nearest_to_onset * body.onset);
  double done = std::max(slowest_press, first);
  for (const double depth : press_depths) {
    if (depth < 1.3 * done) continue;
    SamplingPlan::Press press{depth, between(done, depth, 3), 24, 2};
    if (depth > exact_end) press.resolution = 20, press.shifted_grids = 1;
    plan.presses.push_back(press);
    done = depth;
  }
  if (first < slowest_press) {
    const int count = std::max(1, static_cast<int>(std::lround(std::log(slowest_press / first) / std::log(1.8))));
    for (const double x : between(first, slowest_press, count))
      plan.slow_impacts.push_back(velocity_to(x, body));
  }
  plan.fast_speeds.assign(std::begin(impact_speeds), std::end(impact_speeds));
  return plan;
}

SamplingPlan slow_runs_to(std::span<const double> overlaps, const CharacterisedBody& body, double tolerance,
                          int press_cells, double slow)
{
  SamplingPlan plan;
  for (std::size_t k = overlaps.size(); k-- > 0;) {
    const double x = overlaps[k];
    const double velocity = velocity_to(x, body);
    if (velocity * velocity <= slow * slow * body.yield) {
      plan.slow_impacts.push_back(velocity);
    } else if (plan.presses.empty() || press_span * x < plan.presses.back().depth) {
      plan.presses.push_back({x, {}, press_cells, 2, loading_ramp(body, x, tolerance)});
    } else {
      auto& stops = plan.presses.back().stops;
      stops.insert(stops.begin(), x);
    }
  }
  return plan;
}

std::vector<double> first_overlaps(double onset, double depth, bool guided)
{
  const double factor = guided ? 4 : 2.5, first = guided ? std::max(3 * onset, shallowest_with_guide) : 2 * onset;
  const int count = std::max(1, static_cast<int>(std::ceil(std::log(depth / first) / std::log(factor))));
  std::vector<double> overlaps = between(std::min(first, 0.5 * depth), depth, count);
  overlaps.push_back(depth);
  return overlaps;
}

std::vector<double> first_inertia_speeds(double fastest, double tolerance)
{
  constexpr std::size_t most = 3;
  const double least = std::sqrt(negligible_damage_number(tolerance));
  std::vector<double> speeds{fastest};
  while (speeds.size() < most && 0.5 * speeds.front() >= least)
    speeds.insert(speeds.begin(), 0.5 * speeds.front());
  return speeds;
}

std::vector<double> first_rate_speeds(double slowest, double fastest)
{
  constexpr int intervals = 4;
  std::vector<double> speeds;
  for (int k = 0; k <= intervals; ++k)
    speeds.push_back(slowest * std::pow(fastest / slowest, static_cast<double>(k) / intervals));
  return speeds;
}

std::vector<RunJob> sampling_jobs(const CharacterisedBody& body, const SamplingPlan& plan,
                                  const RunSource& source)
{
  std::vector<RunJob> jobs;
  for (const SamplingPlan::Press& press : plan.presses) jobs.push_back(press_job(body, press, source));
  for (const double v : plan.slow_impacts)
    jobs.push_back(impact_job(body, v, plan.resolution, plan.shifted_grids, source));
  for (const double v : plan.fast_speeds)
    jobs.push_back(impact_job(body, v * std::sqrt(body.yield), plan.cells_at(v), fast_shifted_grids, source));
  return jobs;
}

void add_to(ContactRecords& records, const CharacterisedBody& body, const SamplingPlan& plan, const std::vector<RunOutcome>& outcomes)
{
  int run = 0;  // the next one's
  for (const ContactRecord& record : records.slow) run = std::max(run, record.run + 1);
  const auto take = [&](ContactRecord record, double depth) {
    record.run = run, record.run_depth = depth;
    records.slow.push_back(std::move(record));
  };
  std::size_t next = 0;
  for (std::size_t k = 0; k < plan.presses.size() + plan.slow_impacts.size(); ++k, ++run) {
    const RunOutcome& outcome = outcomes[next++];
    if (outcome.failed()) continue;
    const double depth = outcome.result.summary.delta_max;
    ContactRecord last = contact_record_of(outcome.result);
    if (k < plan.presses.size())
      for (ContactRecord& reversal : partial_unloadings(outcome.result, records.reload_loop))
        take(std::move(reversal), depth);
    else
      last.speed = plan.slow_impacts[k - plan.presses.size()] / std::sqrt(body.yield);
    take(std::move(last), depth);
  }
  for (const double speed : plan.fast_speeds)
    if (const RunOutcome& outcome = outcomes[next++]; !outcome.failed())
      records.fast.push_back({speed, contact_record_of(outcome.result)});
  std::sort(records.slow.begin(), records.slow.end(),
            [](const ContactRecord& a, const ContactRecord& b) { return a.depth < b.depth; });
  std::sort(
      records.fast.begin(), records.fast.end(),
      [](const ContactRecords::Impact& a, const ContactRecords::Impact& b) { return a.speed < b.speed; });
}

}  // namespace granulaw
