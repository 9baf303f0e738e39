#include "solver/body/body.hpp"

#include <algorithm>
#include <numeric>

#include "solver/body/kernels.hpp"
#include "base/state_archive.hpp"

namespace granulaw {

void Body::allocate(int node_count, int point_count, int corner_count)
{
  nodes = node_count, points = point_count, corners = corner_count;
  for (auto* field : {&r_i, &z_i, &mass_i, &inverse_mass_i, &ur_i, &uz_i, &vr_i, &vz_i, &fr_i, &fz_i})
    field->assign(nodes, 0.0);
  on_axis.assign(nodes, 0);
  const std::size_t all = std::size_t(corners) * points;
  for (auto* field : {&br_p, &bz_p, &bh_p}) field->assign(all, 0.0);
  if (corners == 4) hourglass_p.assign(all, 0.0), stiffness_p.assign(points, 0.0);
  for (auto* field :
       {&volume_p, &crr_p, &czz_p, &crz_p, &chh_p, &plastic_strain_p, &plastic_work_p, &elastic_energy_p})
    field->assign(points, 0.0);
  corner_fr.assign(all + 1, 0.0), corner_fz.assign(all + 1, 0.0);
  corner_p.assign(all, 0);
}

void Body::link()
{
  std::vector<int> used(nodes, 0);
  const int all = corners * points;
  for (int at = 0; at < all; ++at) ++used[corner_p[at]];
  slots = (*std::max_element(used.begin(), used.end()) + 3) / 4 * 4;  // the kernels take four at a time
  node_slots.assign(std::size_t(slots) * nodes, all);
  std::fill(used.begin(), used.end(), 0);
  for (int p = 0; p < points; ++p)
    for (int k = 0; k < corners; ++k) {
      const int at = k * points + p, node = corner_p[at];
      node_slots[std::size_t(used[node]++) * nodes + node] = at;
    }
  for (const int i : axis) on_axis[i] = 1;
  for (int i = 0; i < nodes; ++i) inverse_mass_i[i] = mass_i[i] > 0 ? 1 / mass_i[i] : 0;
  mass = std::accumulate(mass_i.begin(), mass_i.end(), 0.0);
}

namespace {

/// Calls copy(from, to) for each array that a point of the other precision needs.
template <class From, class To, class Copy>
void for_weights(From& from, To& to, Copy copy)
{
  copy(from.br_p, to.br_p), copy(from.bz_p, to.bz_p), copy(from.bh_p, to.bh_p);
  copy(from.hourglass_p, to.hourglass_p), copy(from.stiffness_p, to.stiffness_p);
  copy(from.volume_p, to.volume_p);
  copy(from.corner_fr, to.corner_fr), copy(from.corner_fz, to.corner_fz);
}

template <class From, class To, class Copy>
void for_state(From& from, To& to, Copy copy)
{
  copy(from.crr_p, to.crr_p), copy(from.czz_p, to.czz_p), copy(from.crz_p, to.crz_p);
  copy(from.chh_p, to.chh_p), copy(from.plastic_strain_p, to.plastic_strain_p);
  copy(from.plastic_work_p, to.plastic_work_p), copy(from.elastic_energy_p, to.elastic_energy_p);
}

constexpr auto copy_values = [](const auto& from, auto& to) { to.assign(from.begin(), from.end()); };

}  // namespace

void Body::use_single()
{
  for_weights(*this, single, copy_values);
  for_state(*this, single, copy_values);
}

void Body::fetch_state()
{
  if (is_single()) for_state(single, *this, copy_values);
}

namespace {

template <class Real>
void visit_points(PointArrays<Real>& points, StateArchive& a)
{
  for_state(points, points, [&](std::vector<Real>& field, const std::vector<Real>&) { a.values(field); });
}

std::uint64_t checksum_of(const std::vector<double>& values, std::uint64_t start)
{
  return checksum({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)}, start);
}

}  // namespace

void Body::visit_state(StateArchive& a)
{
  // the same request makes the same grid, to the last bit, unless the mathematical library is another one
  a.expect(checksum_of(volume_p, checksum_of(z_i, checksum_of(r_i, corners))), "reference grid");
  a.value(travel), a.value(elapsed);
  for (auto* field : {&ur_i, &uz_i, &vr_i, &vz_i}) a.values(*field);
  if (is_single())
    visit_points(single, a);
  else
    visit_points(*this, a);
  if (!moving) return;
  MovingPoints& m = *moving;
  for (auto* field : {&m.r, &m.z, &m.vr, &m.vz, &m.crr, &m.crz, &m.czr, &m.czz, &m.trr, &m.tzz, &m.trz,
                      &m.thh, &surface.r, &surface.z})
    a.values(*field);
}

double Body::strain_energy() const
{
  if (is_single())
    return std::accumulate(single.elastic_energy_p.begin(), single.elastic_energy_p.end(), 0.0);
  return std::accumulate(elastic_energy_p.begin(), elastic_energy_p.end(), 0.0);
}

double Body::hourglass_energy() const
{
  double sum = 0;
  for (int p = 0; p < points && corners == 4; ++p) {
    double qr = 0, qz = 0;
    for (int k = 0; k < 4; ++k) {
      const int at = k * points + p;
      qr += hourglass_p[at] * ur_i[corner_p[at]], qz += hourglass_p[at] * uz_i[corner_p[at]];
    }
    sum += 0.5 * stiffness_p[p] * (qr * qr + qz * qz);
  }
  return sum;
}

double Body::plastic_work() const
{
  if (is_single()) return std::accumulate(single.plastic_work_p.begin(), single.plastic_work_p.end(), 0.0);
  return std::accumulate(plastic_work_p.begin(), plastic_work_p.end(), 0.0);
}

double Body::largest_plastic_strain() const
{
  const auto largest = [](const auto& x) {
    return x.empty() ? 0.0 : double(*std::max_element(x.begin(), x.end()));
  };
  return is_single() ? largest(single.plastic_strain_p) : largest(plastic_strain_p);
}

void Body::throw_along(double vz)
{
  std::fill(vz_i.begin(), vz_i.end(), vz);
  if (moving) std::fill(moving->vz.begin(), moving->vz.end(), vz);
}

double Body::kinetic_energy() const
{
  double sum = 0;
  for (int i = 0; i < nodes; ++i) sum += 0.5 * mass_i[i] * (vr_i[i] * vr_i[i] + vz_i[i] * vz_i[i]);
  return sum;
}

double Body::mean_velocity() const
{
  return kernels().momentum(*this) / mass;
}

}  // namespace granulaw
