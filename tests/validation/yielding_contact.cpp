#include "yielding_contact.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

double YieldingContact::shear_strength(double a) const
{
  const double strain = std::hypot(tabor_strain * a / radius_, shear_strain * slid_ / a);
  return widening * material_.at(strain) / std::sqrt(3.0) * M_PI * a * a;
}

/// Outside the yield curve at T/T_0 = q.
bool YieldingContact::overloaded(double delta, double depth, double q) const
{
  if (depth < delta) return true;
  const double share = 1 - normal_loss + normal_loss * std::sqrt(1 - q * q);
  return law(delta, depth).force > share * law(depth, depth).force;
}

/// Lets the contact flow from the elastic `pull` back to the yield curve; the tangential force there. One
/// unknown, q: what the spring loses is the flow's sliding, the normal of the curve tells the deepening.
double YieldingContact::flow(double delta, double k, double pull, double strength)
{
  const double full = law(depth_, depth_).force;
  const auto depth_at = [&](double q) {
    const double per_deepening = normal_loss * full / strength * q / std::sqrt(1 - q * q);
    return depth_ + (pull - strength * q) / (k * per_deepening);
  };
  double inside = 0, outside = std::min(1.0, pull / strength);
  for (int halving = 0; halving < 45; ++halving) {
    const double q = 0.5 * (inside + outside);
    (overloaded(delta, depth_at(q), q) ? outside : inside) = q;
  }
  depth_ = std::max(delta, depth_at(inside));
  return strength * inside;
}

ContactForces YieldingContact::move(double delta, double slide, double)
{
  stretch_ += slide;
  if (depth_ == 0) depth_ = delta;
  const ContactForce elastic = law(delta, std::max(depth_, delta));
  if (elastic.force <= 0) return {0, stretch_ = 0};
  const double k = stiffness_ * elastic.contact_radius, strength = shear_strength(elastic.contact_radius);
  const double stretched = std::min(k * std::abs(stretch_), friction_ * elastic.force);
  double pull = std::min(stretched, strength);
  if (pull < 1e-9 * strength)  // the normal force alone
    depth_ = std::max(depth_, delta);
  else if (overloaded(delta, depth_, pull / strength))
    pull = flow(delta, k, stretched, strength);
  slid_ += (stretched - pull) / k;
  const double normal = law(delta, depth_).force;
  pull = std::copysign(std::min(pull, friction_ * normal), stretch_);
  stretch_ = pull / k;
  return {normal, pull};
}

}  // namespace granulaw
