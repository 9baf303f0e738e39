#pragma once

#include <array>
#include <vector>

#include "atlas/lattice.hpp"

namespace granulaw {

/// Materials of the atlas's midplane presses.
struct MidplaneGrid : Lattice
{
  MidplaneGrid()
      : Lattice{0.3,        {20, 28, 40, 60, 100, 200, 600, 5000}, {0, 0.005, 0.02, 0.08, 0.3}, {20, 60, 200, 600},
                {0, 0.02, 0.3}, {0, 0.49}}
  {
  }
};

/// A fresh midplane press of a random material, and the error of the atlas's law.
struct MidplaneCheck
{
  MaterialRatios material;
  double depth = 0;              ///< overlap/R
  double error_force = 0;        ///< rms over the loading beyond a third of the depth, relative
  double error_restitution = 0;  ///< of sqrt(W_u/W_L), absolute, signed
  double error_recovery = 0;     ///< of the recovery, largest overlap less residual, relative, signed
};

/// Change of a contact where the equator plane is held in place of the whole sphere: a particle between two
/// platens.
///
/// While the contact is small the change is elastic: the half between contact and equator is a series
/// compliance (LawShape::as_skin_of, with the midplane press's own elastic correction). Beyond, where the two
/// plastic zones meet, each material of the lattice has the remaining difference as a function of
/// ln(overlap/R).
class MidplaneShapes
{
 public:
  using Node = LatticeNode;  ///< the press's shape less the free sphere's with a series compliance

  MidplaneShapes() = default;
  /// `nodes` of grid.materials(); `elastic` of grid.poisson_ratios(). Throws Error if they are not.
  MidplaneShapes(MidplaneGrid grid, std::vector<ElasticCorrection> elastic, std::vector<Node> nodes,
                 std::vector<MidplaneCheck> checks = {});

  /// Overlap/R up to which the shapes are laws for any material; beyond, soft ones unload like no sphere.
  static constexpr double depth = 0.33;

  bool empty() const { return nodes_.empty(); }
  const MidplaneGrid& grid() const { return grid_; }
  const std::vector<ElasticCorrection>& elastic_corrections() const { return elastic_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<MidplaneCheck>& checks() const { return checks_; }
  MidplaneShapes with_checks(std::vector<MidplaneCheck> checks) const;

  ElasticCorrection elastic(double poisson_ratio) const;
  /// The midplane shape of a material whose free sphere has the shape `free`; no velocity effects.
  LawShape shape(const MaterialRatios& m, const LawShape& free) const;

  /// 95 % of midplane presses lie within, by the checks: of F, of e, of the recovery (largest overlap less
  /// residual, relative).
  double claimed_force() const { return claimed_force_; }
  double claimed_restitution() const { return claimed_restitution_; }
  double claimed_recovery() const { return claimed_recovery_; }

 private:
  MidplaneGrid grid_;
  std::vector<ElasticCorrection> elastic_;
  std::vector<Node> nodes_;
  /// The midplane changes force, loading radius and losses; the dent unloads with the free sphere's radii.
  static constexpr std::size_t changed = LawShape::first_radius;
  std::vector<std::array<Spline, changed>> changes_;  ///< of each node, by q
  std::vector<MidplaneCheck> checks_;
  double claimed_force_ = 0, claimed_restitution_ = 0, claimed_recovery_ = 0;
};

}  // namespace granulaw
