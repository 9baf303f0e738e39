#include "solver/shape/body_frame.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "solver/shape/revolved_solid.hpp"
#include "solver/shape/sphere_solid.hpp"

namespace granulaw {

namespace {

/// Distance of the point from the centre of the ball, or from the middle of the ring's circular section.
double distance_from(const Particle& p, const Particle::Inclusion& i, const Vector3& x)
{
  if (p.solid) return (x - Vector3(i.x, i.y, i.z)).norm();
  return std::hypot(std::hypot(x.x(), x.y()) - i.r, x.z() + 0.5 * p.height() - i.z);
}

}  // namespace

std::shared_ptr<const Solid> solid_of(const Particle& p)
{
  if (p.solid) return p.solid;
  if (p.is_sphere()) return std::make_shared<SphereSolid>(p.radius);
  return std::make_shared<RevolvedSolid>(p.profile);
}

int material_at(const Particle& p, const Vector3& x, double depth)
{
  if (!(depth >= 0)) return -1;
  for (auto i = p.inclusions.rbegin(); i != p.inclusions.rend(); ++i)
    if (distance_from(p, *i, x) <= i->radius) return i->material;
  return p.material_at_depth(depth);
}

bool is_deeper_than(const Solid& solid, double depth)
{
  // Cubes of half width h with depth d at their centre: no depth in one exceeds d + sqrt(3) h. The most
  // promising is split until one is found or nothing is promised; the size limit ends the search along a
  // plate's middle.
  struct Cube
  {
    Vector3 centre;
    double h, most;
    bool operator<(const Cube& other) const { return most < other.most; }
  };
  std::priority_queue<Cube> cubes;
  Vector3 low, high;
  solid.bounds(low, high);
  const double whole = 0.5 * (high - low).maxCoeff();
  cubes.push({0.5 * (low + high), whole, whole});
  while (!cubes.empty()) {
    const Cube c = cubes.top();
    cubes.pop();
    for (int octant = 0; octant < 8; ++octant) {
      const double h = 0.5 * c.h;
      const Vector3 side(octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1);
      const Vector3 centre = c.centre + h * side;
      const double d = solid.depth(centre), most = d + std::numbers::sqrt3 * h;
      if (d > depth) return true;
      if (most > 1.01 * depth && h > 2e-3 * whole) cubes.push({centre, h, most});
    }
  }
  return false;
}

Eigen::Matrix3d rotation_to_plane(const Vector3& direction, double turn)
{
  int nearest = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(direction[d]) > std::abs(direction[nearest]) + 1e-12) nearest = d;
  const bool along = std::abs(direction[nearest]) > 1 - 1e-12;
  const Vector3 z = -direction, lean = Vector3::Unit(along ? (nearest + 1) % 3 : nearest);
  const Vector3 x = (lean - lean.dot(z) * z).normalized();
  Eigen::Matrix3d rotation;
  rotation.row(0) = x, rotation.row(1) = z.cross(x), rotation.row(2) = z;
  return Eigen::AngleAxisd(turn, Vector3::UnitZ()).toRotationMatrix() * rotation;
}

double turn_along(const Vector3& direction, const Vector3& tangent)
{
  const Vector3 x = rotation_to_plane(direction) * tangent;
  return -std::atan2(x.y(), x.x());
}

}  // namespace granulaw
