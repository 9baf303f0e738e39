#include "solver/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/state_archive.hpp"

namespace granulaw {

namespace {

/// Most sweeps of a step, and the change (as a share of the largest impulse) that ends them sooner.
constexpr int most_sweeps = 30;
constexpr double small_change = 1e-7;

/// Where a surface point is now and how fast it moves.
struct Motion
{
  double r, z, vr, vz;
};

Motion motion(const Body& b, const Markers& s, int m)
{
  Motion x{s.place[m][0], s.place[m][2], 0, 0};
  const double* weight = s.weights(m);
  for (int k = 0; k < s.corners; ++k) {
    const int i = s.node(m, k);
    x.r += weight[k] * b.u_i(i, 0), x.z += weight[k] * b.u_i(i, 1);
    x.vr += weight[k] * b.v_i(i, 0), x.vz += weight[k] * b.v_i(i, 1);
  }
  return x;
}

Motion motion(const Body& b, int m)
{
  return motion(b, b.reference().surface, m);
}

/// Opposite walls must still be seen from each other in the direction they were in at the start.
void check_pores(const Body& b)
{
  const Markers& s = b.reference().pore_walls;
  for (int m = 0; m + 1 < s.count; m += 2) {
    const Motion from = motion(b, s, m), to = motion(b, s, m + 1);
    const auto &here = s.place[m], &there = s.place[m + 1];
    const double dr = there[0] - here[0], dz = there[2] - here[2];
    if (!(dr * (to.r - from.r) + dz * (to.z - from.z) > 0))
      fail("solver",
           fmt::format("the pore at r = {:.4g}, z = {:.4g} (in radii of the first particle) has closed, and "
                       "contact of its walls is not computed; stay below this depth or fill the pore",
                       0.5 * (here[0] + there[0]), 0.5 * (here[2] + there[2])));
  }
}

}  // namespace

double edge_between(double closed, EdgePoint first, EdgePoint second)
{
  first.gap = std::max(0.0, first.gap);
  if (!(second.gap > first.gap)) return closed;
  const double q = std::cbrt((first.gap / second.gap) * (first.gap / second.gap));
  return std::clamp((first.r - q * second.r) / (1 - q), closed, std::max(closed, first.r));
}

void PlaneContact::push(Body& body, int node, double kick, double least)
{
  double& v = body.v_i(node, 1);
  const double impulse = body.reference().mass_i[node] * (least - v);
  pushes_.push_back({node, impulse, v - kick * body.reference().inverse_mass_i(node, 1) * body.f_i(node, 1)});
  impulse_ += impulse;
  v = least;
}

double PlaneContact::correct(std::span<Body> bodies, double kick, double dt)
{
  Body& body = bodies.front();
  const Reference& reference = body.reference();
  const Markers& surface = reference.surface;
  const int count = surface.count;
  const double* height = &reference.place_i.values[reference.nodes];
  const double* uz = &body.u_i.values[reference.nodes];
  const double* vz = &body.v_i.values[reference.nodes];
  pushes_.clear();
  pushes_.reserve(std::size_t(reference.nodes) + count);  // all that there can be: no later step allocates
  impulse_ = 0;
  outermost_ = -1;
  for (int k = 0; k < count; ++k) {
    const int i = surface.node(k, 0);
    const double gap = height[i] + uz[i];
    const double least = -gap / dt;  // velocity that just reaches the plane
    if (vz[i] < least) {
      push(body, i, kick, least);
      outermost_ = k;
    }
  }
  for (int i = 0; i < reference.nodes; ++i) {
    const double gap = height[i] + uz[i];
    // rounding: a surface node that was just put on the plane is not pushed again
    if (gap + dt * vz[i] < -1e-15) push(body, i, kick, -gap / dt);
  }
  return impulse_;
}

void PlaneContact::account(std::span<const Body> bodies)
{
  for (const Push& p : pushes_) dissipated_ -= 0.5 * p.impulse * (p.before + bodies.front().v_i(p.node, 1));
}

double PlaneContact::edge_radius(std::span<const Body> bodies) const
{
  if (outermost_ < 0) return 0;
  const Body& body = bodies.front();
  const auto point = [&](int k) {
    const Motion m = motion(body, k);
    return EdgePoint{m.r, m.z};
  };
  const double closed = point(outermost_).r;
  if (outermost_ + 2 >= body.reference().surface.count) return closed;
  return edge_between(closed, point(outermost_ + 1), point(outermost_ + 2));
}

void Contact::visit_state(StateArchive& a)
{
  a.value(dissipated_);
}

void PlaneContact::visit_state(StateArchive& a)
{
  Contact::visit_state(a);
  a.value(outermost_);
}

void SurfaceContact::visit_state(StateArchive& a)
{
  Contact::visit_state(a);
  a.growing(impulse_), a.growing(gap_), a.growing(radius_);  // empty before the first step
  a.value(outermost_);
}

void SurfaceContact::make_rows(std::span<Body> bodies, double kick, double dt)
{
  Body& upper = bodies.front();
  Body* lower = bodies.size() > 1 ? &bodies[1] : nullptr;
  const int corners = upper.reference().surface.corners, count = upper.reference().surface.count;
  const int lower_count = lower ? lower->reference().surface.count : 0;
  impulse_.resize(count, 0.0), gap_.resize(count), radius_.resize(count);
  rows_.clear(), entries_.clear();
  // all that there can be, so that no later step allocates
  rows_.reserve(count);
  entries_.reserve(std::size_t(count) * (corners + (lower ? 2 * lower->reference().surface.corners : 0)));

  double before = 0;
  // a surface point of the given body, weighted `share`, seen along the normal (-slope, 1)
  const auto enter = [&](Body& b, int m, double share_r, double share_z) {
    const Markers& s = b.reference().surface;
    const NodeField& inverse_mass = b.reference().inverse_mass_i;
    const double* weight = s.weights(m);
    for (int k = 0; k < s.corners; ++k) {
      const int i = s.node(m, k);
      const double w = weight[k], per_mass = inverse_mass(i, 1);
      if (w == 0 || per_mass == 0) continue;
      const double wr = inverse_mass(i, 0) == 0 ? 0.0 : share_r * w, wz = share_z * w;
      const double kicked = kick * per_mass;
      entries_.push_back({&b.v_i(i, 0), &b.v_i(i, 1), wr, wz, per_mass});
      before += wr * (b.v_i(i, 0) - kicked * b.f_i(i, 0)) + wz * (b.v_i(i, 1) - kicked * b.f_i(i, 1));
    }
  };

  int segment = 0;  // of the lower surface, found by walking outwards
  Motion low0{}, low1{};
  if (lower) low0 = motion(*lower, 0), low1 = motion(*lower, 1);
  for (int m = 0; m < count; ++m) {
    const Motion x = motion(upper, m);
    double gap = x.z, approach = x.vz, slope = 0, t = 0;
    if (lower) {
      while (x.r > low1.r && segment + 2 < lower_count) {
        ++segment;
        low0 = low1;
        low1 = motion(*lower, segment + 1);
      }
      if (low1.r <= low0.r || x.r > low1.r) {
        gap_[m] = gap, radius_[m] = x.r, impulse_[m] = 0;
        continue;  // beyond the other surface
      }
      slope = (low1.z - low0.z) / (low1.r - low0.r);
      t = std::max(0.0, (x.r - low0.r) / (low1.r - low0.r));
      gap += (1 - t) * low0.z + t * low1.z;
      approach += (1 - t) * low0.vz + t * low1.vz + slope * (x.vr - (1 - t) * low0.vr - t * low1.vr);
    }
    gap_[m] = gap, radius_[m] = x.r;
    // a row for each point that would pass, or might once its neighbours are pushed back
    if (gap + dt * approach > 0 && impulse_[m] == 0 && gap > 4 * dt * std::abs(approach)) continue;
    const int begin = static_cast<int>(entries_.size());
    before = 0;
    enter(upper, m, slope, 1);
    if (lower) {
      enter(*lower, segment, -slope * (1 - t), 1 - t);
      enter(*lower, segment + 1, -slope * t, t);
    }
    double response = 0;
    for (std::size_t e = begin; e < entries_.size(); ++e)
      response +=
          entries_[e].inverse_mass * (entries_[e].wr * entries_[e].wr + entries_[e].wz * entries_[e].wz);
    if (response > 0)
      rows_.push_back({m, begin, static_cast<int>(entries_.size()), -gap / dt, response, before});
  }
}

double SurfaceContact::separation(const Row& row) const
{
  double v = 0;
  for (int e = row.begin; e < row.end; ++e)
    v += entries_[e].wr * *entries_[e].vr + entries_[e].wz * *entries_[e].vz;
  return v;
}

void SurfaceContact::push(const Row& row, double impulse)
{
  for (int e = row.begin; e < row.end; ++e) {
    const Entry& x = entries_[e];
    *x.vr += x.wr * x.inverse_mass * impulse;
    *x.vz += x.wz * x.inverse_mass * impulse;
  }
}

void SurfaceContact::account(std::span<const Body>)
{
  for (const Row& row : rows_) dissipated_ -= 0.5 * impulse_[row.point] * (row.before + separation(row));
}

double SurfaceContact::correct(std::span<Body> bodies, double kick, double dt)
{
  for (const Body& body : bodies) check_pores(body);
  make_rows(bodies, kick, dt);
  for (const Row& row : rows_)
    if (impulse_[row.point] > 0) push(row, impulse_[row.point]);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0, largest = 0;
    for (const Row& row : rows_) {
      double& impulse = impulse_[row.point];
      const double wanted = impulse + (row.needed - separation(row)) / row.response;
      const double step = std::max(0.0, wanted) - impulse;
      if (step != 0) push(row, step);
      impulse += step;
      change = std::max(change, std::abs(step)), largest = std::max(largest, impulse);
    }
    if (change <= small_change * largest) break;
  }
  double total = 0;
  outermost_ = -1;
  for (const Row& row : rows_)
    if (impulse_[row.point] > 0) total += impulse_[row.point], outermost_ = row.point;
  return total;
}

double SurfaceContact::edge_radius(std::span<const Body> bodies) const
{
  if (outermost_ < 0) return 0;
  const double closed = radius_[outermost_];
  if (outermost_ + 2 >= bodies.front().reference().surface.count) return closed;
  return edge_between(closed, {radius_[outermost_ + 1], gap_[outermost_ + 1]},
                      {radius_[outermost_ + 2], gap_[outermost_ + 2]});
}

}  // namespace granulaw
