#include "atlas/impacts_by_speed.hpp"

#include <algorithm>
#include <cmath>

#include "atlas/overlap_at_work.hpp"

namespace granulaw {

namespace {

std::vector<double> speeds_of(const LawShape& shape)
{
  std::vector<double> speeds;
  for (const LawShape::VelocityEffect& effect : shape.velocity_effects) speeds.push_back(effect.speed);
  return speeds;
}

}  // namespace

ImpactsBySpeed::ImpactsBySpeed(const LawShape& shape, const Curve& slow, double energy_unit,
                               AxisTable::By kind)
    : shape_(shape), slow_(slow), energy_unit_(energy_unit), between_(speeds_of(shape), kind)
{
  for (const LawShape::VelocityEffect& i : shape.velocity_effects)
    log_overlap_ratio_.push_back(std::log(i.speed * std::exp(i.log_overlap) / slow_impact_overlap(i.speed)));
}

double ImpactsBySpeed::impact_overlap(double v) const
{
  if (!(v > 0)) return 0.0;
  return slow_impact_overlap(v) *
         std::exp(between_.at(v, [&](std::size_t j) { return log_overlap_ratio_[j]; }));
}

double ImpactsBySpeed::speed(double impact_overlap_wanted, double slowest, double fastest) const
{
  return rising_root([&](double v) { return impact_overlap(v) - impact_overlap_wanted; }, 0.999 * slowest,
                     1.001 * fastest, 48);
}

LawShape::VelocityEffect ImpactsBySpeed::effect(double v) const
{
  const auto& effects = shape_.velocity_effects;
  LawShape::VelocityEffect effect;
  effect.speed = v;
  effect.dissipation = between_.at(v, [&](std::size_t j) { return effects[j].dissipation; });
  effect.residual = between_.at(v, [&](std::size_t j) { return effects[j].residual; });
  for (std::size_t n = 0; n < LawShape::VelocityEffect::shares; ++n)
    effect.force.push_back(between_.at(v, [&](std::size_t j) { return effects[j].force[n]; }));
  return effect;
}

/// Overlap at which the rate-independent law's work is the kinetic energy.
double ImpactsBySpeed::slow_impact_overlap(double v) const
{
  return overlap_at_work(slow_, energy_unit_ * v * v);
}

}  // namespace granulaw
