#include "solver/grid/mapped_body.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "base/gauss.hpp"

namespace granulaw {

namespace {

constexpr std::array<double, 4> corner_x{-1, 1, 1, -1}, corner_y{-1, -1, 1, 1}, hourglass_sign{1, -1, 1, -1};

/// Exact integrals over one bilinear axisymmetric cell: 2 x 2 Gauss points, all of weight 1.
struct CellIntegrals
{
  double volume = 0, area = 0;
  std::array<double, 4> mass{}, br{}, bz{}, bh{}, area_br{}, area_bz{};
};

CellIntegrals integrate(const std::array<MappedGrid::Node, 4>& x)
{
  CellIntegrals c;
  for (const double xi : GaussPoints<2>::node)
    for (const double eta : GaussPoints<2>::node) {
      std::array<double, 4> n, dx, dy;
      double rx = 0, ry = 0, zx = 0, zy = 0, r = 0;
      for (int k = 0; k < 4; ++k) {
        n[k] = 0.25 * (1 + xi * corner_x[k]) * (1 + eta * corner_y[k]);
        dx[k] = 0.25 * corner_x[k] * (1 + eta * corner_y[k]);
        dy[k] = 0.25 * corner_y[k] * (1 + xi * corner_x[k]);
        r += n[k] * x[k].r;
        rx += dx[k] * x[k].r, ry += dy[k] * x[k].r;
        zx += dx[k] * x[k].z, zy += dy[k] * x[k].z;
      }
      const double det = rx * zy - ry * zx;
      if (!(det > 0)) fail("reference grid", "a cell is folded; use a smaller block or more cells");
      c.area += det;
      c.volume += 2 * M_PI * r * det;
      for (int k = 0; k < 4; ++k) {
        const double nr = dx[k] * zy - dy[k] * zx, nz = dy[k] * rx - dx[k] * ry;  // gradient times det
        c.mass[k] += 2 * M_PI * r * det * n[k];
        c.br[k] += 2 * M_PI * r * nr, c.bz[k] += 2 * M_PI * r * nz, c.bh[k] += 2 * M_PI * det * n[k];
        c.area_br[k] += nr, c.area_bz[k] += nz;
      }
    }
  for (int k = 0; k < 4; ++k) {
    c.br[k] /= c.volume, c.bz[k] /= c.volume, c.bh[k] /= c.volume;
    c.area_br[k] /= c.area, c.area_bz[k] /= c.area;
  }
  return c;
}

}  // namespace

Body mapped_body(const MappedGrid& grid, const Phase& phase, double hourglass_modulus)
{
  Reference b;
  b.resize_nodes(static_cast<int>(grid.nodes.size()), 2);
  b.resize_corners(static_cast<int>(grid.cells.size()), 4);
  b.regions = {{0, b.points, phase.moduli}};
  b.equator = grid.equator;
  for (int i = 0; i < b.nodes; ++i) b.place_i(i, 0) = grid.nodes[i].r, b.place_i(i, 1) = grid.nodes[i].z;

  CornerWeights<double>& w = b.corners.full;
  for (int p = 0; p < b.points; ++p) {
    std::array<MappedGrid::Node, 4> x;
    for (int k = 0; k < 4; ++k) x[k] = grid.nodes[grid.cells[p][k]];
    const CellIntegrals c = integrate(x);
    double h_r = 0, h_z = 0, gradient = 0;
    for (int k = 0; k < 4; ++k) {
      h_r += hourglass_sign[k] * x[k].r, h_z += hourglass_sign[k] * x[k].z;
      gradient += c.br[k] * c.br[k] + c.bz[k] * c.bz[k];
    }
    b.volume_p[p] = c.volume;
    // a modulus of G would come near the stiffness of full integration
    w.stiffness[p] = 0.25 * hourglass_modulus * c.volume * gradient;
    for (int k = 0; k < 4; ++k) {
      const int at = k * b.points + p, node = grid.cells[p][k];
      b.corners.node[at] = node;
      w.br[at] = c.br[k], w.bz[at] = c.bz[k], w.bh[at] = c.bh[k];
      w.hourglass[at] = hourglass_sign[k] - h_r * c.area_br[k] - h_z * c.area_bz[k];
      b.mass_i[node] += c.mass[k];
    }
  }
  const double meshed = std::accumulate(b.mass_i.begin(), b.mass_i.end(), 0.0);
  for (double& m : b.mass_i) m *= phase.density * grid.volume / meshed;

  Markers& surface = b.surface;
  surface.count = static_cast<int>(grid.surface.size()), surface.corners = 1;
  surface.lowest.assign(grid.surface.size(), 0), surface.weight.assign(grid.surface.size(), 1.0);
  surface.offset = grid.surface;
  for (const int i : grid.surface) surface.place.push_back({b.place_i(i, 0), 0, b.place_i(i, 1)});
  b.link(grid.axis);
  return Body(std::move(b));
}

}  // namespace granulaw
