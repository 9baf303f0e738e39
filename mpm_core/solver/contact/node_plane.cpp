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
  pushes_.push_back({node, impulse, v - kick * body.reference().inverse_mass_i(node, 1) * body.f_i(node, 1)});
  impulse_ += impulse;
  v = least;
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
  impulse_ = pull(bodies, kick);
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

void NodePlane::account(std::span<const Body> bodies)
{
  Contact::account(bodies);
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
  a.value(outermost_);
}

}  // namespace granulaw
