#include "atlas/unlike_pair.hpp"

#include <cmath>

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

UnlikePair unlike_pair(const LawMaterial& a, const LawMaterial& b, double radius_ratio)
{
  const bool a_yields = yields_first(a, b);
  return {a_yields ? a : b, a_yields ? b : a, radius_ratio};
}

}  // namespace granulaw
