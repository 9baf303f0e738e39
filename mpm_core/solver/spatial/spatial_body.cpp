#include "solver/spatial/spatial_body.hpp"

#include <algorithm>
#include <numeric>

#include "solver/output/state_archive.hpp"

namespace granulaw {

namespace {

/// Entries behind the last node of a field.
constexpr int spare = 8;

double sum_of(const AlignedVector& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

Vector3 SpatialBody::place(int node) const
{
  const int i = node % count[0], j = node / count[0] % count[1], k = node / (count[0] * count[1]);
  return {axes[0].node(i), axes[1].node(j), axes[2].node(k)};
}

int SpatialBody::copies() const
{
  return (mirrored[0] ? 2 : 1) * (mirrored[1] ? 2 : 1) * (mirrored[2] ? 2 : 1);
}

void SpatialBody::allocate_nodes()
{
  for (int d = 0; d < 3; ++d) count[d] = axes[d].functions();
  nodes = count[0] * count[1] * count[2];
  mass_i.assign(nodes, 0.0);
  for (NodeField* field : {&inverse_mass_i, &u_i, &v_i, &f_i})
    for (AlignedVector& component : *field) component.assign(nodes + spare, 0.0);
}

void SpatialBody::allocate_points()
{
  const std::size_t lanes = octants * cells.size();
  for (AlignedVector& component : c_p) component.assign(lanes, 0.0);
  for (AlignedVector* field : {&volume_p, &plastic_strain_p, &plastic_work_p, &elastic_energy_p})
    field->assign(lanes, 0.0);
}

void SpatialBody::throw_with(const Vector3& velocity)
{
  for (int d = 0; d < 3; ++d)
    for (int i = 0; i < nodes; ++i)
      if (inverse_mass_i[d][i] > 0) v_i[d][i] = velocity[d];
}

double SpatialBody::kinetic_energy() const
{
  double sum = 0;
  for (int i = 0; i < nodes; ++i)
    sum += 0.5 * mass_i[i] * (v_i[0][i] * v_i[0][i] + v_i[1][i] * v_i[1][i] + v_i[2][i] * v_i[2][i]);
  return sum;
}

double SpatialBody::strain_energy() const
{
  return sum_of(elastic_energy_p);
}

double SpatialBody::plastic_work() const
{
  return sum_of(plastic_work_p);
}

double SpatialBody::largest_plastic_strain() const
{
  return plastic_strain_p.empty() ? 0 : *std::max_element(plastic_strain_p.begin(), plastic_strain_p.end());
}

Vector3 SpatialBody::momentum() const
{
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < nodes; ++i) sum += mass_i[i] * Vector3(v_i[0][i], v_i[1][i], v_i[2][i]);
  return sum;
}

Vector3 SpatialBody::angular_momentum(const Vector3& centre) const
{
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < nodes; ++i) {
    if (mass_i[i] == 0) continue;
    const Vector3 x = place(i) + Vector3(u_i[0][i], u_i[1][i], u_i[2][i]) - centre;
    sum += mass_i[i] * x.cross(Vector3(v_i[0][i], v_i[1][i], v_i[2][i]));
  }
  return sum;
}

void SpatialBody::visit_state(StateArchive& a)
{
  const auto checksum_of = [](const auto& values, std::uint64_t start) {
    return checksum({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)}, start);
  };
  a.expect(checksum_of(volume_p, checksum_of(mass_i, cells.size())), "reference grid");
  for (int d = 0; d < 3; ++d) a.value(travel[d]);
  a.value(elapsed);
  for (NodeField* field : {&u_i, &v_i})
    for (AlignedVector& component : *field) a.values(component);
  for (AlignedVector& component : c_p) a.values(component);
  for (AlignedVector* field : {&plastic_strain_p, &plastic_work_p, &elastic_energy_p}) a.values(*field);
}

}  // namespace granulaw
