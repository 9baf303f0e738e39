#pragma once

#include <functional>
#include <map>
#include <optional>

#include "deck/meeting.hpp"
#include "law/law.hpp"

namespace granulaw::deck {

/// A collision as a law computes it.
struct Collision
{
  double depth = 0;           ///< largest overlap/(lambda R*)
  double restitution = 1;     ///< e
  const char* basis = "law";  ///< or "Thornton": the deck's own model
};
/// The collision of two bodies at the relative speed `speed` (m/s); empty: no law at hand.
using Collide = std::function<std::optional<Collision>(const Meeting&, double r_eff, double m_eff, double speed)>;
/// Stiffness, N/m, of the stiffest that a contact is which has just reached `overlap` (m), on the way in or
/// back out, by the law of these radii (m; of a wall infinite); empty: no law at hand.
using Stiffness = std::function<std::optional<double>(const Meeting&, double radius_a, double radius_b, double r_eff, double overlap)>;

/// Values that the deck does not give, or that replace its own; SI units.
struct PlanOptions
{
  std::optional<double> drop_height;                      ///< m, of every particle to the lowest wall
  std::optional<double> radius_min, radius_max, density;  ///< of particles whose own are not known
  std::optional<double> speed;                            ///< m/s, largest approach speed of any contact
  std::optional<double> particles;                        ///< number, for the cost
  double rate = 2e6;                                      ///< particle-steps a second
  std::map<int, LawMaterial> materials;                   ///< by atom type, where a name is known for it
  Collide collide;
  Stiffness stiffness;
};

/// Largest overlap, m, of a head-on collision, and what it is by: "law", "Thornton" or "Hertz".
struct Overlap
{
  double value = 0;
  std::string basis;
};
/// By the law at hand, else by Hertz. m_eff: kg; speed: m/s, above 0.
Overlap overlap_of(const PlanOptions& options, const Meeting& meeting, double r_eff, double m_eff, double speed);

/// e of the same; 1 without a law.
double restitution_of(const PlanOptions& options, const Meeting& meeting, double r_eff, double m_eff, double speed);

}  // namespace granulaw::deck
