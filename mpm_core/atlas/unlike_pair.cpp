#include "atlas/unlike_pair.hpp"

#include <algorithm>
#include <cmath>

#include "base/larger.hpp"
#include "base/scales.hpp"
#include "law/law.hpp"

namespace granulaw {

namespace {

constexpr double unit_mass = 4.0 / 3.0 * M_PI;

}  // namespace

double UnlikePair::wave_speed() const
{
  return std::sqrt(yielding.e_star() / yielding.density);
}

double UnlikePair::m_eff() const
{
  const double inverse_partner = 1.0 / (std::pow(radius_ratio, 3) * partner.density / yielding.density);
  return unit_mass / (1.0 + inverse_partner);
}

double UnlikePair::one_body_density() const
{
  // lambda m* = rho 4/3 pi (lambda R*)^3
  const double lambda = mapping().length(1.0);
  return m_eff() / (unit_mass * lambda * lambda * std::pow(r_eff(), 3));
}

double UnlikePair::yield_velocity() const
{
  return granulaw::yield_velocity(yielding.e_star(), yielding.yield_stress,
                                  yielding.density * one_body_density());
}

double UnlikePair::axis_speed_ratio() const
{
  const double sqrt_lambda = mapping().sqrt_lambda;
  const double density =
      radius_ratio == 0 ? partner.density / yielding.density * std::pow(sqrt_lambda, -4) : one_body_density();
  return std::sqrt(density) * sqrt_lambda;
}

double fastest_of_law(const UnlikePair& pair, double axis_speed2)
{
  const double density = pair.yielding.density * pair.one_body_density();
  return std::sqrt(axis_speed2 * pair.yielding.yield_stress / density);
}

namespace {

/// The three causes of unlike_pair.hpp, without their coefficients.
struct Causes
{
  double share = 0, unshared = 0;  // 1
  double finite = 0;               // 2, signed
  double uneven = 0;               // 3
  double e = 1;
  bool within_measured = true;
};

/// Coefficients: bounds of what docs/evidence/pairs.md shows, those that cover all but one of its pairs less the mixtures
/// (.069, .51, 4.8 of F; .081, 2.8, 9.8 of e) rounded up; 6 covers laws at other radii, too.
ReductionError bound_of(const Causes& c)
{
  const double finite = std::abs(c.finite), uneven = std::abs(c.uneven);
  return {0.08 * c.share * c.unshared + 0.55 * finite + 6 * uneven,
          0.09 * std::pow(c.share, 0.7) * c.unshared + 3 * finite * (1 - c.e * c.e) + 10 * uneven, c.within_measured};
}

Causes causes_of(const UnlikePair& pair, double velocity)
{
  const LawMaterial &s = pair.yielding, &h = pair.partner;
  const double stiffness = h.e_star() / s.e_star(), yield = s.yield_stress / s.e_star();
  const double mapping = pair.mapping().sqrt_lambda, r = pair.r_eff();
  // The one body's impact in its own units: overlap, Hertz's or at a mean pressure of 2.8 Y; and about its
  // e (5 % high near the onset, up to 16 % low at E*/Y = 1000: low is the safe side).
  const double v_over_c = velocity / pair.wave_speed();
  const double v = v_over_c * std::sqrt(pair.one_body_density());
  const double hertz = std::pow(15.0 / 16.0 * unit_mass * v * v, 0.4);
  const double depth = std::max(hertz, v * std::sqrt(unit_mass / (5.6 * M_PI * yield)));
  const double e = std::min(1.0, 1.3 * std::pow(velocity / pair.yield_velocity(), -0.2));

  // 1. Elastic partner: the fraction of the overlap that is the partner's. Partly where it yields soon after:
  // at Y_h/Y_s = 1.1 the error is 0.4 of an elastic partner's, from 1.5 on all of it.
  Causes c;
  c.e = e;
  c.share = 1 - 1 / mapping;
  c.unshared = std::min(1.0, std::sqrt(std::max(0.0, h.yield_stress / s.yield_stress - 1) / 0.5));
  // 2. Each centre comes nearer by k F/(E* R) less, k = 0.45; the rule has k F/(E*_s R*). Over the overlap:
  const double force_per_overlap = std::min(17.6 * yield, 4.0 / 3.0 * std::sqrt(depth));
  c.finite = 0.45 * force_per_overlap * (1 - r - r / (pair.radius_ratio * stiffness));
  // 3. The smaller body's contact is larger against its radius, as far as the other gives way; and what the larger one
  // loses to waves grows with the same overlap.
  const double unlike = (1 - 1 / pair.radius_ratio) / (1 + 1 / pair.radius_ratio);
  c.uneven = unlike * unlike * depth * std::min(1.0, 2 * c.share);

  const bool radii =
      !std::isfinite(pair.radius_ratio) || (pair.radius_ratio >= 0.1 && pair.radius_ratio <= 10);
  c.within_measured = radii && stiffness >= 0.3 && h.yield_stress >= s.yield_stress &&
                      v * v / yield <= 0.003 && hertz * mapping * mapping <= 0.13;
  return c;
}

}  // namespace

ReductionError estimate_reduction_error(const UnlikePair& pair, double velocity)
{
  constexpr double resolved = 0.002;  // by the measurements
  ReductionError error = bound_of(causes_of(pair, velocity));
  error.force += resolved, error.restitution += resolved;
  return error;
}

ReductionError estimate_remaining_error(const UnlikePair& pair, double law_radius_ratio, double velocity)
{
  UnlikePair made = pair;
  made.radius_ratio = law_radius_ratio;
  Causes left = causes_of(pair, velocity);
  const Causes there = causes_of(made, velocity);
  left.share = 0, left.finite -= there.finite, left.uneven -= there.uneven;
  left.within_measured = left.within_measured && there.within_measured;
  return bound_of(left);
}

namespace {

/// The larger error of the pair at either body being the larger one. `estimate(pair, velocity)`.
template <class Estimate>
ReductionError either_way(const LawMaterial& a, const LawMaterial& b, double radius_ratio, Estimate estimate)
{
  constexpr double measured_to =
      0.002;  // rho V^2/Y of the one body that stands for the pair: docs/evidence/pairs.md
  ReductionError worst;
  for (const double ratio : {radius_ratio, 1 / radius_ratio}) {
    const UnlikePair pair = unlike_pair(a, b, ratio);
    if (!pair.yielding.yields()) return worst;
    const ReductionError one = estimate(pair, fastest_of_law(pair, measured_to));
    worst.force = larger(worst.force, one.force);
    worst.restitution = larger(worst.restitution, one.restitution);
    worst.within_measured = worst.within_measured && one.within_measured;
  }
  return worst;
}

}  // namespace

UnlikePair unlike_pair(const LawMaterial& a, const LawMaterial& b, double radius_ratio)
{
  const bool a_yields = yields_first(a, b);
  return {a_yields ? a : b, a_yields ? b : a, radius_ratio};
}

ReductionError pair_rule_error(const LawMaterial& a, const LawMaterial& b, double radius_ratio)
{
  return either_way(a, b, radius_ratio, estimate_reduction_error);
}

ReductionError own_law_error(const LawMaterial& a, const LawMaterial& b, double radius_ratio,
                             double law_radius_ratio)
{
  return either_way(a, b, radius_ratio, [&](const UnlikePair& pair, double velocity) {
    return estimate_remaining_error(pair, law_radius_ratio, velocity);
  });
}

}  // namespace granulaw
