#include "solver/body/body.hpp"

#include <algorithm>
#include <numeric>

#include "base/state_archive.hpp"
#include "solver/body/kernels.hpp"

namespace granulaw {

void weigh_markers(Markers& markers, const SplineAxis& r_axis, const SplineAxis& z_axis)
{
  const std::size_t n = static_cast<std::size_t>(markers.count);
  markers.corners = 9;
  markers.lowest.assign(n, 0), markers.offset.resize(9 * n), markers.weight.resize(9 * n);
  for (std::size_t m = 0; m < n; ++m) {
    const SplineAxis::Values nr = r_axis.at(markers.place[m][0]), nz = z_axis.at(markers.place[m][2]);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        markers.offset[9 * m + 3 * a + b] = (nr.first + a) * z_axis.functions() + nz.first + b;
        markers.weight[9 * m + 3 * a + b] = nr.n[a] * nz.n[b];
      }
  }
}

void Reference::resize_nodes(int count, int components)
{
  nodes = count;
  mass_i.assign(std::size_t(count), 0.0);
  place_i.resize(count, components), inverse_mass_i.resize(count, components);
}

void Reference::resize_corners(int count, int each)
{
  points = filled = count;
  corners.each = each;
  const std::size_t all = std::size_t(each) * count;
  CornerWeights<double>& w = corners.full;
  for (auto* field : {&w.br, &w.bz, &w.bh}) field->assign(all, 0.0);
  if (each == 4) w.hourglass.assign(all, 0.0), w.stiffness.assign(std::size_t(count), 0.0);
  volume_p.assign(std::size_t(count), 0.0);
  corners.node.assign(all, 0);
}

void Reference::link(const std::vector<int>& axis)
{
  std::vector<int> used(std::size_t(nodes), 0);
  const int all = corners.each * points;
  for (const int node : corners.node) ++used[node];
  corners.slots =
      (*std::max_element(used.begin(), used.end()) + 3) / 4 * 4;  // the kernels take four at a time
  corners.node_slots.assign(std::size_t(corners.slots) * nodes, all);
  std::fill(used.begin(), used.end(), 0);
  for (int p = 0; p < points; ++p)
    for (int k = 0; k < corners.each; ++k) {
      const int at = k * points + p, node = corners.node[at];
      corners.node_slots[std::size_t(used[node]++) * nodes + node] = at;
    }
  for (int i = 0; i < nodes; ++i)
    for (int c = 0; c < 2; ++c) inverse_mass_i(i, c) = mass_i[i] > 0 ? 1 / mass_i[i] : 0;
  for (const int i : axis) inverse_mass_i(i, 0) = 0;
  mass = std::accumulate(mass_i.begin(), mass_i.end(), 0.0);
}

namespace {

constexpr auto copy_values = [](const auto& from, auto& to) { to.assign(from.begin(), from.end()); };

void round_weights(const Corners& from, Corners& to)
{
  const auto copy = [&](auto field, auto rounded) { copy_values(from.full.*field, to.single.*rounded); };
  using Full = CornerWeights<double>;
  using Single = CornerWeights<float>;
  copy(&Full::br, &Single::br), copy(&Full::bz, &Single::bz), copy(&Full::bh, &Single::bh);
  copy(&Full::hourglass, &Single::hourglass), copy(&Full::stiffness, &Single::stiffness);
}

AxisWeights<float> rounded(const AxisWeights<double>& w)
{
  AxisWeights<float> r{};
  for (int a = 0; a < 3; ++a)
    for (int k = 0; k < octants; ++k) r.n[a][k] = float(w.n[a][k]), r.dn[a][k] = float(w.dn[a][k]);
  r.per_edge = float(w.per_edge), r.left = float(w.left), r.right = float(w.right);
  return r;
}

void round_weights(const SplineCells& from, SplineCells& to)
{
  for (int d = 0; d < 3; ++d)
    for (const AxisWeights<double>& w : from.full.axis[d]) to.single.axis[d].push_back(rounded(w));
  copy_values(from.full.cut_moments, to.single.cut_moments);
}

/// Calls visit(field of a, field of b) for each field of the points' state.
template <class A, class B, class Visit>
void for_state(A& a, B& b, Visit visit)
{
  b.c_p.resize(a.c_p.size());
  for (std::size_t k = 0; k < a.c_p.size(); ++k) visit(a.c_p[k], b.c_p[k]);
  visit(a.plastic_strain_p, b.plastic_strain_p);
  visit(a.plastic_work_p, b.plastic_work_p);
  visit(a.elastic_energy_p, b.elastic_energy_p);
}

double sum_of(const auto& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double largest_of(const auto& values)
{
  return values.empty() ? 0.0 : double(*std::max_element(values.begin(), values.end()));
}

}  // namespace

Body::Body(Reference built)
{
  const auto reference = std::make_shared<Reference>(std::move(built));
  shared = reference;
  const Reference& r = *reference;
  for (NodeField* field : {&u_i, &v_i, &f_i}) field->resize(r.nodes, r.place_i.components);
  const std::size_t count = std::size_t(r.points);
  state.c_p.assign(r.is_spatial() ? 6 : 4, AlignedVector<double>(count, 0.0));
  for (auto* field : {&state.plastic_strain_p, &state.plastic_work_p, &state.elastic_energy_p})
    field->assign(count, 0.0);
  for (auto* field : {&state.corner_fr, &state.corner_fz}) field->assign(r.corners.node.size() + 1, 0.0);
  reference->corners.bound_at_rest = r.is_spatial() ? 1 : kernels(*this).growth(*this).cut;
}

void Body::use_single()
{
  auto rounded = std::make_shared<Reference>(*shared);
  round_weights(shared->corners, rounded->corners);
  round_weights(shared->cells, rounded->cells);
  copy_values(shared->volume_p, rounded->single_volume_p);
  shared = std::move(rounded);
  for_state(state, single, copy_values);
  copy_values(state.corner_fr, single.corner_fr), copy_values(state.corner_fz, single.corner_fz);
}

void Body::fetch_state()
{
  if (is_single()) for_state(single, state, copy_values);
}

void Body::visit_state(StateArchive& a)
{
  const auto checksum_of = [](const auto& values, std::uint64_t start) {
    return checksum({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)}, start);
  };
  // the same request makes the same grid, to the last bit, unless the mathematical library is another one
  const Reference& r = reference();
  a.expect(checksum_of(r.volume_p, checksum_of(r.place_i.values, r.points)), "reference grid");
  a.value(travel), a.value(elapsed);
  a.values(u_i.values), a.values(v_i.values);
  const auto carry = [&](auto& field, const auto&) { a.values(field); };
  if (is_single())
    for_state(single, single, carry);
  else
    for_state(state, state, carry);
  if (!moving) return;
  MovingPoints& m = *moving;
  for (auto* field :
       {&m.r, &m.z, &m.vr, &m.vz, &m.crr, &m.crz, &m.czr, &m.czz, &m.trr, &m.tzz, &m.trz, &m.thh})
    a.values(*field);
  a.values(m.own.surface.place);
}

double Body::kinetic_energy() const
{
  const std::vector<double>& mass = reference().mass_i;
  double sum = 0;
  for (int i = 0; i < v_i.nodes; ++i) {
    double square = 0;
    for (int c = 0; c < v_i.components; ++c) square += v_i(i, c) * v_i(i, c);
    sum += 0.5 * mass[i] * square;
  }
  return sum;
}

double Body::strain_energy() const
{
  return is_single() ? sum_of(single.elastic_energy_p) : sum_of(state.elastic_energy_p);
}

double Body::hourglass_energy() const
{
  const Reference& r = reference();
  const Corners& at = r.corners;
  if (at.each != 4) return 0;
  double sum = 0;
  for (int p = 0; p < r.points; ++p) {
    double q[2]{};
    for (int k = 0; k < 4; ++k) {
      const int corner = k * r.points + p;
      for (int c = 0; c < 2; ++c) q[c] += at.full.hourglass[corner] * u_i(at.node[corner], c);
    }
    sum += 0.5 * at.full.stiffness[p] * (q[0] * q[0] + q[1] * q[1]);
  }
  return sum;
}

double Body::plastic_work() const
{
  return is_single() ? sum_of(single.plastic_work_p) : sum_of(state.plastic_work_p);
}

double Body::largest_plastic_strain() const
{
  return is_single() ? largest_of(single.plastic_strain_p) : largest_of(state.plastic_strain_p);
}

}  // namespace granulaw
