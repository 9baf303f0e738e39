#pragma once

#include <cmath>

#include "atlas/material_ratios.hpp"

namespace granulaw {

/// Numbers of a body that its law needs beside its shape; lengths over the radius of curvature at the contact
/// pole, stresses over E* and densities over that of the material there.
struct BodyNumbers
{
  double onset = 0;                   ///< overlap at which it begins to yield
  double yield = 0;                   ///< smallest yield stress in it
  double mass = 4.0 / 3.0 * M_PI;     ///< 4/3 pi: a sphere
  double radius = 1;                  ///< m; of a rate-dependent body, whose law holds for this one
  bool rate_dependent = false;
};

/// Numbers of a homogeneous, rate-independent sphere.
BodyNumbers body_numbers(const MaterialRatios& ratios);

}  // namespace granulaw
