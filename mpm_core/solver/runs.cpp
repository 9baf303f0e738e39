#include "solver/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "solver/body.hpp"
#include "solver/drive.hpp"
#include "solver/plane_contact.hpp"
#include "solver/ripple.hpp"
#include "solver/time_step.hpp"

namespace granulaw {

namespace {

constexpr double hourglass_coefficient = 0.05;
constexpr int default_resolution = 24;

double cpu_seconds()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Moduli dimensionless(const Material& m)
{
  const double e = m.youngs_modulus / m.e_star(), nu = m.poisson_ratio;
  return {e / (2 * (1 + nu)), e / (3 * (1 - 2 * nu)), m.yields() ? m.yield_stress / m.e_star() : 0,
          m.hardening_modulus / m.e_star(), m.yields()};
}

Scales scales_of(const Sphere& s) { return {s.radius, s.material.e_star(), s.material.density}; }

void check(const Sphere& sphere, const RunOptions& options)
{
  validate(sphere.material, "material");
  if (!(sphere.radius > 0)) fail("particle", "'radius' cannot be used", fmt::format("{:g}", sphere.radius), "over 0 (m)");
  if (options.resolution != 0 && (options.resolution < 6 || options.resolution > 200))
    fail("--resolution", "cannot be used", std::to_string(options.resolution), "6 to 200 cells across the contact block");
  if (!(options.courant >= 0.05 && options.courant <= 1.0))
    fail("courant", "the explicit step is stable up to 1 only", fmt::format("{:g}", options.courant), "0.05 to 1");
}

/// Radius on the reference surface that the contact covers at overlap x (both in R): sqrt(x) while elastic,
/// growing towards sqrt(2 x) (the geometric intersection) when fully plastic. Sets the size of the block only.
double contact_radius_guess(double x, const Material& m)
{
  double share = 0;
  if (m.yields()) {
    const double onset = onset_overlap(m.e_star(), m.yield_stress, m.poisson_ratio);
    share = std::clamp(std::log10(std::max(1.0, x / onset)) / 2.0, 0.0, 1.0);
  }
  return std::sqrt(x * (1 + share));
}

double block_size(double deepest, const Material& m)
{
  return std::clamp(1.3 * contact_radius_guess(deepest, m), 1e-4, 0.92);
}

/// Loading time, R/c*, of a press that is slow enough for the rate-free law. Elastic: 40 (half as long changes F
/// by 0.15 %). Plastic: inertia enters with I = rho v^2/Y (DESIGN section 4: under 1e-3 nothing is seen in e);
/// the top speed pi depth/(2 ramp) keeps I below 4e-4.
double default_ramp(double depth, const Material& m)
{
  if (!m.yields()) return 40.0;
  return std::max(40.0, 0.5 * M_PI * depth * std::sqrt(m.e_star() / m.yield_stress / 4e-4));
}

/// Runs the time loop; trace in solver units.
struct Simulation
{
  Body body;
  PlaneContact contact;
  StableStep stable;
  double courant;
  double window;        // sample interval
  double longest;       // give up
  RunResult result;
  double energy_start = 0;
  double last_touch_time = 0, last_touch_overlap = 0;

  Simulation(Body b, const RunOptions& options, double expected)
      : body(std::move(b)), stable(body), courant(options.courant), window(expected / options.samples), longest(60 * expected)
  {
  }

  template <class Observe>
  void run(Drive& drive, const std::function<void(double)>& progress, Observe observe)
  {
    const double cpu = cpu_seconds();
    energy_start = body.kinetic_energy();
    double time = 0, dt = courant * stable.limit(body);
    double impulse = 0, overlap_sum = 0, window_start = 0;
    long steps = 0, in_window = 0;
    while (!drive.finished()) {
      const double overlap_before = drive.overlap(body);
      const Branch branch = drive.branch();
      const int segment = drive.segment();
      const double push = advance(body, contact, drive, time, dt);
      impulse += push;
      overlap_sum += overlap_before;
      ++in_window;
      ++steps;
      time += dt;
      if (push > 0) last_touch_time = time, last_touch_overlap = drive.overlap(body);
      const bool turned = drive.segment() != segment;
      if (time - window_start >= window || turned || drive.finished()) {
        const double length = time - window_start;
        // overlaps are taken at the start of each step: shift the mean by half a step's travel
        const double overlap = overlap_sum / in_window + 0.5 * (drive.overlap(body) - overlap_before);
        result.trace.push_back({window_start + 0.5 * length, overlap, impulse / length, contact.edge_radius(body), branch, segment});
        observe(result.trace.back());
        window_start = time;
        impulse = overlap_sum = 0;
        in_window = 0;
        if (progress && result.trace.size() % 16 == 0) progress(drive.progress());
        if (!std::isfinite(overlap) || !std::isfinite(result.trace.back().force))
          fail("solver", fmt::format("the run became unstable at t = {:.4g} R/c*; lower the Courant number or raise the resolution", time));
        if (time > longest) fail("solver", fmt::format("the body had not left the wall after {:.4g} R/c*", time));
      }
      // The grid deforms: the limit is looked at often enough that no cell changes much in between.
      if (steps % 8 == 0) dt = courant * stable.limit(body);
    }
    if (progress) progress(1.0);
    RunSummary& s = result.summary;
    s.points = body.points;
    s.steps = steps;
    s.cpu_s = cpu_seconds() - cpu;
    s.point_updates_per_s = static_cast<double>(body.points) * static_cast<double>(steps) / s.cpu_s;
    const double put_in = energy_start + drive.work();
    double peak = std::max(energy_start, std::abs(put_in));
    for (const double w : {result_work(true)}) peak = std::max(peak, w);
    s.energy_error = std::abs(body.kinetic_energy() + body.strain_energy() + body.plastic_work() - put_in) / peak;
  }

  /// Raw work of the contact force on loading (true) or unloading, by the trapezium rule over the samples,
  /// of the last two segments for unloading.
  double result_work(bool load) const
  {
    double work = 0;
    const auto& t = result.trace;
    const int last = t.empty() ? 0 : t.back().segment;
    for (std::size_t k = 1; k < t.size(); ++k) {
      if (load ? t[k].branch != Branch::load : (t[k].branch != Branch::unload || t[k].segment != last)) continue;
      work += 0.5 * (t[k].force + t[k - 1].force) * (t[k].delta - t[k - 1].delta);
    }
    return load ? work : -work;
  }
};

/// Summary from the trace, still in solver units: the ripple treated (ripple.hpp). The work of unloading scales
/// with the treated over the raw force at the turn: the raw turn stands at a random phase of the ripple.
void summarise(Simulation& run, bool impact, double velocity, double v_out)
{
  RunSummary& s = run.result.summary;
  const TreatedLoading treated(run.result.trace);
  double raw_over_treated = 0;
  int at_turn = 0;
  for (const TraceSample& t : run.result.trace) {
    s.delta_max = std::max(s.delta_max, t.delta);
    s.force_max = std::max(s.force_max, t.force);
  }
  double correction = 1;
  if (treated.valid()) {
    s.ripple = treated.ripple();
    s.force_max = treated.force(s.delta_max);
    for (const TraceSample& t : run.result.trace)
      if (t.branch == Branch::load && t.delta >= 0.99 * s.delta_max) {
        raw_over_treated += t.force / treated.force(t.delta);
        ++at_turn;
      }
    if (at_turn) correction = at_turn / raw_over_treated;
  }
  s.delta_residual = run.last_touch_overlap;
  s.contact_time = run.last_touch_time;
  if (impact) {
    s.restitution_raw = v_out / velocity;
    s.work_load = run.energy_start;
    s.work_unload = run.energy_start * s.restitution_raw * s.restitution_raw;
  } else {
    s.work_load = run.result_work(true);
    s.work_unload = run.result_work(false);
    s.restitution_raw = std::sqrt(std::max(0.0, s.work_unload / s.work_load));
  }
  // What is elastic is given back whatever the phase: only the dissipated share is corrected.
  correction = 1 + (correction - 1) * (1 - std::min(1.0, s.restitution_raw * s.restitution_raw));
  s.work_unload *= correction;
  s.restitution = s.restitution_raw * std::sqrt(correction);
}

void to_si(RunResult& result, const Scales& scale)
{
  for (TraceSample& t : result.trace) {
    t.time *= scale.time();
    t.delta *= scale.length;
    t.force *= scale.force();
    t.contact_radius *= scale.length;
  }
  RunSummary& s = result.summary;
  s.force_max *= scale.force();
  s.delta_max *= scale.length, s.delta_residual *= scale.length;
  s.contact_time *= scale.time();
  s.work_load *= scale.energy(), s.work_unload *= scale.energy();
}

int resolution_of(const RunOptions& options) { return options.resolution ? options.resolution : default_resolution; }

/// Error of `fine` from a second run at 0.7 of its resolution. The errors fall at least like h^1.65: their
/// difference is at least 0.8 of the coarse run's error and overstates the fine run's.
void estimate_error(RunResult& fine, const RunSummary& coarse)
{
  RunSummary& s = fine.summary;
  const double force = std::abs(coarse.force_max / s.force_max - 1);
  const double restitution = std::abs(coarse.restitution / s.restitution - 1);
  s.error_estimate = std::max(force, restitution);
  s.cpu_s += coarse.cpu_s;
}

}  // namespace

RunResult run_impact(const Sphere& sphere, double velocity, const RunOptions& options)
{
  check(sphere, options);
  const Scales scale = scales_of(sphere);
  if (!(velocity > 0)) fail("--velocity", "cannot be used", fmt::format("{:g}", velocity), "over 0 (m/s)");
  const double v = velocity / scale.velocity();
  if (!(v < 0.5))
    fail("--velocity", "is beyond what an impact of a sphere on a plane can be resolved for", fmt::format("{:g} m/s", velocity),
         fmt::format("up to half the wave speed sqrt(E*/rho), {:.4g} m/s", 0.5 * scale.velocity()));

  const Moduli moduli = dimensionless(sphere.material);
  const double mass = 4.0 / 3.0 * M_PI;
  const double hertz = std::pow(15.0 / 16.0 * mass * v * v, 0.4);
  const double plastic = moduli.yields ? v * std::sqrt(mass / (5.6 * M_PI * moduli.yield)) : 0;
  const double deepest = std::min(0.9, std::max(hertz, plastic));
  const double duration = 2.0 * deepest / v + 2.5;

  const int n = resolution_of(options);
  const MappedGrid grid = MappedGrid::build(n, block_size(deepest, sphere.material), true);
  Simulation run(Body::build(grid, moduli, hourglass_coefficient), options, duration);
  std::fill(run.body.vz_i.begin(), run.body.vz_i.end(), -v);
  ImpactDrive drive(v, duration);
  run.run(drive, options.progress, [](const TraceSample&) {});
  summarise(run, true, v, run.body.mean_velocity());
  to_si(run.result, scale);
  if (options.estimate_error) {
    RunOptions coarse = options;
    coarse.resolution = std::max(6, static_cast<int>(std::lround(0.7 * n)));
    coarse.estimate_error = false;
    estimate_error(run.result, run_impact(sphere, velocity, coarse).summary);
  }
  return run.result;
}

RunResult run_press(const Sphere& sphere, const PressPlan& plan, const RunOptions& options)
{
  check(sphere, options);
  const Scales scale = scales_of(sphere);
  const double depth = plan.depth / scale.length;
  if (!(depth > 0 && depth <= 0.8))
    fail("--depth", "cannot be used", fmt::format("{:g} R", depth), "over 0, up to 0.8 R");
  PressDrive::Plan stops;
  for (const double stop : plan.partial_unloads) {
    const double x = stop / scale.length;
    if (!(x > (stops.stops.empty() ? 0 : stops.stops.back()) && x < depth))
      fail("partial unloads", "must ascend and stay below the depth", fmt::format("{:g} R", x));
    stops.stops.push_back(x);
  }
  stops.stops.push_back(depth);
  stops.ramp = plan.ramp > 0 ? plan.ramp : default_ramp(depth, sphere.material);
  stops.unload_ramp = 0.4 * stops.ramp;
  stops.support = plan.support;

  const Moduli moduli = dimensionless(sphere.material);
  const int n = resolution_of(options);
  const MappedGrid grid = MappedGrid::build(n, block_size(depth, sphere.material), plan.support == Support::free);
  RunOptions sampling = options;
  Simulation run(Body::build(grid, moduli, hourglass_coefficient), sampling, stops.ramp + stops.unload_ramp);
  PressDrive drive(stops, 1.0);
  run.run(drive, options.progress, [&](const TraceSample& t) { drive.observe(t.force, t.contact_radius); });
  summarise(run, false, 0, 0);
  to_si(run.result, scale);
  if (options.estimate_error) {
    RunOptions coarse = options;
    coarse.resolution = std::max(6, static_cast<int>(std::lround(0.7 * n)));
    coarse.estimate_error = false;
    estimate_error(run.result, run_press(sphere, plan, coarse).summary);
  }
  return run.result;
}

}  // namespace granulaw
