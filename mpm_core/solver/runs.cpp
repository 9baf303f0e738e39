#include "solver/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "solver/body.hpp"
#include "solver/drive.hpp"
#include "solver/ensemble.hpp"
#include "solver/field_recorder.hpp"
#include "solver/flow_laws.hpp"
#include "solver/plane_contact.hpp"
#include "solver/ripple.hpp"
#include "solver/time_step.hpp"

namespace granulaw {

namespace {

/// Modulus of the hourglass control: 0.05 G keeps the one-point cells in shape while elastic; where the
/// material yields it must not outlast the yield stress, else bending cells store energy that flow should
/// have taken (E*/Y = 1000, pressed to 0.1 R: force 3 % low with 0.05 G, within 0.6 % of finite elements with
/// Y).
double hourglass_modulus(const Moduli& m)
{
  return m.yields ? std::min(0.05 * m.shear, m.yield) : 0.05 * m.shear;
}

double cpu_seconds()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Scales scales_of(const Sphere& s)
{
  return {s.radius, s.material.e_star(), s.material.density};
}

Moduli dimensionless(const Sphere& sphere)
{
  const Material& m = sphere.material;
  const Scales scale = scales_of(sphere);
  const flow::Flow laws = flow_of(m, scale.stress, scale.time());
  const double e = m.youngs_modulus / m.e_star(), nu = m.poisson_ratio;
  return {e / (2 * (1 + nu)),
          e / (3 * (1 - 2 * nu)),
          m.yields() ? m.yield_stress / m.e_star() : 0,
          laws.hardening == 0 ? laws.hardening_values[0] : 0,
          m.yields(),
          laws};
}

void check(const Sphere& sphere, const RunOptions& options)
{
  validate(sphere.material, "material");
  if (!(sphere.radius > 0))
    fail("particle", "'radius' cannot be used", fmt::format("{:g}", sphere.radius), "over 0 (m)");
  if (options.resolution != 0 && (options.resolution < 6 || options.resolution > 200))
    fail("--resolution", "cannot be used", std::to_string(options.resolution),
         "6 to 200 cells across the contact block");
  if (options.phases < 1 || options.phases > 64)
    fail("phases", "cannot be used", std::to_string(options.phases), "1 to 64 shifted grids");
  if (!(options.courant >= 0.05 && options.courant <= 1.0))
    fail("courant", "the explicit step is stable up to 1 only", fmt::format("{:g}", options.courant),
         "0.05 to 1");
}

/// Radius on the reference surface that the contact covers at overlap x (both in R): sqrt(x) while elastic,
/// growing towards sqrt(2 x) (the geometric intersection) when fully plastic. Sets the size of the block
/// only.
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

/// Loading time, R/c*, of a press that is slow enough for the rate-free law. Elastic: 40 (half as long
/// changes F by 0.15 %). Plastic: 60 (40 changes e by 0.1 %), and inertia enters with I = rho v^2/Y
/// (docs/method.md); the top speed pi depth/(2 ramp) keeps I below 4e-4.
double default_ramp(double depth, const Material& m)
{
  if (!m.yields()) return 40.0;
  return std::max(60.0, 0.5 * M_PI * depth * std::sqrt(m.e_star() / m.yield_stress / 4e-4));
}

/// Runs the time loop; trace in solver units.
struct Simulation
{
  Body body;
  PlaneContact contact;
  StableStep stable;
  double courant;
  double window;   // sample interval
  double longest;  // give up
  RunResult result;
  double energy_start = 0;
  double last_touch_time = 0, last_touch_overlap = 0;

  Simulation(Body b, const RunOptions& options, double expected)
      : body(std::move(b)),
        stable(body),
        courant(options.courant),
        window(expected / options.samples),
        longest(60 * expected)
  {
  }

  template <class Observe>
  void run(Drive& drive, FieldRecorder fields, const std::function<void(double)>& progress, Observe observe)
  {
    const double cpu = cpu_seconds();
    energy_start = body.kinetic_energy();
    fields.begin(body);
    double time = 0, dt = courant * stable.limit(body);
    double impulse = 0, overlap_sum = 0, window_start = 0;
    long steps = 0, in_window = 0;
    double overlap_now = drive.overlap(body);
    while (!drive.finished()) {
      const double overlap_before = overlap_now;
      const Branch branch = drive.branch();
      const int segment = drive.segment();
      const double push = advance(body, contact, drive, time, dt);
      overlap_now = drive.overlap(body);
      impulse += push;
      overlap_sum += overlap_before;
      ++in_window;
      ++steps;
      time += dt;
      if (push > 0) last_touch_time = time, last_touch_overlap = overlap_now;
      const bool turned = drive.segment() != segment;
      if (time - window_start >= window || turned || drive.finished()) {
        const double length = time - window_start;
        // overlaps are taken at the start of each step: shift the mean by half a step's travel
        const double overlap = overlap_sum / in_window + 0.5 * (overlap_now - overlap_before);
        result.trace.push_back({window_start + 0.5 * length, overlap, impulse / length,
                                contact.edge_radius(body), branch, segment});
        observe(result.trace.back());
        fields.sample(body, time, overlap_now, impulse / length, drive.finished());
        window_start = time;
        impulse = overlap_sum = 0;
        in_window = 0;
        if (progress && result.trace.size() % 16 == 0) progress(drive.progress());
        if (!std::isfinite(overlap) || !std::isfinite(result.trace.back().force))
          fail("solver", fmt::format("the run became unstable at t = {:.4g} R/c*; lower the Courant number "
                                     "or raise the resolution",
                                     time));
        if (time > longest)
          fail("solver", fmt::format("the body had not left the wall after {:.4g} R/c*", time));
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
    const double peak = std::max({energy_start, std::abs(put_in), result_work(true)});
    for (const TraceSample& t : result.trace) s.delta_max = std::max(s.delta_max, t.delta);
    s.delta_residual = last_touch_overlap;
    s.contact_time = last_touch_time;
    s.energy_error =
        std::abs(body.kinetic_energy() + body.strain_energy() + body.plastic_work() - put_in) / peak;
  }

  /// Raw work of the contact force on loading (true) or unloading, by the trapezium rule over the samples,
  /// of the last segment for unloading.
  double result_work(bool load) const
  {
    double work = 0;
    const auto& t = result.trace;
    const int last = t.empty() ? 0 : t.back().segment;
    for (std::size_t k = 1; k < t.size(); ++k) {
      if (load ? t[k].branch != Branch::load : (t[k].branch != Branch::unload || t[k].segment != last))
        continue;
      work += 0.5 * (t[k].force + t[k - 1].force) * (t[k].delta - t[k - 1].delta);
    }
    return load ? work : -work;
  }
};

/// Summary of one or several runs of the same job on shifted grids, whose mean trace is `result.trace`
/// (ensemble.hpp); solver units. The loading force is treated for the ripple that is left (ripple.hpp).
void summarise(RunResult& result, const std::vector<RunResult>& members)
{
  RunSummary& s = result.summary;
  const double weight = 1.0 / static_cast<double>(members.size());
  double spread = 0;
  for (const RunResult& member : members) {
    const RunSummary& m = member.summary;
    s.restitution_raw += weight * m.restitution_raw;
    s.delta_max += weight * m.delta_max;
    s.delta_residual += weight * m.delta_residual;
    s.contact_time += weight * m.contact_time;
    s.work_load += weight * m.work_load;
    s.work_unload += weight * m.work_unload;
    s.steps += m.steps;
    s.cpu_s += m.cpu_s;
    s.points = m.points;
    s.energy_error = std::max(s.energy_error, m.energy_error);
  }
  for (const RunResult& member : members)
    spread = std::max(spread, std::abs(member.summary.restitution_raw - s.restitution_raw));
  s.restitution_spread = spread;
  s.point_updates_per_s = static_cast<double>(s.points) * static_cast<double>(s.steps) / s.cpu_s;

  const TreatedLoading treated(result.trace);
  for (const TraceSample& t : result.trace) s.force_max = std::max(s.force_max, t.force);
  s.restitution = s.restitution_raw;
  if (!treated.valid()) return;
  s.ripple = treated.ripple();
  s.force_max = treated.force(s.delta_max);
  if (members.size() > 1) return;
  // A single grid turns at some phase of the ripple, and the work given back follows the force at the turn.
  // What is elastic is given back whatever the phase: only the dissipated share is corrected.
  double raw_over_treated = 0;
  int at_turn = 0;
  for (const TraceSample& t : result.trace)
    if (t.branch == Branch::load && t.delta >= 0.99 * s.delta_max) {
      raw_over_treated += t.force / treated.force(t.delta);
      ++at_turn;
    }
  if (!at_turn) return;
  const double dissipated = 1 - std::min(1.0, s.restitution_raw * s.restitution_raw);
  const double correction = 1 + (at_turn / raw_over_treated - 1) * dissipated;
  s.work_unload *= correction;
  s.restitution *= std::sqrt(correction);
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

/// Cells across the block: 20, and more for deep contacts, where steps are few and strains large.
int resolution_of(const RunOptions& options, double deepest)
{
  return options.resolution ? options.resolution
                            : static_cast<int>(std::lround(20 * (1 + std::min(1.0, deepest / 0.15))));
}

/// One run: cells across, shift, who wants to see its fields, progress.
using SingleRun =
    std::function<RunResult(int, double, const FieldObserver&, const std::function<void(double)>&)>;

/// Runs `single` on options.phases shifted grids and, if asked, once more at a coarser resolution for the
/// error estimate. The fields shown are those of the fine grid whose shift is nearest to zero.
RunResult run_ensemble(const RunOptions& options, double deepest, const Scales& scale,
                       const SingleRun& single)
{
  const int n = resolution_of(options, deepest);
  const int coarse = std::max(6, static_cast<int>(std::lround(0.7 * n)));
  const double share = options.estimate_error ? std::pow(n, 3) / (std::pow(n, 3) + std::pow(coarse, 3)) : 1.0;
  const auto run_all = [&](int cells, double from, double to, const FieldObserver& fields) {
    const auto progress = [&](double fraction) {
      if (options.progress) options.progress(from + (to - from) * fraction);
    };
    const std::vector<RunResult> members = run_phases(
        options.phases, options.threads, progress,
        [&](double shift, const std::function<void(double)>& report) {
          // shifts are whole multiples of 1/(2 phases): 0 where there is one, else the one just below it
          const long half_steps = std::lround(2 * options.phases * shift);
          return single(cells, shift, half_steps == 0 || half_steps == -1 ? fields : FieldObserver{}, report);
        });
    RunResult result;
    result.trace = mean_trace(members);
    summarise(result, members);
    return result;
  };
  RunResult result = run_all(n, 0.0, share, options.fields);
  if (options.estimate_error) {
    const RunSummary other = run_all(coarse, share, 1.0, {}).summary;
    RunSummary& s = result.summary;
    // Errors fall at least like h: their difference at 0.7 of the resolution is at least 0.4 of the fine
    // run's.
    const double force = std::abs(other.force_max / s.force_max - 1);
    const double restitution = std::abs(other.restitution / s.restitution - 1);
    const double scatter = s.restitution_spread / s.restitution / std::max(1, options.phases);
    s.error_estimate = 2 * std::max({force, restitution, scatter});
    s.cpu_s += other.cpu_s;
    s.steps += other.steps;
  }
  to_si(result, scale);
  return result;
}

}  // namespace

RunResult run_impact(const Sphere& sphere, double velocity, const RunOptions& options)
{
  check(sphere, options);
  const Scales scale = scales_of(sphere);
  if (!(velocity > 0)) fail("--velocity", "cannot be used", fmt::format("{:g}", velocity), "over 0 (m/s)");
  const double v = velocity / scale.velocity();
  if (!(v < 0.5))
    fail("--velocity", "is beyond what an impact of a sphere on a plane can be resolved for",
         fmt::format("{:g} m/s", velocity),
         fmt::format("up to half the wave speed sqrt(E*/rho), {:.4g} m/s", 0.5 * scale.velocity()));

  const Moduli moduli = dimensionless(sphere);
  const double mass = 4.0 / 3.0 * M_PI;
  const double hertz = std::pow(15.0 / 16.0 * mass * v * v, 0.4);
  const double plastic = moduli.yields
                             ? v * std::sqrt(mass / (5.6 * M_PI * moduli.yield *
                                                     rate_factor(sphere.material, velocity / sphere.radius)))
                             : 0;
  const double deepest = std::min(0.9, std::max(hertz, plastic));
  const double duration = 2.0 * deepest / v + 2.5;

  return run_ensemble(
      options, deepest, scale,
      [&](int cells, double shift, const FieldObserver& fields, const std::function<void(double)>& progress) {
        const MappedGrid grid = MappedGrid::build(cells, block_size(deepest, sphere.material), true, shift);
        Simulation run(Body::build(grid, moduli, hourglass_modulus(moduli)), options, duration);
        std::fill(run.body.vz_i.begin(), run.body.vz_i.end(), -v);
        ImpactDrive drive(v, duration);
        run.run(drive, {fields, scale, duration}, progress, [](const TraceSample&) {});
        RunSummary& s = run.result.summary;
        s.restitution_raw = run.body.mean_velocity() / v;
        s.work_load = run.energy_start;
        s.work_unload = run.energy_start * s.restitution_raw * s.restitution_raw;
        return std::move(run.result);
      });
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
  const Moduli moduli = dimensionless(sphere);

  return run_ensemble(
      options, depth, scale,
      [&](int cells, double shift, const FieldObserver& fields, const std::function<void(double)>& progress) {
        const MappedGrid grid = MappedGrid::build(cells, block_size(depth, sphere.material),
                                                  plan.support == Support::free, shift);
        Simulation run(Body::build(grid, moduli, hourglass_modulus(moduli)), options,
                       stops.ramp + stops.unload_ramp);
        PressDrive drive(stops, 1.0);
        run.run(drive, {fields, scale, stops.ramp + stops.unload_ramp}, progress,
                [&](const TraceSample& t) { drive.observe(t.force, t.contact_radius); });
        RunSummary& s = run.result.summary;
        s.work_load = run.result_work(true);
        s.work_unload = run.result_work(false);
        s.restitution_raw = std::sqrt(std::max(0.0, s.work_unload / s.work_load));
        return std::move(run.result);
      });
}

}  // namespace granulaw
