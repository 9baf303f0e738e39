#include "solver/body/motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "solver/body/kernels.hpp"

namespace granulaw {

Vector3 at(const NodeField& field, int node)
{
  Vector3 v = Vector3::Zero();
  for (int c = 0; c < field.components; ++c) v[field.direction(c)] = field(node, c);
  return v;
}

Vector3 reference_place(const Body& b, int node)
{
  return at(b.reference().place_i, node);
}

Vector3 place_now(const Body& b, int node)
{
  return reference_place(b, node) + at(b.u_i, node);
}

Vector3 carried(const NodeField& field, const Markers& markers, int marker)
{
  const double* weight = markers.weights(marker);
  const int* offset = markers.offsets(marker);
  const double* values = field.values.data() + std::size_t(markers.lowest[marker]) * field.per_node;
  const int across = field.per_component, last = field.components - 1, step = field.per_node;
  double x = 0, y = 0, z = 0;
  for (int k = 0; k < markers.corners; ++k) {
    const double* v = values + std::ptrdiff_t(offset[k]) * step;
    x += weight[k] * v[0], z += weight[k] * v[std::ptrdiff_t(last) * across];
    if (last == 2) y += weight[k] * v[across];
  }
  return {x, y, z};
}

Vector3 travel_of(const Body& b)
{
  return {b.travel[0], b.travel[1], b.travel[2]};
}

void move_body(Body& b, const Vector3& way)
{
  for (int c = 0; c < b.u_i.components; ++c)
    for (int i = 0; i < b.nodes(); ++i) b.u_i(i, c) += way[b.u_i.direction(c)];
  for (int d = 0; d < 3; ++d) b.travel[d] += way[d];
}

void throw_body(Body& b, const Vector3& velocity, const Vector3& spin, const Vector3& centre)
{
  const NodeField& inverse_mass = b.reference().inverse_mass_i;
  for (int i = 0; i < b.nodes(); ++i) {
    const Vector3 v = velocity + spin.cross(place_now(b, i) - centre);
    for (int c = 0; c < b.v_i.components; ++c)
      if (inverse_mass(i, c) > 0) b.v_i(i, c) = v[b.v_i.direction(c)];
  }
  if (b.moving) std::fill(b.moving->vz.begin(), b.moving->vz.end(), velocity[2]);
}

void add_velocity(Body& b, const Vector3& velocity)
{
  for (int c = 0; c < b.v_i.components; ++c) {
    const double more = velocity[b.v_i.direction(c)];
    if (more == 0) continue;
    const double* inverse_mass = &b.reference().inverse_mass_i.values[b.v_i.at(0, c)];
    double* v = &b.v_i.values[b.v_i.at(0, c)];
    const int nodes = b.v_i.nodes, step = b.v_i.per_node;
    if (step == 1)
      for (int i = 0; i < nodes; ++i) v[i] += inverse_mass[i] > 0 ? more : 0;
    else
      for (int i = 0; i < nodes * step; i += step) v[i] += inverse_mass[i] > 0 ? more : 0;
  }
}

double damp_velocity(Body& b, const Vector3& bulk, double share)
{
  const Reference& reference = b.reference();
  const double* mass = reference.mass_i.data();
  const double keep = 1 - share;
  const int nodes = b.v_i.nodes, step = b.v_i.per_node;
  double gain = 0;
  for (int c = 0; c < b.v_i.components; ++c) {
    const double own = bulk[b.v_i.direction(c)];
    const double* inverse_mass = &reference.inverse_mass_i.values[b.v_i.at(0, c)];
    double* v = &b.v_i.values[b.v_i.at(0, c)];
    double sums[4]{};  // side by side: the next sum does not wait for the last
    for (int i = 0; i < nodes; ++i) {
      double& now = v[std::ptrdiff_t(i) * step];
      const double damped = inverse_mass[std::ptrdiff_t(i) * step] > 0 ? own + keep * (now - own) : now;
      sums[i & 3] += mass[i] * (damped - now) * (damped + now);
      now = damped;
    }
    gain += 0.5 * ((sums[0] + sums[1]) + (sums[2] + sums[3]));
  }
  return gain;
}

Vector3 momentum(const Body& b)
{
  double sum[4];
  kernels(b).momentum(b, sum);
  return {sum[0], sum[1], sum[2]};
}

Vector3 mean_velocity(const Body& b)
{
  Vector3 mean = momentum(b) / b.mass();
  for (int d = 0; d < 3; ++d)
    if (b.reference().mirrored[d]) mean[d] = 0;
  return mean;
}

Vector3 angular_momentum(const Body& b, const Vector3& centre)
{
  const std::vector<double>& mass = b.reference().mass_i;
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < b.nodes(); ++i)
    if (mass[i] > 0) sum += mass[i] * (place_now(b, i) - centre).cross(at(b.v_i, i));
  return sum;
}

Vector3 of_whole(const Body& body, Vector3 angular)
{
  const Reference& r = body.reference();
  for (int d = 0; d < 3; ++d)
    if (r.mirrored[d])
      for (int e = 0; e < 3; ++e)
        if (e != d) angular[e] = 0;
  return r.copies() * angular;
}

}  // namespace granulaw
