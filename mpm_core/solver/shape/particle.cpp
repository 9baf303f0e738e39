#include "solver/shape/particle.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <queue>

#include "solver/shape/solid.hpp"

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

int Particle::material_at(double r, double z) const
{
  r = std::abs(r);
  const double below = depth(r, z);
  if (!(below >= 0)) return -1;
  for (auto i = inclusions.rbegin(); i != inclusions.rend(); ++i) {
    const double dr = r - i->r, dz = z - i->z;
    if (dr * dr + dz * dz <= i->radius * i->radius) return i->material;
  }
  return material_at_depth(below);
}

int Particle::material_at_depth(double below) const
{
  if (!(below >= 0)) return -1;
  double inner = 0;
  for (const Layer& layer : layers) {
    inner += layer.thickness;
    if (below < inner) return layer.material;
  }
  return 0;
}

double Particle::largest_depth() const
{
  if (is_sphere()) return radius;
  // Squares of half width h with depth d at their centre: no depth in one exceeds d + sqrt(2) h. The most
  // promising is split until it promises nothing more.
  struct Square
  {
    double r, z, h, d;
    double most() const { return d + std::numbers::sqrt2 * h; }
    bool operator<(const Square& other) const { return most() < other.most(); }
  };
  double best = 0;
  std::priority_queue<Square> squares;
  const auto push = [&](double r, double z, double h) {
    const Square square{r, z, h, depth(r, z)};
    best = std::max(best, square.d);
    if (square.most() > best) squares.push(square);
  };
  const double h = std::min(radius, height()) / 2;
  for (double r = h; r - h < radius; r += 2 * h)
    for (double z = h; z - h < height(); z += 2 * h) push(r, z, h);
  while (!squares.empty() && squares.top().most() > best * (1 + 1e-3)) {
    const Square s = squares.top();
    squares.pop();
    for (const double r : {s.r - s.h / 2, s.r + s.h / 2})
      for (const double z : {s.z - s.h / 2, s.z + s.h / 2}) push(r, z, s.h / 2);
  }
  return best;
}

double Particle::volume() const
{
  if (solid) return solid->mass_properties().volume;
  return is_sphere() ? 4.0 / 3.0 * std::numbers::pi * radius * radius * radius : profile.volume();
}

double Particle::surface_z(double r) const
{
  r = std::abs(r);
  if (!is_sphere()) return profile.surface_z(r);
  if (r >= radius) return radius;
  return r * r / (radius + std::sqrt(radius * radius - r * r));  // no difference of near numbers
}

Particle Particle::scaled(double factor) const
{
  assert(!solid);
  Particle p = *this;
  p.radius *= factor;
  p.profile = p.profile.scaled(factor);
  for (Layer& layer : p.layers) layer.thickness *= factor;
  for (Inclusion& i : p.inclusions) i.r *= factor, i.z *= factor, i.radius *= factor;
  return p;
}

Particle Particle::from(const Sphere& sphere)
{
  Particle p;
  p.radius = sphere.radius;
  p.materials = {sphere.material};
  return p;
}

}  // namespace granulaw
