#pragma once

#include <string>
#include <vector>

#include "law/pair_statement.hpp"

namespace granulaw {

/// The laws of a pair of a file, by kind: `mpm table` and `mpm info` print them with the same words.
struct PairLine
{
  std::string radii;                   ///< for which they are: "a rigid wall", "radii 1 : 1", ...
  PairStatement statement;             ///< of all of them: the largest bound
  double least_damage_number_max = 0;  ///< of one of them; statement.damage_number_max: the largest

  /// "single law, a rigid wall: error bound F_max 0.72 %, e 0.0028, to I = 0.0625".
  std::string text() const;
};

std::vector<PairLine> pair_lines(const Law& law, const LawPair& pair);

}  // namespace granulaw
