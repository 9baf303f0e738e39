#include "solver/contact/surface.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "solver/contact/edge.hpp"

namespace granulaw {

SurfaceMotion surface_motion(const Body& b, int m)
{
  const Markers& s = b.reference().surface;
  const Vector3 u = carried(b.u_i, s, m), v = carried(b.v_i, s, m);
  return {s.place[m][0] + u[0], s.place[m][2] + u[2], v[0], v[2]};
}

Opposite::Opposite(std::span<const Body> bodies) : body_(bodies.size() > 1 ? &bodies[1] : nullptr)
{
  if (body_) inner_ = surface_motion(*body_, 0), outer_ = surface_motion(*body_, 1);
}

bool Opposite::find(const SurfaceMotion& x, Place& place)
{
  place = {x.z, x.vz};
  if (!body_) return true;
  while (x.r > outer_.r && segment_ + 2 < body_->reference().surface.count) {
    ++segment_;
    inner_ = outer_;
    outer_ = surface_motion(*body_, segment_ + 1);
  }
  if (outer_.r <= inner_.r || x.r > outer_.r) return false;
  const double slope = (outer_.z - inner_.z) / (outer_.r - inner_.r);
  const double t = std::max(0.0, (x.r - inner_.r) / (outer_.r - inner_.r));
  place.slope = slope, place.t = t, place.segment = segment_;
  place.gap += (1 - t) * inner_.z + t * outer_.z;
  place.approach += (1 - t) * inner_.vz + t * outer_.vz + slope * (x.vr - (1 - t) * inner_.vr - t * outer_.vr);
  return true;
}

Surface::Surface(std::span<const Body> bodies)
{
  const std::size_t count = static_cast<std::size_t>(bodies.front().reference().surface.count);
  impulse_.assign(4 * count, 0.0), gap_.assign(count, 0.0), radius_.assign(count, 0.0);
  if (bodies.size() < 2) return;
  const std::size_t far_corners = 2 * static_cast<std::size_t>(bodies[1].reference().surface.corners);
  far_offset_.resize(count * far_corners), far_weight_.resize(count * far_corners);
}

/// The two points of the other surface about the place across the marker.
void Surface::set_far(const Body& lower, const Opposite::Place& other, ContactRow& row)
{
  const Markers& surface = lower.reference().surface;
  const int corners = surface.corners;
  const std::size_t at = 2 * static_cast<std::size_t>(corners) * static_cast<std::size_t>(row.marker);
  int* offset = far_offset_.data() + at;
  double* weight = far_weight_.data() + at;
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < corners; ++k) {
      *offset++ = surface.node(other.segment + end, k);
      *weight++ = (end ? other.t : 1 - other.t) * surface.weights(other.segment + end)[k];
    }
  row.far = {1, 2 * corners, 0, far_offset_.data() + at, far_weight_.data() + at};
}

int Surface::add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt, double recovery,
                      ContactRow* rows)
{
  const Body& upper = bodies.front();
  const Body* lower = bodies.size() > 1 ? &bodies[1] : nullptr;
  const Markers& surface = upper.reference().surface;
  const RowKernels& kernels = row_kernels(upper);
  Opposite opposite(bodies);
  int made = 0;
  for (int m = 0; m < surface.count; ++m) {
    double* impulse = impulse_.data() + 4 * static_cast<std::size_t>(m);
    const SurfaceMotion x = surface_motion(upper, m);
    Opposite::Place other;
    const bool across = opposite.find(x, other);
    gap_[m] = other.gap, radius_[m] = x.r;
    if (!across) {
      std::fill_n(impulse, 4, 0.0);
      continue;
    }
    const double slope = other.slope, kept = impulse[2];
    // a row for each point that would pass, or might once its neighbours are pushed back
    if (other.gap + dt * other.approach > 0 && kept == 0 && other.gap > 4 * dt * std::abs(other.approach))
      continue;
    ContactRow& row = rows[made];
    row = {};
    const double square = 1 + slope * slope;
    row.normal[0] = slope, row.normal[2] = 1;
    row.along[0] = slope / square, row.along[2] = 1 / square;
    row.of_other[0] = -1, row.of_other[1] = -1, row.of_other[2] = 1;  // it is kept mirrored
    row.marker = m;
    row.near = {0, surface.corners, surface.lowest[m], surface.offsets(m), surface.weights(m)};
    if (lower) set_far(*lower, other, row);
    impulse[0] = kept * slope;
    row.impulse = impulse;
    row.needed = -(other.gap < 0 ? recovery : 1) * other.gap / dt;
    kernels.weigh(nodes, kick, row);
    made += row.response > 0 ? 1 : 0;
  }
  return made;
}

double Surface::finish(std::span<const Body>, std::span<const ContactRow> rows, double)
{
  double total = 0;
  outermost_ = -1;
  for (const ContactRow& row : rows)
    if (row.impulse[2] > 0) total += row.impulse[2], outermost_ = row.marker;
  return total;
}

double Surface::edge_radius(std::span<const Body>) const
{
  if (outermost_ < 0) return 0;
  const std::size_t at = static_cast<std::size_t>(outermost_);
  const double closed = radius_[at];
  if (at + 2 >= radius_.size()) return closed;
  return edge_between(closed, {radius_[at + 1], gap_[at + 1]}, {radius_[at + 2], gap_[at + 2]});
}

void Surface::visit_state(StateArchive& a)
{
  a.values(impulse_), a.values(gap_), a.values(radius_);
  a.value(outermost_);
}

}  // namespace granulaw
