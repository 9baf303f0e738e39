#pragma once

#include <optional>
#include <string>

#include "law/law.hpp"
#include "options.hpp"
#include "pair_names.hpp"

namespace granulaw {

/// The law file and the two bodies that a command line names.
struct PairOptions
{
  std::string law, pair;
  std::optional<double> radius, radius2;  ///< m
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

/// --pair, --radius and --radius2.
void define_pair_options(Options& command, PairOptions& options);

/// Throws Error where the options name no pair of the law, or sizes that it does not hold for.
ChosenPair choose_pair(const Law& law, const PairOptions& options);

}  // namespace granulaw
