#include "solver/contact/node_plane.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "solver/contact/edge.hpp"

namespace granulaw {

void NodePlane::push(Body& body, int node, double kick, double least)
{
  double& v = body.v_i(node, 1);
  const double impulse = body.reference().mass_i[node] * (least - v);
  const double pulled = pulled_.empty() ? 0 : pulled_[node];
  pushes_.push_back({node, impulse, v - kick * body.reference().inverse_mass_i(node, 1) * body.f_i(node, 1) + pulled});
  impulse_ += impulse;
  v = least;
}

void NodePlane::pull(Body& body, double kick)
{
  const Reference& reference = body.reference();
  const Markers& surface = reference.surface;
  const double strength = 2 * attraction_.work / attraction_.range;
  pulls_.clear();
  pulled_.assign(reference.nodes, 0.0);
  const auto place = [&](int k) { return place_now(body, surface.node(k, 0)); };
  double inner = 0;
  for (int k = 0; k + 1 < surface.count; ++k) {
    const double outer = 0.5 * (place(k)[0] + place(k + 1)[0]), gap = std::max(place(k)[2], 0.0);
    const double area = M_PI * (outer * outer - inner * inner);
    inner = outer;
    if (gap >= attraction_.range) continue;
    const int i = surface.node(k, 0);
    const double impulse = kick * strength * (1 - gap / attraction_.range) * area;
    double& v = body.v_i(i, 1);
    pulls_.push_back({i, impulse, v - kick * reference.inverse_mass_i(i, 1) * body.f_i(i, 1)});
    pulled_[i] = impulse / reference.mass_i[i];
    v -= pulled_[i];
    impulse_ -= impulse;
  }
}

double NodePlane::correct(std::span<Body> bodies, double kick, double dt)
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
  if (attraction_.work > 0) pull(body, kick);
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

void NodePlane::account(std::span<const Body> bodies)
{
  for (const Push& p : pulls_) attracted_ += 0.5 * p.impulse * (p.before + bodies.front().v_i(p.node, 1));
  for (const Push& p : pushes_) dissipated_ -= 0.5 * p.impulse * (p.before + bodies.front().v_i(p.node, 1));
}

double NodePlane::edge_radius(std::span<const Body> bodies) const
{
  if (outermost_ < 0) return 0;
  const Body& body = bodies.front();
  const auto point = [&](int k) {
    const Vector3 x = place_now(body, body.reference().surface.node(k, 0));
    return EdgePoint{x[0], x[2]};
  };
  const double closed = point(outermost_).r;
  if (outermost_ + 2 >= body.reference().surface.count) return closed;
  return edge_between(closed, point(outermost_ + 1), point(outermost_ + 2));
}

void NodePlane::visit_state(StateArchive& a)
{
  Contact::visit_state(a);
  a.value(outermost_), a.value(attracted_);
}

}  // namespace granulaw
