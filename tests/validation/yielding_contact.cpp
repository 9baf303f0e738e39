#include "yielding_contact.hpp"

#include <algorithm>
#include <cmath>

#include "base/larger.hpp"

namespace granulaw {

double YieldingContact::shear_strength(double a) const
{
  const double strain = std::hypot(tabor_strain * a / radius_, shear_strain * slid_ / a);
  return widening * material_.at(strain) / std::sqrt(3.0) * M_PI * a * a;
}

/// Sliding over deepening of the flow at q/sqrt(1 - q^2) = 1.
double YieldingContact::sliding_slope(double strength) const
{
  return normal_loss * law(depth_, depth_).force / strength;
}

/// Outside the yield curve at T/T_0 = q.
bool YieldingContact::overloaded(double delta, double depth, double q) const
{
  if (depth < delta) return true;
  const double share = 1 - normal_loss + normal_loss * std::sqrt(1 - q * q);
  return law(delta, depth).force > share * law(depth, depth).force;
}

/// Lets the contact flow from the elastic force `stretched` back to the yield curve while the surfaces stick;
/// the tangential force there. One unknown, q: what the spring loses is the flow's sliding, the normal of the
/// curve gives the deepening.
double YieldingContact::flow(double delta, double k, double stretched, double strength)
{
  const double from = depth_, slope = sliding_slope(strength);
  const auto depth_at = [&](double q) {
    return from + (stretched - strength * q) / (k * slope * q / std::sqrt(1 - q * q));
  };
  double inside = 0, outside = std::min(1.0, stretched / strength);
  for (int halving = 0; halving < 45; ++halving) {
    const double q = 0.5 * (inside + outside);
    (overloaded(delta, depth_at(q), q) ? outside : inside) = q;
  }
  depth_ = std::max(delta, depth_at(inside));
  return strength * inside;
}

/// The same while the surfaces slide: T is friction's, the depth alone is unknown.
void YieldingContact::flow_sliding(double delta, double strength)
{
  const double from = depth_;
  const auto q_at = [&](double depth) {
    return std::min(1.0, friction_ * law(delta, depth).force / strength);
  };
  double inside = 2 * std::max(from, delta), outside = std::max(from, delta);
  for (int halving = 0; halving < 45; ++halving) {
    const double depth = 0.5 * (inside + outside);
    (overloaded(delta, depth, q_at(depth)) ? outside : inside) = depth;
  }
  depth_ = inside;
  const double q = std::min(q_at(depth_), 1 - 1e-9);
  slid_ += (depth_ - from) * sliding_slope(strength) * q / std::sqrt(1 - q * q);
}

ContactForces YieldingContact::move(double delta, double slide, double)
{
  stretch_ += slide;
  if (depth_ == 0) depth_ = delta;
  const Answer elastic = law(delta, std::max(depth_, delta));
  if (elastic.force <= 0) return {0, stretch_ = 0};
  const double k = stiffness_ * elastic.contact_radius, strength = shear_strength(elastic.contact_radius);
  const double stretched = k * std::abs(stretch_), from = depth_;
  double pull = std::min(stretched, strength);
  if (pull < 1e-9 * strength)  // the normal force alone
    depth_ = larger(depth_, delta);
  else if (overloaded(delta, depth_, std::min(pull, friction_ * elastic.force) / strength))
    pull = flow(delta, k, stretched, strength);
  const bool slides = pull > friction_ * law(delta, depth_).force;
  if (!slides)
    slid_ += (stretched - pull) / k;
  else if (depth_ > from) {
    depth_ = from;
    flow_sliding(delta, strength);
  }
  const double normal = law(delta, depth_).force;
  pull = std::copysign(std::min(pull, friction_ * normal), stretch_);
  stretch_ = pull / k;
  return {normal, pull};
}

}  // namespace granulaw
