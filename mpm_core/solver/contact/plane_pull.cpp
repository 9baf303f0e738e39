#include "solver/contact/plane_pull.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace granulaw {

PlanePull::PlanePull(Planes& planes, const Body& body, const Attraction& attraction, std::vector<Vector3> patches)
    : planes_(&planes), attraction_(attraction), patches_(std::move(patches))
{
  pulled_.reserve(planes.planes().size() * patches_.size());  // all that there can be: no later step allocates
  planes.widen(body, attraction.range);
}

/// By Nanson's formula: det F F^-T takes the vector of an area to that of the deformed one.
double PlanePull::area_now(const Body& body, int marker, const Vector3& normal) const
{
  const SplineCells& cells = body.reference().cells;
  const std::array<double, 3>& place = body.reference().surface.place[marker];
  const std::array<int, 3> stride = cells.strides();
  SplineAxis::Values s[3];
  for (int d = 0; d < 3; ++d) s[d] = cells.axes[d].at(place[d]);
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (int k = 0; k < cell_nodes; ++k) {
    const int x = k / 9, y = k / 3 % 3, z = k % 3;
    const int node = s[0].first + x + (s[1].first + y) * stride[1] + (s[2].first + z) * stride[2];
    F += at(body.u_i, node) * Vector3(s[0].dn[x] * s[1].n[y] * s[2].n[z], s[0].n[x] * s[1].dn[y] * s[2].n[z],
                                      s[0].n[x] * s[1].n[y] * s[2].dn[z]).transpose();
  }
  Eigen::Matrix3d cofactors;
  for (int d = 0; d < 3; ++d) cofactors.col(d) = F.col((d + 1) % 3).cross(F.col((d + 2) % 3));
  return std::max(0.0, -normal.dot(cofactors * patches_[marker]));
}

double PlanePull::pull(std::span<Body> bodies, double kick)
{
  Body& body = bodies.front();
  pulled_.clear();
  for (std::size_t k = 0; k < planes_->planes().size(); ++k) {
    const Plane& plane = planes_->planes()[k];
    for (const int m : planes_->candidates(k)) {
      const Vector3 x = planes_->place(body, m);
      const double traction = attraction_.traction(plane.normal.dot(x) - plane.position);
      if (!(traction > 0)) continue;
      const double force = traction * area_now(body, m, plane.normal);
      pulled_.push_back({static_cast<int>(k), m, x, -kick * force, plane.normal.dot(velocity_before(body, m, kick))});
    }
  }
  double first = 0;
  for (const Pulled& p : pulled_) {
    const Plane& plane = planes_->planes()[p.plane];
    push_marker(body, p.marker, p.impulse * plane.normal, kick);
    planes_->tally(p.plane, p.impulse * plane.normal, p.place);
    if (p.plane == 0) first += plane.copies * p.impulse;
  }
  return first;
}

void PlanePull::account(std::span<const Body> bodies)
{
  for (const Pulled& p : pulled_) {
    const Plane& plane = planes_->planes()[p.plane];
    const double now = plane.normal.dot(velocity_before(bodies.front(), p.marker, 0));
    work_ += p.impulse * plane.velocity;
    taken_ += p.impulse * (plane.velocity - 0.5 * (p.before + now));
  }
}

}  // namespace granulaw
