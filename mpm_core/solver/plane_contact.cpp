#include "solver/plane_contact.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

double PlaneContact::correct(Body& body, double dt)
{
  double impulse = 0;
  outermost_ = -1;
  const int count = static_cast<int>(body.surface.size());
  for (int k = 0; k < count; ++k) {
    const int i = body.surface[k];
    const double gap = body.z_i[i] + body.uz_i[i];
    const double least = -gap / dt;  // velocity that just reaches the plane
    if (body.vz_i[i] < least) {
      impulse += body.mass_i[i] * (least - body.vz_i[i]);
      body.vz_i[i] = least;
      outermost_ = k;
    }
  }
  return impulse;
}

double PlaneContact::edge_radius(const Body& body) const
{
  if (outermost_ < 0) return 0;
  const auto radius = [&](int k) { return body.r_i[body.surface[k]] + body.ur_i[body.surface[k]]; };
  const auto gap = [&](int k) { return body.z_i[body.surface[k]] + body.uz_i[body.surface[k]]; };
  const int last = static_cast<int>(body.surface.size()) - 1;
  const double closed = radius(outermost_);
  if (outermost_ + 2 > last) return closed;
  // gap = c (r - a)^1.5 through the first two open nodes (the Hertz form at the edge)
  const double r1 = radius(outermost_ + 1), r2 = radius(outermost_ + 2);
  const double g1 = std::max(0.0, gap(outermost_ + 1)), g2 = gap(outermost_ + 2);
  if (!(g2 > g1)) return closed;
  const double q = std::cbrt((g1 / g2) * (g1 / g2));
  return std::clamp((r1 - q * r2) / (1 - q), closed, r1);
}

}  // namespace granulaw
