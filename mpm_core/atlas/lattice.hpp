#pragma once

#include <vector>

#include "law/law_shape.hpp"
#include "atlas/material_ratios.hpp"

namespace granulaw {

/// Materials with laws of their own, and the weights of these in the law of any other. A reference set at one
/// Poisson's ratio holds every stiffness with its hardenings; a coarser block holds the change with Poisson's
/// ratio, which is little and smooth.
///
/// Along ln(E*/Y), ln(1 + 2 (H/E)(E*/Y)), in which a law changes evenly from perfectly plastic to dominated by
/// hardening, and Poisson's ratio: cubic through the four nearest.
struct Lattice
{
  double main_poisson_ratio = 0.3;
  std::vector<double> stiffnesses;  ///< E*/Y
  std::vector<double> hardenings;   ///< H/E
  std::vector<double> block_stiffnesses, block_hardenings;
  std::vector<double> block_poisson_ratios;  ///< besides the main one
  /// Product of H/E and E*/Y below which the reference set has no node but H = 0.
  double weakest_hardening = 0;

  std::vector<double> hardenings_at(double stiffness) const;
  std::vector<double> poisson_ratios() const;  ///< all, ascending
  /// The reference set by ascending stiffness, then hardening; then the block by stiffness, hardening and Poisson's
  /// ratio.
  std::vector<MaterialRatios> materials() const;
  std::size_t reference_materials() const;

  /// Weight of each of materials() in the law of m. The block's stiffnesses count up to `block_end`, beyond which
  /// the change with Poisson's ratio keeps its value. `place(m)`: material whose place in the reference set m
  /// takes, m itself or another.
  using Place = MaterialRatios (*)(const Lattice&, const MaterialRatios&);
  static MaterialRatios own_place(const Lattice&, const MaterialRatios& m) { return m; }
  std::vector<double> weights(const MaterialRatios& m, double block_end, Place place = own_place) const;
};

/// A material of a lattice and its law, or a difference between two of its laws.
struct LatticeNode
{
  MaterialRatios material;
  LawShape shape;
};

/// Throws Error, naming `what`, where the nodes are not of the lattice's materials.
void check_nodes(const Lattice& lattice, const std::vector<LatticeNode>& nodes, const char* what);

}  // namespace granulaw
