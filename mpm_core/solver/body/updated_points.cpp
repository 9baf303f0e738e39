#include "solver/body/updated_points.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "solver/body/kernels.hpp"
#include "solver/body/motion.hpp"

namespace granulaw {

namespace {

/// Weights of every point and marker where they are now.
void weigh(MovingPoints& m)
{
  Corners& corners = m.own.corners;
  CornerWeights<double>& w = corners.full;
  const int n = m.own.points, columns = m.z_axis.functions();
  for (int p = 0; p < n; ++p) {
    const SplineAxis::Values nr = m.r_axis.at(m.r[p]), nz = m.z_axis.at(m.z[p]);
    const double per_r = 1 / m.r[p];
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c) {
        const int at = (3 * a + c) * n + p;
        corners.node[at] = (nr.first + a) * columns + nz.first + c;
        w.br[at] = nr.dn[a] * nz.n[c];
        w.bz[at] = nr.n[a] * nz.dn[c];
        w.bh[at] = nr.n[a] * nz.n[c] * per_r;
      }
  }
  weigh_markers(m.own.surface, m.r_axis, m.z_axis);
}

}  // namespace

void updated_points_to_grid(Body& b)
{
  MovingPoints& m = *b.moving;
  weigh(m);
  Reference& own = m.own;
  const Corners& corners = own.corners;
  const int n = own.points;
  std::fill(own.mass_i.begin(), own.mass_i.end(), 0.0);
  std::fill(b.v_i.values.begin(), b.v_i.values.end(), 0.0);
  for (int p = 0; p < n; ++p)
    for (int k = 0; k < 9; ++k) {
      const int at = k * n + p, i = corners.node[at];
      const double share = m.mass[p] * corners.full.bh[at] * m.r[p];
      const double dr = own.place_i(i, 0) - m.r[p], dz = own.place_i(i, 1) - m.z[p];
      own.mass_i[i] += share;
      b.v_i(i, 0) += share * (m.vr[p] + m.crr[p] * dr + m.crz[p] * dz);
      b.v_i(i, 1) += share * (m.vz[p] + m.czr[p] * dr + m.czz[p] * dz);
    }
  for (int i = 0; i < own.nodes; ++i)
    for (int c = 0; c < 2; ++c) {
      const bool held = c == 0 && own.place_i(i, 0) == 0;  // on the axis
      own.inverse_mass_i(i, c) = !held && own.mass_i[i] > 1e-20 * own.mass ? 1 / own.mass_i[i] : 0;
      b.v_i(i, c) *= own.inverse_mass_i(i, c);
    }
  point_kernels().force_of_stress(b);
}

void updated_grid_to_points(Body& b, double dt)
{
  point_kernels().update_stress(b);
  MovingPoints& m = *b.moving;
  const Corners& corners = m.own.corners;
  const int n = m.own.points;
  for (int p = 0; p < n; ++p) {
    double vr = 0, vz = 0, brr = 0, brz = 0, bzr = 0, bzz = 0, drr = 0, dzz = 0;
    for (int k = 0; k < 9; ++k) {
      const int at = k * n + p, i = corners.node[at];
      const double w = corners.full.bh[at] * m.r[p], dr = m.own.place_i(i, 0) - m.r[p];
      const double dz = m.own.place_i(i, 1) - m.z[p], ur = b.v_i(i, 0), uz = b.v_i(i, 1);
      vr += w * ur, vz += w * uz;
      brr += w * ur * dr, brz += w * ur * dz;
      bzr += w * uz * dr, bzz += w * uz * dz;
      drr += w * dr * dr, dzz += w * dz * dz;
    }
    m.vr[p] = vr, m.vz[p] = vz;
    // nodes stand at Greville abscissae: the second moment about the point is diagonal
    m.crr[p] = brr / drr, m.crz[p] = brz / dzz, m.czr[p] = bzr / drr, m.czz[p] = bzz / dzz;
    m.r[p] += dt * vr, m.z[p] += dt * vz;
  }
  Markers& s = m.own.surface;
  for (int k = 0; k < s.count; ++k) {
    const Vector3 v = carried(b.v_i, s, k);
    for (int d = 0; d < 3; ++d) s.place[k][d] += dt * v[d];
  }
  std::fill(b.u_i.values.begin(), b.u_i.values.end(), 0.0);
  const double top = m.z_axis.lines().back(), rim = m.r_axis.lines().back();
  for (int p = 0; p < n; ++p)
    if (!(m.r[p] > 0 && m.r[p] < rim && m.z[p] < top))
      fail("solver", "a material point left the grid `updated`; use the grid `mapped` or `rectilinear`");
}

}  // namespace granulaw
