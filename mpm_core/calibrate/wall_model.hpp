#pragma once

#include <map>
#include <vector>

#include "calibrate/material_lattice.hpp"
#include "calibrate/measurement.hpp"
#include "calibrate/sphere_laws.hpp"
#include "characterise/pair_body.hpp"

namespace granulaw {

/// What a thick wall of a known material changes of e, against the rigid wall: by composed laws
/// (docs/evidence/pairs.md), at 30 ms a material. So it is computed at the materials of a lattice: what the
/// wall changes varies so little between two that e is within 0.001.
class WallModel
{
 public:
  /// Throws Error if the atlas does not know the wall's material. `atlas` and `drops` outlive this. What is
  /// not in `varied` is always the same.
  WallModel(const Atlas& atlas, const Measurement& drops, std::vector<Parameter> varied);

  /// e on this wall less e on the rigid one, by the drops' data.
  std::vector<double> change(const LawMaterial& sphere) const;
  /// Sd of what composed laws are off in e.
  double error(const LawMaterial& sphere) const;

 private:
  const std::vector<double>& at(const MaterialLattice::Corner& corner) const;
  std::vector<double> compute(const LawMaterial& sphere) const;

  const Atlas* atlas_;
  const Measurement* drops_;
  MaterialLattice lattice_;
  PairBody wall_;
  mutable std::map<MaterialLattice::Key, std::vector<double>> known_;
};

}  // namespace granulaw
