#pragma once

#include <vector>

#include "law/law_material.hpp"

namespace granulaw {

/// A homogeneous, rate-independent, linearly hardening material without dimensions.
struct MaterialRatios
{
  double stiffness = 0;      ///< E*/Y
  double poisson_ratio = 0;  ///< nu
  double hardening = 0;      ///< H/E

  static MaterialRatios of(const LawMaterial& material);
  bool operator==(const MaterialRatios&) const = default;
};

/// Overlap/R at which a sphere of it begins to yield.
double onset_of(const MaterialRatios& material);

/// ln(1 + 2 (H/E)(E*/Y)): the coordinate along hardening.
double hardening_coordinate(double stiffness, double hardening);
/// The same of several H/E.
std::vector<double> hardening_coordinates(double stiffness, const std::vector<double>& hardenings);

}  // namespace granulaw
