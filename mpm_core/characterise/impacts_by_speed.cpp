#include "characterise/impacts_by_speed.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

namespace granulaw {

namespace {

/// y(x) = 0 by bracketing.
template <class F>
double root_of(const F& y, double low, double high)
{
  std::uintmax_t steps = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(y, low, high, boost::math::tools::eps_tolerance<double>(48), steps);
  return 0.5 * (a + b);
}

}  // namespace

ImpactsBySpeed::ImpactsBySpeed(const LawShape& shape, const ContactCurve& slow, double energy_unit,
                               VelocityAxis::Kind kind)
    : shape_(shape), slow_(slow), energy_unit_(energy_unit), rate_(kind == VelocityAxis::Kind::rate)
{
  const auto node = [&](double at, std::size_t source) { nodes_.push_back(at), sources_.push_back(source); };
  if (!rate_) {
    for (std::size_t j = std::min<std::size_t>(2, shape.velocity_effects.size()); j-- > 0;)
      node(-shape.velocity_effects[j].speed, j);
    node(0.0, standstill);
  }
  for (std::size_t j = 0; j < shape.velocity_effects.size(); ++j) {
    const LawShape::VelocityEffect& i = shape.velocity_effects[j];
    node(rate_ ? std::log(i.speed) : i.speed, j);
    log_overlap_ratio_.push_back(std::log(i.speed * std::exp(i.log_overlap) / slow_impact_overlap(i.speed)));
  }
}

double ImpactsBySpeed::impact_overlap(double v) const
{
  if (!(v > 0)) return 0.0;
  return slow_impact_overlap(v) * std::exp(mix(v, [&](std::size_t j) { return log_overlap_ratio_[j]; }));
}

double ImpactsBySpeed::speed(double impact_overlap_wanted, double slowest, double fastest) const
{
  return root_of([&](double v) { return impact_overlap(v) - impact_overlap_wanted; }, 0.999 * slowest,
                 1.001 * fastest);
}

LawShape::VelocityEffect ImpactsBySpeed::effect(double v) const
{
  const auto& effects = shape_.velocity_effects;
  LawShape::VelocityEffect effect;
  effect.speed = v;
  effect.dissipation = mix(v, [&](std::size_t j) { return effects[j].dissipation; });
  effect.residual = mix(v, [&](std::size_t j) { return effects[j].residual; });
  for (std::size_t n = 0; n < LawShape::VelocityEffect::shares; ++n)
    effect.force.push_back(mix(v, [&](std::size_t j) { return effects[j].force[n]; }));
  return effect;
}

/// A quantity of the shape's velocity effects at speed v; inertia: 0 at standstill.
template <class Of>
double ImpactsBySpeed::mix(double v, const Of& of) const
{
  const std::vector<double> weights = interpolation_weights(nodes_, rate_ ? std::log(v) : v);
  double sum = 0;
  for (std::size_t j = 0; j < weights.size(); ++j)
    if (weights[j] != 0 && sources_[j] != standstill) sum += weights[j] * of(sources_[j]);
  return sum;
}

/// Where the rate-free law's work is the kinetic energy.
double ImpactsBySpeed::slow_impact_overlap(double v) const
{
  const double energy = energy_unit_ * v * v;
  return root_of([&](double x) { return slow_.work_loading(x) - energy; }, 0.0, 4.0);
}

}  // namespace granulaw
