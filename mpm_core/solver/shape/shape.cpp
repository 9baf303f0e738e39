#include "solver/shape/shape.hpp"

namespace granulaw {

void Shape::bounds(Vector3& low, Vector3& high) const
{
  for (int k = 0; k < 3; ++k) {
    high[k] = support(Vector3::Unit(k), nullptr);
    low[k] = -support(-Vector3::Unit(k), nullptr);
  }
}

MassProperties mass_of_moments(double volume, const Vector3& first, const Eigen::Matrix3d& second)
{
  const Vector3 centre = first / volume;
  const Eigen::Matrix3d about_centre = second - volume * centre * centre.transpose();
  return {volume, centre, about_centre.trace() * Eigen::Matrix3d::Identity() - about_centre};
}

}  // namespace granulaw
