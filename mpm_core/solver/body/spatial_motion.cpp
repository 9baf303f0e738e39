#include "solver/body/spatial_motion.hpp"

#include <Eigen/Geometry>

#include "solver/body/spatial_kernels.hpp"

namespace granulaw {

namespace {

Vector3 at(const NodeField& field, int node)
{
  return {field[4 * node], field[4 * node + 1], field[4 * node + 2]};
}

}  // namespace

Vector3 reference_place(const SpatialBody& b, int node)
{
  const int i = node % b.count[0], j = node / b.count[0] % b.count[1], k = node / (b.count[0] * b.count[1]);
  return {b.axes[0].node(i), b.axes[1].node(j), b.axes[2].node(k)};
}

Vector3 place_now(const SpatialBody& b, int node)
{
  return reference_place(b, node) + at(b.u_i, node);
}

void throw_body(SpatialBody& b, const Vector3& velocity, const Vector3& spin, const Vector3& centre)
{
  for (int i = 0; i < b.nodes; ++i) {
    const Vector3 v = velocity + spin.cross(place_now(b, i) - centre);
    for (int d = 0; d < 3; ++d)
      if (b.inverse_mass_i[4 * i + d] > 0) b.v_i[4 * i + d] = v[d];
  }
}

Vector3 momentum(const SpatialBody& b)
{
  double sum[4];
  spatial_kernels().momentum(b, sum);
  return {sum[0], sum[1], sum[2]};
}

Vector3 mean_velocity(const SpatialBody& b)
{
  Vector3 mean = momentum(b) / b.mass;
  for (int d = 0; d < 3; ++d)
    if (b.mirrored[d]) mean[d] = 0;
  return mean;
}

Vector3 angular_momentum(const SpatialBody& b, const Vector3& centre)
{
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < b.nodes; ++i)
    if (b.mass_i[i] > 0) sum += b.mass_i[i] * (place_now(b, i) - centre).cross(at(b.v_i, i));
  return sum;
}

Vector3 of_whole(const SpatialBody& body, Vector3 angular)
{
  for (int d = 0; d < 3; ++d)
    if (body.mirrored[d])
      for (int e = 0; e < 3; ++e)
        if (e != d) angular[e] = 0;
  return body.copies() * angular;
}

}  // namespace granulaw
