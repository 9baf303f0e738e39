#include "deck/tangential_need.hpp"

#include <fmt/format.h>

#include <cmath>

#include "contact/thornton.hpp"

namespace granulaw::deck {

namespace {

/// V/V_y of the slowest impacts that docs/evidence/oblique.md compares with the solver: there the spring's spin is 43 % off.
constexpr double slowest_compared = 10;
/// Below a tenth of the contacts the spring's error of 69 % in spin changes less than the law's own error of 12 %.
constexpr double few = 0.1;

double friction_of(const Scene& scene, const Meeting& m)
{
  const auto place = static_cast<std::size_t>((m.a - 1) * scene.types + m.b - 1);
  return place < scene.friction.size() ? scene.friction[place] : 0.0;
}

}  // namespace

double sticking_part(double friction, double restitution)
{
  const double tangent = 3.5 * friction * (1 + restitution);
  return tangent * tangent / (1 + tangent * tangent);
}

TangentialNeed tangential_need(const Scene& scene, const Plan& plan)
{
  TangentialNeed need;
  double fastest = 0, most_friction = 0, most_sticking = 0;
  for (const PairPlan& p : plan.pairs) {
    if (!p.visited || !p.meeting.known_yield) continue;
    const double mu = friction_of(scene, p.meeting);
    most_friction = std::max(most_friction, mu);
    if (!p.needs_table || !(mu > 0)) continue;
    const double ratio = p.speed / p.yield_velocity;
    const double sticking = sticking_part(mu, ratio > 1 ? thornton_restitution(ratio) : 1.0);
    most_sticking = std::max(most_sticking, sticking);
    const bool needs = ratio >= slowest_compared && sticking >= few;
    if (needs && ratio > fastest) need.pair = &p, need.friction = mu, need.sticking = sticking;
    fastest = std::max(fastest, ratio);
  }
  if (need.pair)
    need.reason = fmt::format("types {} reach {:.3g} V_y, and at friction {:g} {:.0f} % of random collisions stick", types_text(need.pair->meeting),
        need.pair->speed / need.pair->yield_velocity, need.friction, 100 * need.sticking);
  else if (!(most_friction > 0))
    need.reason = "no contact that may yield has friction";
  else if (!(fastest > 0))
    need.reason = "no contact with friction yields";
  else if (most_sticking < few)
    need.reason = fmt::format("at most {:.0f} % of random collisions stick", 100 * most_sticking);
  else
    need.reason = fmt::format("impacts reach {:.3g} V_y, and the spring is known to fail from {:g} on", fastest, slowest_compared);
  return need;
}

}  // namespace granulaw::deck
