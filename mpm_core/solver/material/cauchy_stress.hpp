#pragma once

#include <cmath>

namespace granulaw {

/// Cauchy stress of a point, tension positive. Of an axisymmetric body x is r, and y the hoop direction.
struct CauchyStress
{
  double xx, yy, zz, xy, xz, yz;

  double pressure() const { return -(xx + yy + zz) / 3; }  ///< compression positive
  double von_mises() const
  {
    const double mean = (xx + yy + zz) / 3, x = xx - mean, y = yy - mean, z = zz - mean;
    return std::sqrt(1.5 * (x * x + y * y + z * z + 2 * (xy * xy + xz * xz + yz * yz)));
  }
};

}  // namespace granulaw
