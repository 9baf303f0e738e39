#include "deck/collision.hpp"

#include "deck/hertz.hpp"
#include "deck/plan_options.hpp"

namespace granulaw::deck {

namespace {

std::optional<Collision> by_law(const PlanOptions& options, const Meeting& m, double r_eff, double m_eff, double speed)
{
  return options.collide && m.known_yield && speed > 0 ? options.collide(m, r_eff, m_eff, speed) : std::nullopt;
}

}  // namespace

Overlap overlap_of(const PlanOptions& options, const Meeting& m, double r_eff, double m_eff, double speed)
{
  if (const auto collision = by_law(options, m, r_eff, m_eff, speed))
    return {collision->depth * m.mapping.length(r_eff), collision->basis};
  return {hertz_overlap(m.mapping.e_star_pair(), r_eff, m_eff, speed), "Hertz"};
}

double restitution_of(const PlanOptions& options, const Meeting& m, double r_eff, double m_eff, double speed)
{
  const auto collision = by_law(options, m, r_eff, m_eff, speed);
  return collision ? collision->restitution : 1.0;
}

}  // namespace granulaw::deck
