#include <fmt/format.h>

#include <cmath>

#include "deck/hertz.hpp"
#include "deck/plan_options.hpp"
#include "liggghts_plugin/plan/geometry.hpp"

namespace granulaw::deck {

double Meeting::one_body_density(double r_eff, double m_eff) const
{
  const double lambda = mapping.sqrt_lambda * mapping.sqrt_lambda;
  return lambda * m_eff / ball_volume(lambda * r_eff);
}

Meeting meeting_of(const AtomType& a, const AtomType& b)
{
  const bool a_yields = yields_first(a.material, b.material);
  const LawMaterial &yielding = a_yields ? a.material : b.material, &partner = a_yields ? b.material : a.material;
  Meeting m;
  m.a = a.type;
  m.b = b.type;
  m.name_a = a.material.name;
  m.name_b = b.material.name;
  m.yields = yielding;
  m.mapping = PairMapping::deformable_partner(yielding.e_star(), partner.e_star());
  m.known_yield = a.known_yield && b.known_yield;
  return m;
}

Meeting meeting_with_wall(const AtomType& a, const AtomType& wall)
{
  Meeting m = meeting_of(a, wall);
  m.wall = true;
  m.deformable = true;
  return m;
}

Meeting meeting_with_rigid_wall(const AtomType& a, int wall_type)
{
  Meeting m;
  m.a = a.type;
  m.b = wall_type;
  m.wall = true;
  m.name_a = a.material.name;
  m.name_b = wall_name;
  m.yields = a.material;
  m.mapping = PairMapping::rigid_partner(a.material.e_star());
  m.known_yield = a.known_yield;
  return m;
}

std::string types_text(const Meeting& meeting) { return fmt::format("{}:{}{}", meeting.a, meeting.wall ? "wall " : "", meeting.b); }

namespace {

std::optional<Collision> by_law(const PlanOptions& options, const Meeting& m, double r_eff, double m_eff, double speed)
{
  return options.collide && m.known_yield && speed > 0 ? options.collide(m, r_eff, m_eff, speed) : std::nullopt;
}

}  // namespace

Overlap overlap_of(const PlanOptions& options, const Meeting& m, double r_eff, double m_eff, double speed)
{
  if (const auto collision = by_law(options, m, r_eff, m_eff, speed)) return {collision->depth * m.mapping.length(r_eff), collision->basis};
  return {hertz_overlap(m.mapping.e_star_pair(), r_eff, m_eff, speed), "Hertz"};
}

double restitution_of(const PlanOptions& options, const Meeting& m, double r_eff, double m_eff, double speed)
{
  const auto collision = by_law(options, m, r_eff, m_eff, speed);
  return collision ? collision->restitution : 1.0;
}

}  // namespace granulaw::deck
