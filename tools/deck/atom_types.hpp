#pragma once

#include <map>
#include <vector>

#include "deck/questions.hpp"
#include "deck/scene.hpp"
#include "law/law.hpp"

namespace granulaw::deck {

struct PlanOptions;

/// One atom type of the deck: what it is made of, and its particles over all their sources.
struct AtomType
{
  int type = 1;
  double radius_min = 0, radius_max = 0;  ///< m; 0: no particles, a wall's
  double density = 0;                     ///< kg/m^3, the largest
  LawMaterial material;
  bool known_yield = false;  ///< whether the yield stress is known, be it infinite
};

/// The types that have particles. Asks for what is missing.
std::map<int, AtomType> particle_types(const Scene& scene, const PlanOptions& options, std::vector<Question>& questions);

/// The type of a wall whose material gives way; empty where its moduli are missing, which it requires.
std::optional<AtomType> wall_type(const Scene& scene, int type, const PlanOptions& options, std::vector<Question>& questions);

}  // namespace granulaw::deck
