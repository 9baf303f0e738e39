#include "solver/loading/press.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "solver/run/accuracy.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/run/mean_run.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/spatial_setup.hpp"
#include "solver/runs.hpp"

namespace granulaw {

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

namespace {

/// A body among planes; without any that are named, a pair.
std::unique_ptr<Setup> among_planes(const Particle& particle, const PressPlan& plan,
                                    const Attraction& attraction, const RunOptions& options)
{
  if (plan.support != Support::free)
    fail("--support", "cannot go with three dimensions: planes hold the body", "midplane");
  std::vector<Plane> planes;
  for (const PressPlane& p : plan.planes.empty() ? named_planes("pair") : plan.planes) {
    Plane plane = touching_plane(-unit_direction(p.direction, "--planes"));
    if (p.distance) plane.position = plane.start = -*p.distance / particle.radius;
    plane.velocity = p.speed;  // until the programme starts: planes of unlike speed are no mirror images
    plane.friction = p.friction;
    planes.push_back(plane);
  }
  return std::make_unique<SpatialSetup>(particle, Eigen::Matrix3d::Identity(), planes,
                                        std::array<bool, 3>{true, true, true}, options, attraction);
}

std::unique_ptr<Setup> setup_of(const Particle& particle, const PressPlan& plan, const Partner& partner,
                                const RunOptions& options)
{
  if (in_three_dimensions(particle, partner, options, plan.planes.empty() ? nullptr : "a press by planes")) {
    if (partner.particle) fail("partner", "a press in three dimensions has planes only", "a particle");
    return among_planes(particle, plan, partner.attraction, options);
  }
  return std::make_unique<Collision>(particle, partner, options, plan.support);
}

/// In solver units.
Press::Plan stops_of(const PressPlan& plan, const Setup& setup, double slowness)
{
  const double depth = plan.depth / setup.scale().length;
  if (!(depth > 0 && depth <= 0.8))
    fail("--depth", "cannot be used", fmt::format("{:g} R", depth), "over 0, up to 0.8 R");
  Press::Plan stops{};
  for (const double stop : plan.partial_unloads) {
    const double x = stop / setup.scale().length;
    if (!(x > (stops.stops.empty() ? 0 : stops.stops.back()) && x < depth))
      fail("partial unloads", "must ascend and stay below the depth", fmt::format("{:g} R", x));
    stops.stops.push_back(x);
  }
  stops.stops.push_back(depth);
  const double yield = setup.yield_stress() / setup.scale().stress;
  stops.ramp = slowness * (plan.ramp > 0 ? plan.ramp : default_press_ramp(depth, yield));
  stops.unload_ramp = 0.4 * stops.ramp;
  return stops;
}

}  // namespace

RunResult press(const Particle& particle, const PressPlan& plan, const Partner& partner,
                const RunOptions& options)
{
  if (options.estimate_error)
    return run_with_estimate(options, [&](const RunOptions& o) { return press(particle, plan, partner, o); });
  check_options(options, particle);
  const std::unique_ptr<Setup> setup = setup_of(particle, plan, partner, options);
  const Scales scale = setup->scale();
  const Press::Plan stops = stops_of(plan, *setup, options.slowness);
  const double depth = stops.stops.back(), duration = stops.ramp + stops.unload_ramp;

  const int across = setup->cells(options, depth);
  return mean_of_shifted_grids(
      options, across, setup->cells_made(depth, across), scale, false,
      [&](int cells, double shift, const auto& fields, const auto& progress, const auto& checkpoint) {
        Simulation run(setup->build(depth, cells, shift), options, duration, scale.stress);
        Press programme(stops, setup->e_star(), setup->drive());
        run.run(programme, {fields, scale, duration}, progress, checkpoint);
        RunSummary& s = run.result.summary;
        if (run.scene.planes) {  // the trace follows the first of them, the work is that of all
          const double copies = run.scene.bodies.front().reference().copies();
          s.work_load = copies * programme.work_load();
          s.work_unload = copies * programme.work_unload();
        } else {
          s.work_load = run.loading_work();
          s.work_unload = run.unloading_work();
        }
        s.restitution_raw = std::sqrt(std::max(0.0, s.work_unload / s.work_load));
        setup->give_planes(run.result.planes);
        return std::move(run.result);
      });
}

double force_at_depth(const RunResult& press, std::size_t plane)
{
  double deepest = 0, sum = 0;
  int count = 0;
  for (const TraceSample& t : press.trace)
    if (t.branch == Branch::load) deepest = std::max(deepest, t.delta);
  for (std::size_t k = 0; k < press.trace.size(); ++k)
    if (press.trace[k].branch == Branch::load && press.trace[k].delta >= 0.99 * deepest) {
      sum += press.planes[plane].samples[k].force;
      ++count;
    }
  return count ? sum / count : 0;
}

std::vector<PressPlane> named_planes(const std::string& name)
{
  std::vector<PressPlane> planes;
  const auto add = [&](double x, double y, double z, double speed = 1) {
    const double length = std::sqrt(x * x + y * y + z * z);
    planes.push_back({{x / length, y / length, z / length}, {}, speed, 0});
  };
  if (name == "pair" || name == "cube" || name == "die")
    for (const double side : {1.0, -1.0}) add(0, 0, side);
  if (name == "cube" || name == "die")
    for (const double side : {1.0, -1.0}) {
      add(side, 0, 0, name == "die" ? 0 : 1);
      add(0, side, 0, name == "die" ? 0 : 1);
    }
  if (name == "bcc")
    for (int k = 0; k < 8; ++k) add(k & 4 ? -1 : 1, k & 2 ? -1 : 1, k & 1 ? -1 : 1);
  if (name == "fcc")
    for (int axis = 0; axis < 3; ++axis)
      for (const double a : {1.0, -1.0})
        for (const double b : {1.0, -1.0}) {
          std::array<double, 3> x{};
          x[(axis + 1) % 3] = a, x[(axis + 2) % 3] = b;
          add(x[0], x[1], x[2]);
        }
  return planes;
}

}  // namespace granulaw
