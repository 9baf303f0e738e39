#include "characterise/pair/reduction_error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/scales.hpp"

namespace granulaw {

namespace {

/// `m` in units of the yielding body's E* and density.
Material scaled(const LawMaterial& m, const LawMaterial& unit)
{
  Material material;
  material.density = m.density / unit.density;
  material.youngs_modulus = m.youngs_modulus / unit.e_star();
  material.poisson_ratio = m.poisson_ratio;
  if (m.yields()) {
    material.yield_stress = m.yield_stress / unit.e_star();
    material.hardening_modulus = m.hardening_modulus / unit.e_star();
  }
  return material;
}

Particle one_body(const UnlikePair& pair)
{
  Particle sphere =
      Particle::sphere(pair.mapping().length(pair.r_eff()), scaled(pair.yielding, pair.yielding));
  sphere.materials[0].density = pair.one_body_density();
  return sphere;
}

/// F of the pair is that of the one body over lambda.
RunSummary of_pair(RunSummary s, const UnlikePair& pair)
{
  const double lambda = pair.mapping().length(1.0);
  s.force_max /= lambda, s.work_load /= lambda, s.work_unload /= lambda;
  return s;
}

/// The smaller body first: impulses act at its surface points, the finer ones.
struct TwoBodies
{
  Particle first;
  Partner partner;

  explicit TwoBodies(const UnlikePair& pair)
      : first(Particle::sphere(1.0, scaled(pair.yielding, pair.yielding)))
  {
    if (!std::isfinite(pair.radius_ratio)) {
      partner.wall = scaled(pair.partner, pair.yielding);
      return;
    }
    partner.particle = Particle::sphere(pair.radius_ratio, scaled(pair.partner, pair.yielding));
    if (pair.radius_ratio < 1) std::swap(first, *partner.particle);
  }
};

}  // namespace

RunSummary run_as_one_body(const UnlikePair& pair, double velocity, const RunOptions& options)
{
  return of_pair(impact(one_body(pair), {velocity / pair.wave_speed()}, {}, options).summary, pair);
}

RunResult two_body_impact(const UnlikePair& pair, double velocity, const RunOptions& options)
{
  const TwoBodies bodies(pair);
  return impact(bodies.first, {velocity / pair.wave_speed()}, bodies.partner, options);
}

RunSummary run_two_bodies(const UnlikePair& pair, double velocity, const RunOptions& options)
{
  return two_body_impact(pair, velocity, options).summary;
}

ContactRecord two_body_record(const UnlikePair& pair, double velocity, const RunOptions& options)
{
  const RunResult result = two_body_impact(pair, velocity, options);
  const PairMapping unit =
      PairMapping::deformable_partner(1.0, pair.partner.e_star() / pair.yielding.e_star());
  const double length = unit.length(pair.r_eff()), force = unit.force(pair.r_eff());
  const double radius = unit.radius(pair.r_eff());
  ContactRecord press;
  press.depth = result.summary.delta_max / length;
  press.residual = std::max(0.0, result.summary.delta_residual / length);
  press.work_ratio = result.summary.work_unload / result.summary.work_load;
  for (const TraceSample& t : result.trace)
    if (t.branch == Branch::load && t.delta / length > (press.loading.empty() ? 0.0 : press.loading.back().x))
      press.loading.push_back({t.delta / length, t.force / force, t.contact_radius / radius});
  return press;
}

RunSummary press_as_one_body(const UnlikePair& pair, double depth, double ramp, const RunOptions& options)
{
  const Particle sphere = one_body(pair);
  PressPlan plan;
  plan.depth = depth * sphere.radius, plan.ramp = ramp;
  return of_pair(press(sphere, plan, {}, options).summary, pair);
}

RunSummary press_two_bodies(const UnlikePair& pair, double depth, double ramp, const RunOptions& options)
{
  const TwoBodies bodies(pair);
  PressPlan plan;
  plan.depth = depth * pair.mapping().length(pair.r_eff());
  plan.ramp = ramp * std::max(1.0, pair.radius_ratio) / bodies.first.radius;
  return press(bodies.first, plan, bodies.partner, options).summary;
}

}  // namespace granulaw
