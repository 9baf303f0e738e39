#include "solver/grid/updated_body.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "solver/body/kernels.hpp"

namespace granulaw {

namespace {

constexpr double growth = 1.15, coarsest = 0.15;
/// Room beside and above the body for what flows outwards and for the rebound, in R.
constexpr double margin = 0.3;

/// Weights of every point and marker where they are now.
void weigh(Body& b)
{
  const MovingPoints& m = *b.moving;
  const int n = b.points, columns = m.z_axis.functions();
  for (int p = 0; p < n; ++p) {
    const SplineAxis::Values nr = m.r_axis.at(m.r[p]), nz = m.z_axis.at(m.z[p]);
    const double per_r = 1 / m.r[p];
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c) {
        const int at = (3 * a + c) * n + p;
        b.corner_p[at] = (nr.first + a) * columns + nz.first + c;
        b.br_p[at] = nr.dn[a] * nz.n[c];
        b.bz_p[at] = nr.n[a] * nz.dn[c];
        b.bh_p[at] = nr.n[a] * nz.n[c] * per_r;
      }
  }
  weigh_markers(b.surface, m.r_axis, m.z_axis);
}

}  // namespace

void updated_points_to_grid(Body& b)
{
  weigh(b);
  MovingPoints& m = *b.moving;
  const int n = b.points;
  for (auto* field : {&b.mass_i, &b.vr_i, &b.vz_i}) std::fill(field->begin(), field->end(), 0.0);
  for (int p = 0; p < n; ++p)
    for (int k = 0; k < 9; ++k) {
      const int at = k * n + p, i = b.corner_p[at];
      const double share = m.mass[p] * b.bh_p[at] * m.r[p];
      const double dr = b.r_i[i] - m.r[p], dz = b.z_i[i] - m.z[p];
      b.mass_i[i] += share;
      b.vr_i[i] += share * (m.vr[p] + m.crr[p] * dr + m.crz[p] * dz);
      b.vz_i[i] += share * (m.vz[p] + m.czr[p] * dr + m.czz[p] * dz);
    }
  for (int i = 0; i < b.nodes; ++i) {
    b.inverse_mass_i[i] = b.mass_i[i] > 1e-20 * b.mass ? 1 / b.mass_i[i] : 0;
    b.vr_i[i] *= b.inverse_mass_i[i], b.vz_i[i] *= b.inverse_mass_i[i];
  }
  kernels().force_of_stress(b);
}

void updated_grid_to_points(Body& b, double dt)
{
  kernels().update_stress(b);
  MovingPoints& m = *b.moving;
  const int n = b.points;
  for (int p = 0; p < n; ++p) {
    double vr = 0, vz = 0, brr = 0, brz = 0, bzr = 0, bzz = 0, drr = 0, dzz = 0;
    for (int k = 0; k < 9; ++k) {
      const int at = k * n + p, i = b.corner_p[at];
      const double w = b.bh_p[at] * m.r[p], dr = b.r_i[i] - m.r[p], dz = b.z_i[i] - m.z[p];
      vr += w * b.vr_i[i], vz += w * b.vz_i[i];
      brr += w * b.vr_i[i] * dr, brz += w * b.vr_i[i] * dz;
      bzr += w * b.vz_i[i] * dr, bzz += w * b.vz_i[i] * dz;
      drr += w * dr * dr, dzz += w * dz * dz;
    }
    m.vr[p] = vr, m.vz[p] = vz;
    // nodes stand at Greville abscissae: the second moment about the point is diagonal
    m.crr[p] = brr / drr, m.crz[p] = brz / dzz, m.czr[p] = bzr / drr, m.czz[p] = bzz / dzz;
    m.r[p] += dt * vr, m.z[p] += dt * vz;
  }
  Surface& s = b.surface;
  for (int k = 0; k < s.count; ++k) {
    double vr = 0, vz = 0;
    for (int c = 0; c < 9; ++c) {
      const std::size_t at = std::size_t(c) * s.count + k;
      vr += s.weight[at] * b.vr_i[s.node[at]], vz += s.weight[at] * b.vz_i[s.node[at]];
    }
    s.r[k] += dt * vr, s.z[k] += dt * vz;
  }
  std::fill(b.ur_i.begin(), b.ur_i.end(), 0.0), std::fill(b.uz_i.begin(), b.uz_i.end(), 0.0);
  const double top = m.z_axis.lines().back(), rim = m.r_axis.lines().back();
  for (int p = 0; p < n; ++p)
    if (!(m.r[p] > 0 && m.r[p] < rim && m.z[p] < top))
      fail("solver", "a material point left the grid `updated`; use the grid `mapped` or `rectilinear`");
}

Body updated_body(const CutSection& s)
{
  MovingPoints m;
  m.r_axis = SplineAxis(graded_lines(0, s.block, s.radius + margin, s.fine, growth, coarsest, s.shift));
  m.z_axis = SplineAxis(graded_lines(0, s.depth, s.height + margin, s.fine, growth, coarsest));
  const std::vector<Piece> pieces = cut_pieces(s, m.r_axis, m.z_axis);
  if (pieces.empty()) fail("grid", "no part of the body lies on it");
  const int count = static_cast<int>(pieces.size());

  Body b;
  b.allocate(m.r_axis.functions() * m.z_axis.functions(), count, 9);
  b.regions = regions_of(s.phases, pieces);
  for (int i = 0; i < m.r_axis.functions(); ++i)
    for (int j = 0; j < m.z_axis.functions(); ++j) {
      const int node = i * m.z_axis.functions() + j;
      b.r_i[node] = m.r_axis.node(i), b.z_i[node] = m.z_axis.node(j);
      if (i == 0) b.axis.push_back(node);
    }
  for (auto* field :
       {&m.r, &m.z, &m.mass, &m.vr, &m.vz, &m.crr, &m.crz, &m.czr, &m.czz, &m.trr, &m.tzz, &m.trz, &m.thh})
    field->assign(count, 0.0);
  double sampled = 0;
  for (const Piece& p : pieces) sampled += s.phases[p.phase].density * p.volume;
  const double scale = s.mass > 0 ? s.mass / sampled : 1;
  for (int p = 0; p < count; ++p) {
    m.r[p] = pieces[p].r, m.z[p] = pieces[p].z;
    m.mass[p] = scale * s.phases[pieces[p].phase].density * pieces[p].volume;
    b.volume_p[p] = pieces[p].volume;
  }
  b.surface = section_markers(s, m.r_axis, 2);  // points and columns drift apart: one could be missed
  b.mass = scale * sampled;
  b.moving = std::move(m);
  updated_points_to_grid(b);
  for (const int i : b.axis) b.on_axis[i] = 1;
  return b;
}

}  // namespace granulaw
