#include "characterise/pair/two_body_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "characterise/body/law_material.hpp"

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

}  // namespace

TwoBodies::TwoBodies(const UnlikePair& pair) : first(Particle::sphere(1.0, scaled(pair.yielding, pair.yielding)))
{
  if (!std::isfinite(pair.radius_ratio)) {
    partner.wall = scaled(pair.partner, pair.yielding);
    return;
  }
  partner.particle = Particle::sphere(pair.radius_ratio, scaled(pair.partner, pair.yielding));
  if (pair.radius_ratio < 1) std::swap(first, *partner.particle);
}

RunSummary run_two_bodies(const UnlikePair& pair, double velocity, const RunOptions& options)
{
  const TwoBodies bodies(pair);
  return impact(bodies.first, {velocity / pair.wave_speed()}, bodies.partner, options).summary;
}

namespace {

/// The two bodies that stand behind a dimensionless sphere of unit radius. Lengths over lambda R*, stresses
/// and densities over those of the yielding body.
struct Scene
{
  Particle first;  ///< the smaller: impulses act at its surface points, the finer ones
  Partner partner;
  double lambda, slowness = 1;  ///< slowness: the press's ramp counts in R/c* of the larger or slower body

  /// `sphere`: the yielding body's material as the sampling plan requires it: its own, without yield, or
  /// softer at the same E_h/E_s and Y_h/Y_s.
  Scene(const UnlikePair& pair, const Material& sphere) : lambda(pair.mapping().length(1.0))
  {
    const LawMaterial &s = pair.yielding, &h = pair.partner;
    Material other;
    other.density = h.density / s.density * sphere.density;
    other.poisson_ratio = h.poisson_ratio;
    other.youngs_modulus = h.youngs_modulus / s.youngs_modulus * sphere.youngs_modulus;
    if (sphere.yields() && h.yields()) {
      other.yield_stress = h.yield_stress / s.yield_stress * sphere.yield_stress;
      other.hardening_modulus = h.hardening_modulus / h.youngs_modulus * other.youngs_modulus;
    }
    const double radius = 1 / pair.mapping().length(pair.r_eff());
    first = Particle::sphere(radius, sphere);
    if (std::isinf(pair.radius_ratio)) {
      partner.wall = other;
      return;
    }
    partner.particle = Particle::sphere(radius * pair.radius_ratio, other);
    if (pair.radius_ratio < 1) std::swap(first, *partner.particle);
    const auto period = [](const Particle& p) {
      return p.radius * std::sqrt(p.materials[0].density / p.materials[0].e_star());
    };
    slowness = std::max(1.0, period(*partner.particle) / period(first));
  }

  /// The pair's run as that of the one sphere; its times by `time_scale`.
  RunResult as_one_body(RunResult run, double time_scale) const
  {
    for (TraceSample& t : run.trace)
      t.time *= time_scale, t.force *= lambda, t.contact_radius *= std::sqrt(lambda);
    RunSummary& s = run.summary;
    s.force_max *= lambda, s.work_load *= lambda, s.work_unload *= lambda, s.contact_time *= time_scale;
    return run;
  }
};

}  // namespace

RunSource two_body_runs(const UnlikePair& pair)
{
  RunSource source;
  source.press = [pair](const Particle& sphere, const PressPlan& plan, RunOptions options) {
    const Scene scene(pair, sphere.materials[0]);
    options.slowness *= scene.slowness;
    return scene.as_one_body(press(scene.first, plan, scene.partner, options), 1.0);
  };
  source.impact = [pair](const Particle& sphere, double velocity, const RunOptions& options) {
    const Scene scene(pair, sphere.materials[0]);
    const double faster = 1 / std::sqrt(pair.one_body_density());
    return scene.as_one_body(impact(scene.first, {velocity * faster}, scene.partner, options), faster);
  };
  return source;
}

PairFarm::PairFarm(Farm& farm, const UnlikePair& pair) : farm_(farm)
{
  const LawMaterial &s = pair.yielding, &h = pair.partner;
  text_ = fmt::format(" pair {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} radii {:.17g}", h.density / s.density,
                      h.youngs_modulus / s.youngs_modulus, h.poisson_ratio, h.yield_stress / s.yield_stress,
                      h.hardening_modulus / h.youngs_modulus, pair.radius_ratio);
}

std::vector<RunOutcome> PairFarm::make(const std::vector<RunJob>& jobs, const Progress& progress)
{
  std::vector<RunJob> own = jobs;
  for (RunJob& job : own) job.key += text_;
  return farm_.run(own, progress);
}

double deepest_of_two_bodies(const UnlikePair& pair)
{
  return 0.4 * std::min(1.0, pair.radius_ratio) / pair.mapping().length(pair.r_eff());
}

CharacterisedBody yielding_body(const UnlikePair& pair)
{
  return characterised_body_of(material_of(pair.yielding));
}

}  // namespace granulaw
