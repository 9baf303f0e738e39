#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "solver/loading/flight.hpp"
#include "solver/loading/press.hpp"
#include "solver/run/accuracy.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/run/mean_run.hpp"
#include "solver/run/simulation.hpp"
#include "solver/runs.hpp"

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

/// Cells across the block: 20, and more for deep contacts, where steps are few and strains large.
int resolution_of(const RunOptions& options, double deepest)
{
  const double cells =
      options.resolution ? options.resolution : std::round(20 * (1 + std::min(1.0, deepest / 0.15)));
  return static_cast<int>(std::lround(options.refine * cells));
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
      options, resolution_of(options, deepest), scale, true,
      [&](int cells, double shift, const auto& fields, const auto& progress, const auto& checkpoint) {
        Simulation run(collision.build(deepest, cells, shift), options, duration, scale.stress);
        const double reduced = run.scene.reduced_mass();
        for (Body& body : run.scene.bodies) throw_body(body, -v * reduced / body.mass() * run.scene.outward);
        Flight programme(duration);
        run.run(programme, {fields, scale, duration}, progress, checkpoint);
        RunSummary& s = run.result.summary;
        s.restitution_raw = run.scene.separation_velocity() / v;
        s.work_load = run.energy_start;
        s.work_unload = run.energy_start * s.restitution_raw * s.restitution_raw;
        return std::move(run.result);
      });
}

namespace {

/// True if a run is one of three dimensions; `needed`: the reason beside shape and grid, null for none.
bool in_three_dimensions(const Particle& particle, const Partner& partner, const RunOptions& options,
                         const char* needed)
{
  const char* reason = particle.shape ? "a body of any shape" : needed;
  if (!reason && options.grid != GridKind::spatial) return false;
  if (options.grid != GridKind::spatial && options.grid != GridKind::automatic)
    fail("--grid", fmt::format("{} needs three dimensions", reason), name_of(options.grid),
         name_of(GridKind::spatial));
  if (partner.particle || partner.wall)
    fail("partner", "three dimensions have rigid planes only", partner.particle ? "a particle" : "a wall");
  return true;
}

}  // namespace

RunResult impact(const Particle& particle, const Approach& approach, const Partner& partner,
                 const RunOptions& options)
{
  const bool oblique = approach.tangential_velocity != 0 || approach.spin != 0 || approach.friction != 0 ||
                       approach.orientation != Approach{}.orientation || approach.turn != 0 ||
                       approach.first_contact_only;
  if (in_three_dimensions(particle, partner, options, oblique ? "an approach that is not head-on" : nullptr))
    return run_body_impact(particle, approach, options);
  return run_impact(particle, approach.velocity, options, partner);
}

RunResult press(const Particle& particle, const PressPlan& plan, const Partner& partner,
                const RunOptions& options)
{
  if (!in_three_dimensions(particle, partner, options, plan.planes.empty() ? nullptr : "a press by planes"))
    return run_press(particle, plan, options, partner);
  if (plan.support != Support::free)
    fail("--support", "cannot go with three dimensions: planes hold the body", "midplane");
  if (!plan.partial_unloads.empty())
    fail("partial unloads", "cannot go with three dimensions: planes unload once");
  PressPlan by_planes = plan;
  if (plan.planes.empty()) by_planes.planes = named_planes("pair");
  return run_planes_press(particle, by_planes, options);
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
  Press::Plan stops;
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
  const double duration = stops.ramp + stops.unload_ramp;

  return mean_of_shifted_grids(
      options, resolution_of(options, depth), scale, false,
      [&](int cells, double shift, const auto& fields, const auto& progress, const auto& checkpoint) {
        Simulation run(collision.build(depth, cells, shift), options, duration, scale.stress);
        std::unique_ptr<Drive> drive = std::make_unique<BodyForce>();
        if (plan.support == Support::midplane) drive = std::make_unique<EquatorPlane>();
        Press programme(stops, collision.e_star(), std::move(drive));
        run.run(programme, {fields, scale, duration}, progress, checkpoint);
        RunSummary& s = run.result.summary;
        s.work_load = run.loading_work();
        s.work_unload = run.unloading_work();
        s.restitution_raw = std::sqrt(std::max(0.0, s.work_unload / s.work_load));
        return std::move(run.result);
      });
}

}  // namespace granulaw
