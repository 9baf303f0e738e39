#include "traces.hpp"

#include <cmath>

#include "references.hpp"
#include "solver/runs.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw::verification {

namespace {

constexpr double stiffness = 100;  // E*/Y; R = rho = E* = 1

Particle sphere(const FlowLaw& hardening = {}, const FlowLaw& rate = {})
{
  Particle s = reference::unit_sphere(stiffness);
  s.materials[0].hardening = hardening, s.materials[0].rate = rate;
  return s;
}

Particle layered()
{
  Particle p = sphere();
  p.materials.push_back(p.materials.front());
  p.materials.back().youngs_modulus *= 0.5, p.materials.back().yield_stress *= 0.4;
  p.layers = {{0.15, 1}};
  return p;
}

Particle ellipsoid()
{
  Particle p = sphere(
      {"swift", {{"strength", {0.01 / std::pow(0.004, 0.2)}}, {"exponent", {0.2}}, {"offset", {0.004}}}});
  p.shape = ellipsoid_shape(Vector3(0.9, 1.0, 1.3));
  p.radius = std::cbrt(p.volume() * 3 / (4 * M_PI));
  return p;
}

RunOptions coarse(GridKind grid, int resolution = 8, int grids = 1)
{
  RunOptions o;
  o.grid = grid, o.resolution = resolution, o.shifted_grids = grids, o.samples = 100;
  return o;
}

RunResult planes(const char* arrangement, double depth, double friction = 0)
{
  PressPlan plan;
  plan.planes = named_planes(arrangement), plan.depth = depth, plan.ramp = 30;
  for (PressPlane& plane : plan.planes) plane.friction = friction;
  return press(sphere(), plan, {}, coarse(GridKind::spatial, 6));
}

}  // namespace

const std::vector<TracedRun>& traced_runs()
{
  const FlowLaw voce{"voce", {{"saturation_stress", {0.02}}, {"strain", {0.1}}}};
  const FlowLaw rate{"cowper-symonds", {{"reference_rate", {0.02}}, {"exponent", {5}}}};
  const double slow = 0.004, fast = 0.03;
  static const std::vector<TracedRun> runs{
      {"mapped-perfect", 1e-12,
       [=] { return impact(sphere(), {fast}, {}, coarse(GridKind::mapped, 10, 2)); }},
      {"mapped-elastic", 1e-12,
       [=] { return impact(reference::unit_sphere(0), {slow}, {}, coarse(GridKind::mapped)); }},
      {"rectilinear-layered", 1e-12,
       [=] { return impact(layered(), {slow}, {}, coarse(GridKind::rectilinear)); }},
      {"updated-voce", 1e-12, [=] { return impact(sphere(voce), {fast}, {}, coarse(GridKind::updated)); }},
      {"two-bodies-rated", 1e-12,
       [=] {
         Partner partner;
         partner.particle = Particle::sphere(1.5, sphere().materials[0]);
         return impact(sphere(voce, rate), {fast}, partner, coarse(GridKind::mapped));
       }},
      {"press-midplane", 1e-12,
       [=] {
         return press(reference::unit_sphere(stiffness, 0.3, 0.1), {0.04, Support::midplane, {}, 30}, {},
                      coarse(GridKind::mapped));
       }},
      {"press-stops", 1e-12,
       [=] {
         return press(sphere(), {0.04, Support::free, {0.01, 0.025}, 30}, {}, coarse(GridKind::rectilinear));
       }},
      {"single-precision", 5e-6,
       [=] {
         RunOptions o = coarse(GridKind::rectilinear);
         o.precision = Precision::single;
         return impact(sphere(voce), {fast}, {}, o);
       }},
      {"spatial-perfect", 5e-11, [=] { return impact(sphere(), {fast}, {}, coarse(GridKind::spatial, 6)); }},
      {"spatial-friction", 5e-11,
       [=] {
         Approach thrown{fast};
         thrown.tangential_velocity = fast, thrown.spin = 0.01, thrown.friction = 0.3;
         return impact(sphere(voce, rate), thrown, {}, coarse(GridKind::spatial, 6));
       }},
      {"spatial-first-contact", 5e-11,
       [=] {
         Approach thrown{fast};
         thrown.orientation = {0.3, 0.2, -0.9}, thrown.turn = 0.4, thrown.first_contact_only = true;
         return impact(ellipsoid(), thrown, {}, coarse(GridKind::spatial, 6));
       }},
      {"spatial-layered", 5e-11, [=] { return impact(layered(), {slow}, {}, coarse(GridKind::spatial, 6)); }},
      {"spatial-cube", 5e-11, [=] { return planes("cube", 0.03); }},
      {"spatial-die-friction", 5e-11, [=] { return planes("die", 0.03, 0.2); }}};
  return runs;
}

std::vector<TraceLine> lines_of(const RunResult& run, int places)
{
  const RunSummary& s = run.summary;
  const std::size_t n = run.trace.size();
  std::vector<TraceLine> lines{
      {"counts", {double(s.points), double(s.steps), double(n), double(run.planes.size())}},
      {"summary",
       {s.restitution, s.restitution_raw, s.force_max, s.delta_max, s.delta_residual, s.contact_time,
        s.work_load, s.work_unload, s.plastic_strain_max}},
      {"energy", {s.energy_error, s.contact_loss, s.hourglass}}};
  const auto column = [&](const std::string& name, auto value) {
    TraceLine line{name, {}};
    for (int k = 0; k < places; ++k) line.values.push_back(value(k * (n - 1) / (places - 1)));
    lines.push_back(line);
  };
  column("time", [&](std::size_t k) { return run.trace[k].time; });
  column("delta", [&](std::size_t k) { return run.trace[k].delta; });
  column("force", [&](std::size_t k) { return run.trace[k].force; });
  column("radius", [&](std::size_t k) { return run.trace[k].contact_radius; });
  for (std::size_t p = 0; p < run.planes.size(); ++p)
    for (int d = 0; d < 3; ++d)
      column("plane" + std::to_string(p) + "xyz"[d],
             [&](std::size_t k) { return run.planes[p].samples[k].vector[d]; });
  if (run.rebound) {
    const Rebound& r = *run.rebound;
    lines.push_back({"spin", {r.spin[0], r.spin[1], r.spin[2]}});
    lines.push_back({"impulse", {r.impulse_normal, r.impulse_tangential}});
  }
  return lines;
}

}  // namespace granulaw::verification
