#include "law/stated_collision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "contact/adhesion.hpp"
#include "law/damage_number.hpp"

namespace granulaw {

namespace {

/// Past the table's last overlap the force goes on with its last stiffness: good enough for this fraction of
/// it.
constexpr double overlap_margin = 0.05;

/// Largest V/c* of the spheres of an elastic pair, V each one's part of the approach.
double swing_of(const Law& law, const ChosenPair& pair, double velocity)
{
  const auto& [a, b] = pair.names;
  const auto soft = [&](const std::string& name) { return name == wall_name ? 0.0 : 1 / law.bodies.at(name).material.e_star(); };
  const double both = soft(a) + soft(b);
  const auto swing = [&](const std::string& name, double radius) {
    if (name == wall_name || std::isinf(radius)) return 0.0;
    return velocity * soft(name) / both * std::sqrt(law.bodies.at(name).material.density * soft(name));
  };
  return std::max(swing(a, pair.radius), swing(b, pair.radius2));
}

/// With the mass that moves: that of the body, or of it and the sphere that it meets.
ImpactBody moved(const Law& law, const ChosenPair& pair, ImpactBody body)
{
  if (body.mass == 0) return body;
  const double own = law.bodies.at(pair.names.first).mass(pair.radius);
  if (!(body.mass >= own))
    fail("--impact-body-mass", "is below the mass of its sphere", fmt::format("{:g} kg", body.mass), fmt::format("{:.4g} kg or more", own));
  if (!pair.has_rigid_wall() && std::isfinite(pair.radius2))
    body.mass = effective_mass(body.mass, law.bodies.at(pair.names.second).mass(pair.radius2));
  return body;
}

/// All but the replay, of which only the flags of speed are set.
StatedCollision state(const Law& law, const ChosenPair& pair, double velocity)
{
  const auto& [a, b] = pair.names;
  StatedCollision result;
  result.replay.left_speeds = velocity > pair.law.max_speed(pair.r_eff, pair.m_eff);
  result.replay.held_speed = velocity < pair.law.min_speed(pair.r_eff, pair.m_eff);
  result.damage_number = damage_number(pair.law, velocity);
  result.axis_speed = pair.law.axis_speed(pair.r_eff, pair.m_eff, velocity);
  result.statement = statement_of(law, pair.law, a, b)
                         .at_distance(distance_in_size(law, pair.law, a, b, pair.radius, pair.radius2));
  ErrorBound& bound = result.statement.bound;
  if (bound.swing_force > 0) bound = bound.at_swing(swing_of(law, pair, velocity));
  constexpr double rounding = 1e-9;
  result.beyond_bound = result.damage_number > result.statement.damage_number_max * (1 + rounding);
  result.needs_axis = result.beyond_bound && !pair.law.curve->axis();
  return result;
}

}  // namespace

StatedCollision collide(const Law& law, const ChosenPair& pair, double velocity, const std::string& source,
                        const ImpactBody& body, const Attraction& attraction)
{
  if (!(velocity >= 1e-12 && velocity <= 1e6))  // as of the radii (chosen_pair.cpp)
    fail("--velocity", "cannot be used", fmt::format("{:g} m/s", velocity), "1e-12 to 1e+06 m/s");
  StatedCollision result = state(law, pair, velocity);
  result.replay = replay_collision(pair.law, pair.r_eff, pair.m_eff, velocity, 20000, moved(law, pair, body), attraction);
  if (attraction.work > 0) {
    if (body.compliance > 0) fail("--work-of-adhesion", "cannot go with --impact-body-compliance");
    const Tabulated normal(pair.law, pair.law.measure(), {});
    const std::string why = DentAdhesion(normal, attraction.work, attraction.range).fault(normal, pair.r_eff, result.replay.delta_max);
    if (!why.empty()) fail("--work-of-adhesion", why);
  }
  const double allowed = (1 + overlap_margin) * pair.limit();
  if (result.replay.delta_max > allowed)
    fail(source, "the collision leaves the law's range of overlaps by more than 5 %",
         fmt::format("{:.4g} m", result.replay.delta_max), fmt::format("up to {:.4g} m", allowed));
  return result;
}

ErrorBound bound_of_impact(const Law& law, const ChosenPair& pair, double velocity)
{
  return state(law, pair, velocity).bound();
}

}  // namespace granulaw
