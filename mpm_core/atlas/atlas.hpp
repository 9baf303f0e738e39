#pragma once

#include <string>
#include <vector>

#include "atlas/law_shape.hpp"
#include "atlas/material_ratios.hpp"
#include "atlas/midplane.hpp"

namespace granulaw {

/// The materials that an atlas holds shapes of. A reference set at one Poisson's ratio, every stiffness with
/// its hardenings; and a coarser block that gives what another Poisson's ratio changes, which is little and
/// smooth.
struct AtlasGrid
{
  double main_poisson_ratio = 0.3;
  std::vector<double> stiffnesses{20, 23, 27, 35, 47, 60, 80, 110, 150, 200, 283, 400, 600, 900, 2000, 5000};
  /// H/E; what is too weak to be seen at a stiffness is left out there.
  std::vector<double> hardenings{0, 3e-4, 1.2e-3, 0.005, 0.02, 0.077, 0.15, 0.3};

  std::vector<double> block_stiffnesses{20, 23, 27, 35, 47, 60, 80, 110, 150, 200, 400, 600, 900, 5000};
  /// Up to here the block gives unloading and velocity effects; stiffer ones the loading alone. Their e is
  /// known to 0.003 (24 cells, two grids), which is what another ratio changes there.
  static constexpr double block_unloading_end = 900;
  std::vector<double> block_hardenings{0, 0.005, 0.02, 0.1, 0.3};
  std::vector<double> block_poisson_ratios{0, 0.15, 0.42, 0.49};  ///< besides the main one

  std::vector<double> hardenings_at(double stiffness) const;
  std::vector<MaterialRatios> main_plane() const;  ///< ascending stiffness, then hardening
  std::vector<MaterialRatios> block() const;       ///< ascending stiffness, hardening, Poisson's ratio
  std::vector<double> poisson_ratios() const;      ///< all, ascending
};

/// The law of a sphere that never yields.
struct ElasticSphere
{
  static constexpr double depth = 0.2;  ///< overlap/R where it ends
  double poisson_ratio = 0;
  ElasticFit fit;
  double solver_error = 0;  ///< of the press to that depth, by two resolutions
};

/// A fresh impact of a material between the atlas's own, and what the atlas said.
struct AtlasCheck
{
  MaterialRatios material;
  double speed = 0;              ///< sqrt(I)
  double error_force = 0;        ///< relative, of F_max, signed
  double error_restitution = 0;  ///< absolute, of e, signed
  double solver_estimate = 0;    ///< the impact's own, by two resolutions; relative
};

/// Dimensionless laws of all homogeneous materials within its range: shapes of few, interpolated.
///
/// Along ln(E*/Y) and along ln(1 + 2 (H/E)(E*/Y)), in which a law changes evenly from perfectly plastic to
/// dominated by hardening: cubic through the four nearest; the change with Poisson's ratio by such cubics
/// along the block's ratios, stiffnesses and hardenings. Beyond AtlasGrid::block_unloading_end the change of
/// unloading and velocity effects keeps its value.
class Atlas
{
 public:
  struct Node
  {
    MaterialRatios material;
    LawShape shape;
  };

  /// Nodes of grid.main_plane(), then grid.block(), and elastic spheres of all its Poisson's ratios,
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

  /// Error bounds of the atlas's laws: 95 % of all impacts lie within, as its checks give with a
  /// confidence of 95 %; none of the checks exceeds twice the claim.
  double claimed_force() const { return claimed_force_; }
  double claimed_restitution() const { return claimed_restitution_; }
  /// The solver's own error, by the checks' estimates, of force and e: 95 % lie within.
  double solver_error() const { return solver_error_; }

 private:
  LawShape main_shape(double stiffness, double hardening) const;
  /// Law shape of a material with another Poisson's ratio, from the reference set (nu = 0.3). Inertia acts
  /// through the sphere's ringing: its period goes with the shear wave's, E*/rho (1 - nu)/2, and the
  /// contact's time with rho/Y. So the effect of inertia is that at the stiffness E*/Y (1 - nu) in the
  /// reference set.
  LawShape partner(const MaterialRatios& m) const;

  AtlasGrid grid_;
  std::vector<Node> nodes_;
  std::vector<ElasticSphere> elastic_;
  std::vector<AtlasCheck> checks_;
  MidplaneShapes midplane_;
  double claimed_force_ = 0, claimed_restitution_ = 0, solver_error_ = 0;
};

}  // namespace granulaw
