#include "solver/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "solver/run/accuracy.hpp"
#include "solver/run/grid_noise.hpp"
#include "solver/run/scene_builder.hpp"
#include "solver/run/shifted_grids.hpp"
#include "solver/run/simulation.hpp"

namespace granulaw {

namespace {

void check(const RunOptions& options, const Particle& particle)
{
  if (!options.yield_stresses.empty() && options.yield_stresses.size() != particle.materials.size())
    fail("yield stresses", "one for each material of the particle",
         std::to_string(options.yield_stresses.size()), std::to_string(particle.materials.size()));
  if (options.resolution != 0 && (options.resolution < 6 || options.resolution > 200))
    fail("--resolution", "cannot be used", std::to_string(options.resolution),
         "6 to 200 cells across the contact block");
  if (options.shifted_grids < 1 || options.shifted_grids > 64)
    fail("shifted grids", "cannot be used", std::to_string(options.shifted_grids), "1 to 64 shifted grids");
  if (!(options.courant >= 0.05 && options.courant <= 1.0))
    fail("courant", "the explicit step is stable up to 1 only", fmt::format("{:g}", options.courant),
         "0.05 to 1");
  if (options.checkpoints && options.fields)
    fail("--checkpoint", "cannot go with --fields: the frames of a run that was stopped are not kept");
}

/// Grid noise, as a share of the force, beyond which the fit does not describe the loading: fast, deep
/// impacts, where inertia makes the early force the largest.
constexpr double most_noise = 0.05;

/// Means and largest values of the members' numbers; their cost together.
RunSummary combined(const std::vector<RunResult>& members)
{
  RunSummary s;
  const double weight = 1.0 / static_cast<double>(members.size());
  double updates = 0;
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
    s.points += m.points;
    updates += static_cast<double>(m.points) * static_cast<double>(m.steps);
    s.plastic_strain_max = std::max(s.plastic_strain_max, m.plastic_strain_max);
    s.energy_error = std::max(s.energy_error, m.energy_error);
    s.contact_loss = std::max(s.contact_loss, m.contact_loss);
    s.hourglass = std::max(s.hourglass, m.hourglass);
  }
  for (const RunResult& member : members)
    s.restitution_spread =
        std::max(s.restitution_spread, std::abs(member.summary.restitution_raw - s.restitution_raw));
  s.points /= static_cast<long>(members.size());
  s.point_updates_per_s = updates / s.cpu_s;
  s.restitution = s.restitution_raw;
  return s;
}

/// By material; infinity where one of the members does not reach it.
std::vector<double> mean_yield_overlaps(const std::vector<RunResult>& members)
{
  std::vector<double> mean = members.front().yield_overlaps;
  for (std::size_t m = 0; m < mean.size(); ++m) {
    double sum = 0;
    for (const RunResult& member : members) sum += member.yield_overlaps[m];
    mean[m] = sum / static_cast<double>(members.size());
  }
  return mean;
}

/// A single grid reverses at some phase of the grid noise, and the work given back follows the force at the
/// reversal. What is elastic is given back whatever the phase: only the dissipated share is corrected.
void correct_work_given_back(RunSummary& s, const std::vector<TraceSample>& trace,
                             const TreatedLoading& treated)
{
  double raw_over_treated = 0;
  int at_turn = 0;
  for (const TraceSample& t : trace)
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

/// Summary of one or several runs of the same job on shifted grids, whose mean trace is `trace`
/// (shifted_grids.hpp); solver units. The loading force is treated for the grid noise that is left
/// (grid_noise.hpp), but in the mean of impacts, after which the body `rings`.
RunSummary summary_of(const std::vector<TraceSample>& trace, const std::vector<RunResult>& members,
                      bool rings)
{
  RunSummary s = combined(members);
  for (const TraceSample& t : trace) s.force_max = std::max(s.force_max, t.force);
  const TreatedLoading treated(trace);
  if (!treated.valid()) return s;
  s.grid_noise = treated.grid_noise();
  // After an impact the body rings, and the force with it: the fit is 0.6 % (rms) off its peak however many
  // grids there are, up to 1.6 %. The smoothed peak of the mean is by 0.23, 0.15, 0.13 % with two, three,
  // four (against twelve grids of 1.4 times the resolution; 20 impacts, E*/Y 20 to 1800).
  if (rings && members.size() > 1) {
    if (const double peak = smoothed_peak(trace); peak > 0) s.force_max = peak;
    return s;
  }
  if (s.grid_noise > most_noise) return s;  // no grid noise about a smooth law any more: the raw peak stands
  s.force_max = treated.largest_force(s.delta_max);
  if (members.size() == 1) correct_work_given_back(s, trace, treated);
  return s;
}

/// Cells across the block: 20, and more for deep contacts, where steps are few and strains large.
int resolution_of(const RunOptions& options, double deepest)
{
  const double cells =
      options.resolution ? options.resolution : std::round(20 * (1 + std::min(1.0, deepest / 0.15)));
  return static_cast<int>(std::lround(options.refine * cells));
}

/// One run: cells across, shift, who wants to see its fields, progress, where it keeps its state.
using SingleRun = std::function<RunResult(int, double, const FieldObserver&,
                                          const std::function<void(double)>&, const CheckpointSlot&)>;

/// Runs `single` on options.shifted_grids shifted grids. The fields shown are those of the grid whose shift
/// is nearest to zero.
RunResult mean_of_shifted_grids(const RunOptions& options, double deepest, const Scales& scale, bool rings,
                                const SingleRun& single)
{
  const int cells = resolution_of(options, deepest);
  const auto one = [&](double shift, const std::function<void(double)>& report) {
    // all that tells the runs of one request from each other
    const CheckpointSlot slot(options.checkpoints,
                              fmt::format("{} cells, shift {}, courant {}, slowness {}", cells, shift,
                                          options.courant, options.slowness));
    if (std::optional<RunResult> kept = slot.finished()) {
      report(1.0);
      return *std::move(kept);
    }
    // shifts are whole multiples of 1/(2 phases): 0 where there is one, else the one just below it
    const long half_steps = std::lround(2 * options.shifted_grids * shift);
    const bool shown = half_steps == 0 || half_steps == -1;
    RunResult made = single(cells, shift, shown ? options.fields : FieldObserver{}, report, slot);
    slot.keep_finished(made);
    return made;
  };
  const std::vector<RunResult> members =
      run_on_shifted_grids(options.shifted_grids, options.threads, options.progress, one);
  RunResult result;
  result.trace = mean_trace(members);
  result.summary = summary_of(result.trace, members, rings);
  result.yield_overlaps = mean_yield_overlaps(members);
  result.summary.resolution = cells;
  result.summary.grids = options.shifted_grids;
  return in_si(std::move(result), scale);
}

}  // namespace

RunResult run_impact(const Particle& particle, double velocity, const RunOptions& options,
                     const Partner& partner)
{
  check(options, particle);
  if (options.estimate_error)
    return run_with_estimate(options,
                             [&](const RunOptions& o) { return run_impact(particle, velocity, o, partner); });
  const Collision collision(particle, partner, options, Support::free);
  const Scales scale = scales_of(particle);
  if (!(velocity > 0)) fail("--velocity", "cannot be used", fmt::format("{:g}", velocity), "over 0 (m/s)");
  const double v = velocity / scale.velocity();
  if (!(v < 0.5))
    fail("--velocity", "is beyond what an impact of a particle can be resolved for",
         fmt::format("{:g} m/s", velocity),
         fmt::format("up to half the wave speed sqrt(E*/rho), {:.4g} m/s", 0.5 * scale.velocity()));
  const double deepest = collision.expected_overlap(v);
  const double duration = 2.0 * deepest / v + 2.5;

  return mean_of_shifted_grids(
      options, deepest, scale, true,
      [&](int cells, double shift, const auto& fields, const auto& progress, const auto& checkpoint) {
        Simulation run(collision.build(deepest, cells, shift), options, duration, scale.stress);
        const double reduced = run.scene.reduced_mass();
        for (Body& body : run.scene.bodies) body.throw_along(-v * reduced / body.mass);
        ImpactProgramme programme(duration);
        const auto observe = [](const TraceSample&) {};
        run.run(programme, {fields, scale, duration}, progress, observe, checkpoint);
        RunSummary& s = run.result.summary;
        s.restitution_raw = run.scene.separation_velocity() / v;
        s.work_load = run.energy_start;
        s.work_unload = run.energy_start * s.restitution_raw * s.restitution_raw;
        return std::move(run.result);
      });
}

RunResult run_impact(const Sphere& sphere, double velocity, const RunOptions& options)
{
  return run_impact(Particle::from(sphere), velocity, options);
}

// Elastic: half as long changes F by 0.15 %. Plastic: 60 at E*/Y = 100 (40 changes e by 0.1 %), and the
// longer the less is given back (E*/Y = 1000 to 0.02 R: 60, 90, 120, 240 give e .1980, .1991, .1995, .1996);
// and inertia enters with I = rho v^2/Y (docs/theory/damage-number.md): the top speed pi depth/(2 ramp) keeps
// I below 4e-4.
double default_press_ramp(double depth, double yield_over_e_star)
{
  if (!std::isfinite(yield_over_e_star)) return 40.0;
  const double stiffness = 1 / yield_over_e_star;
  return std::max(
      {60.0, 60.0 * std::pow(stiffness / 100, 0.25), 0.5 * M_PI * depth * std::sqrt(stiffness / 4e-4)});
}

RunResult run_press(const Particle& particle, const PressPlan& plan, const RunOptions& options,
                    const Partner& partner)
{
  check(options, particle);
  if (options.estimate_error)
    return run_with_estimate(options,
                             [&](const RunOptions& o) { return run_press(particle, plan, o, partner); });
  const Collision collision(particle, partner, options, plan.support);
  const Scales scale = scales_of(particle);
  const double depth = plan.depth / scale.length;
  if (!(depth > 0 && depth <= 0.8))
    fail("--depth", "cannot be used", fmt::format("{:g} R", depth), "over 0, up to 0.8 R");
  PressProgramme::Plan stops;
  for (const double stop : plan.partial_unloads) {
    const double x = stop / scale.length;
    if (!(x > (stops.stops.empty() ? 0 : stops.stops.back()) && x < depth))
      fail("partial unloads", "must ascend and stay below the depth", fmt::format("{:g} R", x));
    stops.stops.push_back(x);
  }
  stops.stops.push_back(depth);
  stops.ramp =
      options.slowness *
      (plan.ramp > 0 ? plan.ramp : default_press_ramp(depth, collision.yield_stress() / scale.stress));
  stops.unload_ramp = 0.4 * stops.ramp;
  stops.support = plan.support;
  const double duration = stops.ramp + stops.unload_ramp;

  return mean_of_shifted_grids(
      options, depth, scale, false,
      [&](int cells, double shift, const auto& fields, const auto& progress, const auto& checkpoint) {
        Simulation run(collision.build(depth, cells, shift), options, duration, scale.stress);
        PressProgramme programme(stops, collision.e_star());
        const auto observe = [&](const TraceSample& t) { programme.observe(t.force, t.contact_radius); };
        run.run(programme, {fields, scale, duration}, progress, observe, checkpoint);
        RunSummary& s = run.result.summary;
        s.work_load = run.loading_work();
        s.work_unload = run.unloading_work();
        s.restitution_raw = std::sqrt(std::max(0.0, s.work_unload / s.work_load));
        return std::move(run.result);
      });
}

RunResult run_press(const Sphere& sphere, const PressPlan& plan, const RunOptions& options)
{
  return run_press(Particle::from(sphere), plan, options);
}

}  // namespace granulaw
