#pragma once

#include <map>
#include <vector>

#include "calibrate/material_lattice.hpp"
#include "calibrate/measurement.hpp"
#include "calibrate/sphere_laws.hpp"
#include "characterise/pair_body.hpp"

namespace granulaw {

/// Drops on a thick wall that gives way: one of sphere and wall is of a known material, the other is the one
/// that a fit varies. The model is what e is over that of a sphere of the varied material, with the density
/// of the one that drops, on the rigid wall. It comes of composed laws (docs/evidence/pairs.md), at 30 ms a
/// material. So it is computed at the materials of a lattice: it varies so little between two that e is
/// within 0.001.
class WallModel
{
 public:
  /// Drops with a `wall` or a `ball`. Throws Error if the atlas does not hold that material. `atlas` and
  /// `drops` outlive this. What is not in `varied` is always the same.
  WallModel(const Atlas& atlas, const Measurement& drops, std::vector<Parameter> varied);

  /// e on this wall less e on the rigid one, by the drops' data.
  std::vector<double> change(const LawMaterial& varied) const;
  /// Sd of what composed laws are off in e.
  double error(const LawMaterial& varied) const;

 private:
  const std::vector<double>& at(const MaterialLattice::Corner& corner) const;
  std::vector<double> compute(const LawMaterial& varied) const;

  const Atlas* atlas_;
  const Measurement* drops_;
  MaterialLattice lattice_;
  PairBody known_;
  mutable std::map<MaterialLattice::Key, std::vector<double>> changes_;
};

}  // namespace granulaw
