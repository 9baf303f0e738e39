#include "solver/shape/particle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "solver/shape/shapes.hpp"

namespace granulaw {

double Particle::height() const
{
  return is_sphere() ? 2 * radius : profile.height();
}

double Particle::height_of_largest_radius() const
{
  return is_sphere() ? radius : profile.widest().z;
}

double Particle::pole_curvature_radius() const
{
  return is_sphere() ? radius : profile.pole_curvature_radius(0.1 * radius);
}

double Particle::depth(double r, double z) const
{
  if (is_sphere()) return radius - std::hypot(r, z - radius);
  return profile.depth(std::abs(r), z);
}

int Particle::material_of(double below, const Vector3& x) const
{
  if (!(below >= 0)) return -1;
  // A ball is a ring of radius 0.
  for (auto i = inclusions.rbegin(); i != inclusions.rend(); ++i)
    if (std::hypot(std::hypot(x.x() - i->x, x.y() - i->y) - i->r, x.z() - i->z) <= i->radius)
      return i->material;
  double inner = 0;
  for (const Layer& layer : layers) {
    inner += layer.thickness;
    if (below < inner) return layer.material;
  }
  return 0;
}

double Particle::largest_depth(double enough) const
{
  if (is_sphere()) return radius;
  // Cubes of half width h with depth d at their centre, or squares of the (r, z) plane: no depth in one
  // exceeds d + sqrt(dimensions) h. The most promising is split until it promises nothing more. Along a
  // plate's middle every cube does: there their size is limited.
  struct Cube
  {
    Vector3 centre;
    double h, most;
    bool operator<(const Cube& other) const { return most < other.most; }
  };
  const int dimensions = shape ? 3 : 2;
  const double tolerance = shape ? 1e-2 : 1e-3;
  Vector3 low(0, 0, 0), high(radius, 0, shape ? 0 : height());
  if (shape) shape->bounds(low, high);
  const double whole = 0.5 * (high - low).maxCoeff(), least_h = shape ? 2e-3 * whole : 0;
  double best = 0;
  std::priority_queue<Cube> cubes;
  const auto add = [&](const Vector3& x, double h) {
    const double d = shape ? shape->depth(x) : depth(x.x(), x.z()), most = d + std::sqrt(dimensions) * h;
    best = std::max(best, d);
    if (most > best && h > least_h) cubes.push({x, h, most});
  };
  add(0.5 * (low + high), whole);
  while (!cubes.empty() && cubes.top().most > best * (1 + tolerance) && best <= enough) {
    const Cube c = cubes.top();
    cubes.pop();
    const auto side = [&](bool positive) { return positive ? 0.5 * c.h : -0.5 * c.h; };
    for (int corner = 0; corner < 1 << dimensions; ++corner)
      add(c.centre + Vector3(side(corner & 1), shape ? side(corner & 4) : 0, side(corner & 2)), 0.5 * c.h);
  }
  return best;
}

double Particle::volume() const
{
  if (shape) return shape->mass_properties().volume;
  return is_sphere() ? 4.0 / 3.0 * std::numbers::pi * radius * radius * radius : profile.volume();
}

double Particle::surface_z(double r) const
{
  r = std::abs(r);
  if (!is_sphere()) return profile.surface_z(r);
  if (r >= radius) return radius;
  return r * r / (radius + std::sqrt(radius * radius - r * r));  // no difference of near numbers
}

Particle Particle::sphere(double radius, const Material& material)
{
  Particle p;
  p.radius = radius;
  p.materials = {material};
  return p;
}

SharedShape shape_of(const Particle& p)
{
  if (p.shape) return p.shape;
  return p.is_sphere() ? sphere_shape(p.radius) : revolved_shape(p.profile);
}

}  // namespace granulaw
