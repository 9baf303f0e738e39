#include "solver/contact/surface.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "solver/contact/edge.hpp"

namespace granulaw {

namespace {

/// Place and velocity of a surface point.
struct Motion
{
  double r, z, vr, vz;
};

Motion motion(const Body& b, int m)
{
  const Markers& s = b.reference().surface;
  const Vector3 u = carried(b.u_i, s, m), v = carried(b.v_i, s, m);
  return {s.place[m][0] + u[0], s.place[m][2] + u[2], v[0], v[2]};
}

}  // namespace

Surface::Surface(std::span<const Body> bodies)
{
  const std::size_t count = static_cast<std::size_t>(bodies.front().reference().surface.count);
  impulse_.assign(4 * count, 0.0), gap_.assign(count, 0.0), radius_.assign(count, 0.0);
  if (bodies.size() < 2) return;
  const std::size_t far_corners = 2 * static_cast<std::size_t>(bodies[1].reference().surface.corners);
  far_offset_.resize(count * far_corners), far_weight_.resize(count * far_corners);
}

/// The two points of the other surface about the place across the marker.
void Surface::set_far(const Body& lower, const Across& other, ContactRow& row)
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
  int made = 0, segment = 0;  // of the lower surface, found by walking outwards
  Motion low0{}, low1{};
  if (lower) low0 = motion(*lower, 0), low1 = motion(*lower, 1);
  for (int m = 0; m < surface.count; ++m) {
    double* impulse = impulse_.data() + 4 * static_cast<std::size_t>(m);
    const Motion x = motion(upper, m);
    Across other{x.z, x.vz};
    gap_[m] = x.z, radius_[m] = x.r;
    if (lower) {
      while (x.r > low1.r && segment + 2 < lower->reference().surface.count) {
        ++segment;
        low0 = low1;
        low1 = motion(*lower, segment + 1);
      }
      if (low1.r <= low0.r || x.r > low1.r) {
        std::fill_n(impulse, 4, 0.0);
        continue;  // beyond the other surface
      }
      const double slope = (low1.z - low0.z) / (low1.r - low0.r);
      const double t = std::max(0.0, (x.r - low0.r) / (low1.r - low0.r));
      other.slope = slope, other.t = t, other.segment = segment;
      other.gap += (1 - t) * low0.z + t * low1.z;
      other.approach += (1 - t) * low0.vz + t * low1.vz + slope * (x.vr - (1 - t) * low0.vr - t * low1.vr);
      gap_[m] = other.gap;
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
