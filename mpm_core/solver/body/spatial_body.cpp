#include "solver/body/spatial_body.hpp"

#include <algorithm>
#include <numeric>

#include "base/state_archive.hpp"

namespace granulaw {

namespace {

template <class Real>
double sum_of(const AlignedVector<Real>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real>
double largest_of(const AlignedVector<Real>& values)
{
  return values.empty() ? 0.0 : double(*std::max_element(values.begin(), values.end()));
}

/// Calls visit(field of a, field of b) for each field of the points' state.
template <class A, class B, class Visit>
void for_state(A& a, B& b, Visit visit)
{
  for (std::size_t k = 0; k < a.c_p.size(); ++k) visit(a.c_p[k], b.c_p[k]);
  visit(a.plastic_strain_p, b.plastic_strain_p);
  visit(a.plastic_work_p, b.plastic_work_p);
  visit(a.elastic_energy_p, b.elastic_energy_p);
}

constexpr auto copy_values = [](const auto& from, auto& to) { to.assign(from.begin(), from.end()); };

AxisWeights<float> rounded(const AxisWeights<double>& w)
{
  AxisWeights<float> r{};
  for (int a = 0; a < 3; ++a)
    for (int k = 0; k < octants; ++k) r.n[a][k] = float(w.n[a][k]), r.dn[a][k] = float(w.dn[a][k]);
  r.per_edge = float(w.per_edge), r.left = float(w.left), r.right = float(w.right);
  return r;
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
  for (AlignedVector<double>& component : c_p) component.assign(lanes, 0.0);
  for (AlignedVector<double>* field : {&volume_p, &plastic_strain_p, &plastic_work_p, &elastic_energy_p})
    field->assign(lanes, 0.0);
}

void SpatialBody::use_single()
{
  for (int d = 0; d < 3; ++d) {
    single.axis_weights[d].clear();
    for (const AxisWeights<double>& w : axis_weights[d]) single.axis_weights[d].push_back(rounded(w));
  }
  copy_values(cut_moments, single.cut_moments);
  copy_values(volume_p, single.volume_p);
  for_state(*this, single, copy_values);
}

void SpatialBody::fetch_state()
{
  if (is_single()) for_state(single, *this, copy_values);
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
  return is_single() ? sum_of(single.elastic_energy_p) : sum_of(elastic_energy_p);
}

double SpatialBody::plastic_work() const
{
  return is_single() ? sum_of(single.plastic_work_p) : sum_of(plastic_work_p);
}

double SpatialBody::largest_plastic_strain() const
{
  return is_single() ? largest_of(single.plastic_strain_p) : largest_of(plastic_strain_p);
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
  const auto carry = [&](auto& field, const auto&) { a.values(field); };
  if (is_single())
    for_state(single, single, carry);
  else
    for_state(*this, *this, carry);
}

}  // namespace granulaw
