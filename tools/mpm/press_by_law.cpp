#include "press_by_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "base/error.hpp"
#include "law/between_planes.hpp"

namespace granulaw {

namespace {

/// What planes of a press do to a body, sample by sample, SI.
struct Recorder
{
  const BetweenPlanes& body;
  const std::vector<PressPlane>& planes;
  const std::vector<Vector>& normals;
  double radius, force;  // m, N: R and Y R^2
  RunResult& result;

  void note(double time, double way, Branch branch)
  {
    const auto radius_of = [&](std::size_t k) { return radius * std::sqrt(body.areas()[k] / M_PI); };
    result.trace.push_back({time, way * radius, body.forces()[0] * force, radius_of(0), branch, branch == Branch::load ? 0 : 1});
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const double f = body.forces()[k] * force, height = radius * (1.0 - body.particle().sides[k].overlap);
      const Vector push = times(normals[k], -f), at = times(normals[k], height);
      result.planes[k].samples.push_back({way * planes[k].speed * radius, f, push, {}, at, {radius_of(k), radius_of(k)}});
    }
  }
};

PlasticBody body_of(const PairLaw& wall)
{
  const LawMaterial& m = wall.yielding->material;
  if (!m.yields()) fail("--by", "law needs a material that yields: contacts of an elastic one do not know each other", m.name, "solver");
  return {*wall.curve, m.youngs_modulus, m.poisson_ratio, m.flow_stress()};
}

}  // namespace

RunResult press_by_law(const PairLaw& wall, double radius, const PressPlan& plan)
{
  const std::clock_t start = std::clock();
  const PlasticBody body = body_of(wall);
  const LawMaterial& material = wall.yielding->material;
  std::vector<Vector> normals;
  std::vector<double> overlaps, ways;
  for (const PressPlane& p : plan.planes) {
    if (p.friction > 0) fail("--planes", "cannot have friction with --by law", fmt::format("{:g}", p.friction), "0, or --by solver");
    normals.push_back(unit(p.direction));
    overlaps.push_back(p.distance ? 1.0 - *p.distance / radius : 0.0);
  }
  BetweenPlanes sphere(body, normals, overlaps);
  const auto go = [&](double way) {
    ways.clear();
    for (const PressPlane& p : plan.planes) ways.push_back(way * p.speed);
    sphere.move(ways);
  };

  RunResult result;
  result.planes.resize(plan.planes.size());
  for (std::size_t k = 0; k < normals.size(); ++k) result.planes[k].normal = times(normals[k], -1.0);
  const double pressure = material.yield_stress * radius * radius, depth = plan.depth / radius;
  Recorder recorder{sphere, plan.planes, normals, radius, pressure, result};
  constexpr int samples = 400;
  constexpr double back = 1e-4;  // of a sample on the way back
  const double ramp = (plan.ramp > 0 ? plan.ramp : default_press_ramp(depth, material.yield_stress / material.e_star())) * radius / std::sqrt(material.e_star() / material.density);
  double now = 0;
  for (int k = 1; k <= samples; ++k) {
    const double s = std::sin(0.5 * M_PI * k / samples), next = depth * s * s;
    go(next - now);
    now = next;
    recorder.note(ramp * k / samples, now, Branch::load);
  }
  RunSummary& s = result.summary;
  const double unit = pressure * radius, put_in = sphere.work();
  double time = ramp, ended = 0;
  const auto pressed = [&] {
    for (std::size_t k = 0; k < plan.planes.size(); ++k)
      if (plan.planes[k].speed > 0 && sphere.forces()[k] > 0) return true;
    return false;
  };
  for (int after = 10; now > 0 && after > 0;) {  // the centre comes to rest
    if (!pressed()) --after;
    go(-back);
    now -= back, time += ramp * back / depth;
    if (sphere.forces()[0] > 0) ended = now;
    recorder.note(time, now, Branch::unload);
  }
  for (const TraceSample& t : result.trace) s.force_max = std::max(s.force_max, t.force);
  s.delta_max = plan.depth, s.delta_residual = ended * radius, s.contact_time = time;
  s.work_load = put_in * unit, s.work_unload = (put_in - sphere.work()) * unit;
  s.restitution = s.restitution_raw = s.work_load > 0 ? std::sqrt(std::max(s.work_unload / s.work_load, 0.0)) : 0.0;
  const double held = sphere.particle().stored(body) + sphere.particle().state.dissipated;
  s.energy_error = put_in > 0 ? std::abs(held - sphere.work()) / put_in : 0.0;
  s.cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace granulaw
