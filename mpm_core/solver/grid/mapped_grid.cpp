#include "solver/grid/mapped_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace granulaw {

namespace {

struct Zeta
{
  double x, y;
};  // x along the axis of symmetry, y along the surface

MappedGrid::Node to_sphere(Zeta q)
{
  const double d = (1 + q.x) * (1 + q.x) + q.y * q.y;
  return {2 * q.y / d, 2 * (q.x + q.x * q.x + q.y * q.y) / d};
}

/// Half-way between the unit square and the quarter disc, so that the corner cell opens to 135 degrees.
Zeta rounded_square(double x, double y)
{
  constexpr double roundness = 0.5;
  const double fx = 1 - roundness + roundness * std::sqrt(1 - 0.5 * y * y);
  const double fy = 1 - roundness + roundness * std::sqrt(1 - 0.5 * x * x);
  return {x * fx, y * fy};
}

/// One half of the section: block and rings out to |zeta| = 1. Index of a ring point is m = 0 (surface)
/// to 2N (axis); ring 0 is the block's rim.
struct Half
{
  int n;
  std::vector<Zeta> points;
  std::vector<std::vector<int>> rings;  // [ring][m] -> point
  std::vector<std::vector<int>> block;  // [i along x][j along y] -> point

  Half(int cells_across, double block_zeta, double coarsening, double shift) : n(cells_across)
  {
    block.assign(n + 1, std::vector<int>(n + 1));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double along = j == 0 ? 0.0 : (j - shift) / (n - shift);
        const Zeta q = rounded_square(double(i) / n, along);
        block[i][j] = add({block_zeta * q.x, block_zeta * q.y});
      }
    std::vector<int> rim;
    for (int i = 0; i <= n; ++i) rim.push_back(block[i][n]);      // along the outer side, from the surface
    for (int j = n - 1; j >= 0; --j) rim.push_back(block[n][j]);  // and down to the axis
    rings.push_back(rim);

    // Logarithmic spacing: square cells at the rim, twice as long as wide at the mid-plane.
    const double span = -std::log(block_zeta), angle = M_PI / 2 / (2 * n);
    std::vector<double> at{0.0};
    while (at.back() < span) at.push_back(at.back() + coarsening * angle * (1 + at.back() / span));
    const int count = std::max(2, static_cast<int>(at.size()) - 1);
    if (static_cast<int>(at.size()) - 1 < count) at = {0, span / 2, span};
    const double scale = span / at.back();
    for (int k = 1; k <= count; ++k) {
      const double depth = at[k] * scale;
      // The rim's rounded square turns into a circle over the distance of one block size.
      const double t = std::min(1.0, depth / std::min(span, 0.7));
      const double blend = k == count ? 1.0 : t * t * (3 - 2 * t);
      std::vector<int> ring;
      for (int m = 0; m <= 2 * n; ++m) {
        const Zeta p = points[rim[m]];
        const double rim_radius = std::log(std::hypot(p.x, p.y) / block_zeta);
        const double radius =
            k == count ? 1.0 : block_zeta * std::exp(depth + rim_radius * (1 - depth / span) * (1 - blend));
        const double phi = (1 - blend) * std::atan2(p.x, p.y) + blend * angle * m;
        Zeta q{radius * std::sin(phi), radius * std::cos(phi)};
        if (m == 0) q.x = 0;
        if (m == 2 * n) q.y = 0;
        ring.push_back(add(q));
      }
      rings.push_back(ring);
    }
  }

  int add(Zeta q)
  {
    points.push_back(q);
    return static_cast<int>(points.size()) - 1;
  }
};

/// Adds the cells of a half to the grid, its points carried to the section by `place`, its outermost ring
/// glued to the nodes `glue`; returns the nodes of its points.
template <class Place>
std::vector<int> append(MappedGrid& grid, const Half& half, bool mirrored, const std::vector<int>* glue,
                        Place place)
{
  std::vector<int> id(half.points.size(), -1);
  if (glue)
    for (std::size_t m = 0; m < glue->size(); ++m) id[half.rings.back()[m]] = (*glue)[m];
  for (std::size_t p = 0; p < half.points.size(); ++p) {
    if (id[p] >= 0) continue;
    id[p] = static_cast<int>(grid.nodes.size());
    grid.nodes.push_back(place(half.points[p]));
  }
  const auto quad = [&](int a, int b, int c, int d) {
    std::array<int, 4> q{id[a], id[b], id[c], id[d]};
    if (mirrored) std::swap(q[1], q[3]);
    grid.cells.push_back(q);
  };
  const int n = half.n;
  for (int i = 0; i < n; ++i)  // x grows upwards (z), y outwards (r)
    for (int j = 0; j < n; ++j)
      quad(half.block[i][j], half.block[i][j + 1], half.block[i + 1][j + 1], half.block[i + 1][j]);
  for (std::size_t k = 0; k + 1 < half.rings.size(); ++k)
    for (int m = 0; m < 2 * n; ++m)
      quad(half.rings[k][m], half.rings[k + 1][m], half.rings[k + 1][m + 1], half.rings[k][m + 1]);
  return id;
}

/// Lists the nodes of the lower surface, the outermost ring and the axis.
void list_edges(MappedGrid& grid, const Half& near, const std::vector<int>& id)
{
  for (int j = 0; j <= near.n; ++j) grid.surface.push_back(id[near.block[0][j]]);
  for (std::size_t k = 1; k < near.rings.size(); ++k) grid.surface.push_back(id[near.rings[k][0]]);
  for (const int p : near.rings.back()) grid.equator.push_back(id[p]);
}

void list_axis(MappedGrid& grid)
{
  for (std::size_t p = 0; p < grid.nodes.size(); ++p)
    if (grid.nodes[p].r == 0.0) grid.axis.push_back(static_cast<int>(p));
}

}  // namespace

MappedGrid MappedGrid::build(int cells_across, double block, bool full, double shift)
{
  assert(cells_across >= 4 && block > 0 && block <= 0.95 && shift > -1 && shift < 1);
  MappedGrid grid;
  // Surface radius r of zeta = i y is 2 y/(1 + y^2); invert for the block's edge.
  // The shift takes its part of a cell off the block's edge, so that all lines but the pole move alike.
  // Blocks that reach farther than 0.95 R fold the cells between their corner and the mid-plane.
  block = std::min(block, 0.95 / (1 + 0.5 / cells_across));
  const double shifted = block * (1 - shift / cells_across);
  const double block_zeta = shifted / (1 + std::sqrt(1 - shifted * shifted));
  const Half near(cells_across, block_zeta, 1.25, shift);
  const std::vector<int> id = append(grid, near, false, nullptr, to_sphere);
  list_edges(grid, near, id);
  if (full)
    append(grid, Half(cells_across, std::max(0.5, block_zeta), 2.5, 0.0), true, &grid.equator, [](Zeta q) {
      Node node = to_sphere(q);
      node.z = 2 - node.z;
      return node;
    });
  list_axis(grid);
  grid.volume = (full ? 4.0 : 2.0) / 3.0 * M_PI;
  return grid;
}

MappedGrid MappedGrid::wall(int cells_across, double block, double extent, double shift)
{
  assert(cells_across >= 4 && block > 0 && block < extent && shift > -1 && shift < 1);
  MappedGrid grid;
  const Half near(cells_across, block * (1 - shift / cells_across) / extent, 1.25, shift);
  const std::vector<int> id = append(grid, near, false, nullptr, [&](Zeta q) {
    return Node{extent * q.y, extent * q.x};
  });
  list_edges(grid, near, id);
  list_axis(grid);
  grid.volume = 2.0 / 3.0 * M_PI * extent * extent * extent;
  return grid;
}

void MappedGrid::scale(double factor)
{
  for (Node& node : nodes) node.r *= factor, node.z *= factor;
  volume *= factor * factor * factor;
}

}  // namespace granulaw
