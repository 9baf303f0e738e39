#pragma once

#include <array>
#include <compare>
#include <vector>

#include "calibrate/parameters.hpp"

namespace granulaw {

class Atlas;

/// Materials at which a slow model is computed, and between which it is interpolated: E, Y and Y + 2 H are
/// whole powers of a factor. Only what `varied` names is rounded to the lattice.
class MaterialLattice
{
 public:
  explicit MaterialLattice(std::vector<Parameter> varied) : varied_(std::move(varied)) {}

  struct Key
  {
    std::array<int, 3> steps{};  ///< in the order of all_parameters
    auto operator<=>(const Key&) const = default;
  };
  /// One lattice material beside the wanted one, and its weight: linear in the logarithms.
  struct Corner
  {
    Key key;
    double weight;
    LawMaterial material;
  };
  std::vector<Corner> around(const LawMaterial& material) const;
  /// The modulus of the lattice next to this one: there one composed law serves, elsewhere it takes two.
  static double nearest(double modulus);

 private:
  bool varies(Parameter parameter) const;

  std::vector<Parameter> varied_;
};

/// A material brought into the atlas, its yield stress as it is.
LawMaterial within_atlas(const Atlas& atlas, LawMaterial material);
/// Largest ratio of two partners' E*, either way, that composed laws are made for: the stiffer one is rigid
/// to 0.01 % (docs/evidence/pairs.md).
inline constexpr double most_unlike = 1e4;
/// A material with all its stresses brought to at most that ratio: a search tries what no solid has.
LawMaterial within_reach(LawMaterial material, const LawMaterial& partner);

}  // namespace granulaw
