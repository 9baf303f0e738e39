#pragma once

#include <string>
#include <vector>

#include "atlas/lattice.hpp"
#include "atlas/midplane.hpp"

namespace granulaw {

/// Materials of the atlas's free spheres. Hardening too weak to be seen at a stiffness is left out there.
struct AtlasGrid : Lattice
{
  AtlasGrid()
      : Lattice{0.3,
                {20, 23, 27, 35, 47, 60, 80, 110, 150, 200, 283, 400, 600, 900, 2000, 5000},
                {0, 3e-4, 1.2e-3, 0.005, 0.02, 0.077, 0.15, 0.3},
                {20, 23, 27, 35, 47, 60, 80, 110, 150, 200, 400, 600, 900, 5000},
                {0, 0.005, 0.02, 0.1, 0.3},
                {0, 0.15, 0.42, 0.49},
                0.1}  // it adds less than a tenth of Y at a strain of one
  {
  }
  /// E*/Y up to which the block's unloading and velocity effects count; stiffer ones have the loading alone. Their
  /// e has an error of 0.003 (24 cells, two grids), as large as the change by another Poisson's ratio there.
  static constexpr double block_unloading_end = 900;
};

/// The law of a sphere that never yields.
struct ElasticSphere
{
  static constexpr double depth = 0.2;  ///< overlap/R where it ends
  double poisson_ratio = 0;
  ElasticFit fit;
  double solver_error = 0;  ///< of the press to that depth, by two resolutions
};

/// A fresh impact of a material between the atlas's own, and the error of the atlas's law.
struct AtlasCheck
{
  MaterialRatios material;
  double speed = 0;              ///< sqrt(I)
  double error_force = 0;        ///< relative, of F_max, signed
  double error_restitution = 0;  ///< absolute, of e, signed
  double solver_estimate = 0;    ///< the impact's own, by two resolutions; relative
};

/// Error bounds of the atlas's laws about one stiffness E*/Y: 95 % lie within.
struct NearBounds
{
  double force = 0, restitution = 0;  ///< against fresh impacts: relative; absolute
  double solver = 0;                  ///< of these impacts, of F and e: relative
};

/// Dimensionless laws of all homogeneous materials within its range: shapes of few, interpolated (Lattice). The
/// change of unloading and velocity effects with Poisson's ratio keeps its value beyond
/// AtlasGrid::block_unloading_end.
class Atlas
{
 public:
  using Node = LatticeNode;

  /// Nodes of grid.materials(), and elastic spheres of all its Poisson's ratios,
  /// ascending. Throws Error if they are not.
  Atlas(AtlasGrid grid, std::vector<Node> nodes, std::vector<ElasticSphere> elastic,
        std::vector<AtlasCheck> checks = {}, MidplaneShapes midplane = {});

  static constexpr double depth = 0.5;  ///< overlap/R where every law ends

  const AtlasGrid& grid() const { return grid_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<AtlasCheck>& checks() const { return checks_; }

  /// Why this material's law is not in the atlas, as the end of a sentence; empty: it is.
  std::string why_not(const MaterialRatios& m) const;
  const std::vector<ElasticSphere>& elastic_spheres() const { return elastic_; }
  /// A sphere that never yields; of the errors the largest of all Poisson's ratios.
  ElasticSphere elastic(double poisson_ratio) const;
  /// Its shape. Needs why_not() empty.
  LawShape shape(const MaterialRatios& m) const;
  /// Spheres whose equator plane is driven; empty: the file has none.
  const MidplaneShapes& midplane() const { return midplane_; }
  /// The shape of one; no velocity effects. Needs why_not() empty and midplane() not.
  LawShape midplane_shape(const MaterialRatios& m) const { return midplane_.shape(m, shape(m)); }

  /// Error bounds of its laws: 95 % of all impacts lie within, by its checks with a confidence of 95 %; none of the
  /// checks exceeds twice the bound.
  double claimed_force() const { return claimed_force_; }
  double claimed_restitution() const { return claimed_restitution_; }
  /// The errors grow with E*/Y: bounds by the 93 checks nearest in ln(E*/Y). These are the fewest of which the second
  /// largest error bounds 95 % with a confidence of 95 % (confident_bound.hpp). The solver's error is that of 95 % of their
  /// estimates, times the largest ratio of true error to estimate in 32 (docs/evidence/solver-accuracy.md).
  NearBounds bounds_near(double stiffness) const;

 private:
  AtlasGrid grid_;
  std::vector<Node> nodes_;
  std::vector<ElasticSphere> elastic_;
  std::vector<AtlasCheck> checks_;
  MidplaneShapes midplane_;
  double claimed_force_ = 0, claimed_restitution_ = 0;
};

}  // namespace granulaw
