#pragma once

#include <optional>
#include <string>

#include "law/law.hpp"
#include "law/pair_names.hpp"

namespace granulaw {

/// Two bodies by name and size, as a caller names them.
struct PairAsked
{
  std::string law, pair;                  ///< the law file; "a:b" or "a:wall", empty: the only pair of the law
  std::optional<double> radius, radius2;  ///< m; without: 1e-3, or the only one that the law allows; the first's
};

/// Two bodies that may collide, and their law: SI.
struct ChosenPair
{
  PairNames names;
  double radius,
      radius2;  ///< of the second: infinity: a deformable wall; no meaning where it is the rigid wall
  PairLaw law;  ///< refers to the Law that it was chosen of
  double r_eff, m_eff;

  bool has_rigid_wall() const { return names.second == wall_name; }
  double limit() const { return law.max_overlap(r_eff); }  ///< m, where the law's table ends
};

/// Throws Error where no pair of the law is named, or sizes that it does not hold for.
ChosenPair choose_pair(const Law& law, const PairAsked& asked);

}  // namespace granulaw
