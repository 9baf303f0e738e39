#include "solver/spatial/spatial_body.hpp"

#include <algorithm>
#include <numeric>

#include "solver/output/state_archive.hpp"

namespace granulaw {

namespace {

double sum_of(const AlignedVector& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

int SpatialBody::copies() const
{
  return (mirrored[0] ? 2 : 1) * (mirrored[1] ? 2 : 1) * (mirrored[2] ? 2 : 1);
}

void SpatialBody::allocate_nodes()
{
  for (int d = 0; d < 3; ++d) count[d] = axes[d].functions();
  nodes = count[0] * count[1] * count[2];
  mass_i.assign(nodes, 0.0);
  for (NodeField* field : {&inverse_mass_i, &u_i, &v_i, &f_i}) field->assign(4 * std::size_t(nodes), 0.0);
}

void SpatialBody::allocate_points()
{
  const std::size_t lanes = octants * cells.size();
  for (AlignedVector& component : c_p) component.assign(lanes, 0.0);
  for (AlignedVector* field : {&volume_p, &plastic_strain_p, &plastic_work_p, &elastic_energy_p})
    field->assign(lanes, 0.0);
}

double SpatialBody::kinetic_energy() const
{
  double sum = 0;
  for (int i = 0; i < nodes; ++i) {
    const double* v = v_i.data() + 4 * i;
    sum += 0.5 * mass_i[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
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

void SpatialBody::visit_state(StateArchive& a)
{
  const auto checksum_of = [](const auto& values, std::uint64_t start) {
    return checksum({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)}, start);
  };
  a.expect(checksum_of(volume_p, checksum_of(mass_i, cells.size())), "reference grid");
  for (int d = 0; d < 3; ++d) a.value(travel[d]);
  a.value(elapsed);
  for (NodeField* field : {&u_i, &v_i}) a.values(*field);
  for (AlignedVector& component : c_p) a.values(component);
  for (AlignedVector* field : {&plastic_strain_p, &plastic_work_p, &elastic_energy_p}) a.values(*field);
}

}  // namespace granulaw
