#include "solver/grid/rectilinear_body.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "base/gauss.hpp"

namespace granulaw {

namespace {

constexpr double growth = 1.15, coarsest = 0.15;
constexpr int samples = 8;  // each way, of a quarter that is cut

/// Sums a piece up from points of weight `area`.
class PieceSum
{
 public:
  explicit PieceSum(int phase) : piece_{} { piece_.phase = phase; }

  void add(const SplineAxis& r_axis, const SplineAxis& z_axis, double r, double z, double area)
  {
    const SplineAxis::Values nr = r_axis.at(r), nz = z_axis.at(z);
    const double ring = 2 * M_PI * r * area;
    piece_.volume += ring;
    piece_.r += ring * r, piece_.z += ring * z;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const int k = 3 * a + b;
        piece_.n[k] += ring * nr.n[a] * nz.n[b];
        piece_.br[k] += ring * nr.dn[a] * nz.n[b];
        piece_.bz[k] += ring * nr.n[a] * nz.dn[b];
        piece_.bh[k] += 2 * M_PI * area * nr.n[a] * nz.n[b];
      }
  }
  bool empty() const { return piece_.volume <= 0; }
  Piece mean(int r_first, int z_first) const
  {
    Piece p = piece_;
    p.r_first = r_first, p.z_first = z_first;
    p.r /= p.volume, p.z /= p.volume;
    for (auto* field : {&p.n, &p.br, &p.bz, &p.bh})
      for (double& value : *field) value /= p.volume;
    return p;
  }

 private:
  Piece piece_;
};

/// The phase of a rectangle if its corners, edges and middle agree; -2 if they do not.
int phase_of(const CutSection& s, double r0, double r1, double z0, double z1)
{
  int phase = -2;
  for (const double r : {r0, 0.5 * (r0 + r1), r1})
    for (const double z : {z0, 0.5 * (z0 + z1), z1}) {
      // a hair inside, so that lines lying on the surface do not count as cut
      const double x = 0.5 * (r0 + r1) + 0.999999 * (r - 0.5 * (r0 + r1));
      const double y = 0.5 * (z0 + z1) + 0.999999 * (z - 0.5 * (z0 + z1));
      const int here = s.phase_at(x, y);
      if (phase == -2) phase = here;
      if (here != phase) return -2;
    }
  return phase;
}

/// Lower left corner and sides.
struct Rectangle
{
  double r, z, hr, hz;
};

/// The left or right, lower or upper quarter of cell (c, d).
Rectangle quarter_of(const SplineAxis& r_axis, int c, int right, const SplineAxis& z_axis, int d, int upper)
{
  const double hr = 0.5 * (r_axis.lines()[c + 1] - r_axis.lines()[c]);
  const double hz = 0.5 * (z_axis.lines()[d + 1] - z_axis.lines()[d]);
  return {r_axis.lines()[c] + right * hr, z_axis.lines()[d] + upper * hz, hr, hz};
}

/// Content of a quarter, by phase: by 2 x 2 Gauss points if it is whole, by a raster if it is cut;
/// nothing if it lies outside the body.
std::vector<PieceSum> sums_over(const CutSection& s, const Rectangle& q, const SplineAxis& r_axis,
                                const SplineAxis& z_axis)
{
  const int whole = phase_of(s, q.r, q.r + q.hr, q.z, q.z + q.hz);
  if (whole == -1) return {};
  std::vector<PieceSum> sums;
  for (int p = 0; p < static_cast<int>(s.phases.size()); ++p) sums.emplace_back(p);
  if (whole >= 0) {
    for (const double x : GaussPoints<2>::node)
      for (const double y : GaussPoints<2>::node)
        sums[whole].add(r_axis, z_axis, q.r + (0.5 + 0.5 * x) * q.hr, q.z + (0.5 + 0.5 * y) * q.hz,
                        0.25 * q.hr * q.hz);
    return sums;
  }
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      const double r = q.r + (i + 0.5) / samples * q.hr, z = q.z + (j + 0.5) / samples * q.hz;
      const int phase = s.phase_at(r, z);
      if (phase >= 0) sums[phase].add(r_axis, z_axis, r, z, q.hr * q.hz / (samples * samples));
    }
  return sums;
}

}  // namespace

std::vector<Piece> cut_pieces(const CutSection& s, const SplineAxis& r_axis, const SplineAxis& z_axis)
{
  std::vector<Piece> pieces;
  for (int c = 0; c < r_axis.cells(); ++c)
    for (int d = 0; d < z_axis.cells(); ++d)
      for (int quarter = 0; quarter < 4; ++quarter) {
        const Rectangle where = quarter_of(r_axis, c, quarter & 1, z_axis, d, quarter >> 1);
        for (const PieceSum& sum : sums_over(s, where, r_axis, z_axis)) {
          if (sum.empty()) continue;
          Piece piece = sum.mean(c, d);
          piece.r0 = where.r, piece.r1 = where.r + where.hr;
          piece.z0 = where.z, piece.z1 = where.z + where.hz;
          pieces.push_back(piece);
        }
      }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.phase < b.phase; });
  return pieces;
}

Markers section_markers(const CutSection& s, const SplineAxis& r_axis, int per_column)
{
  Markers surface;
  const auto add = [&](double r) {
    const double z = s.surface_z(r);
    if (r < 0.99 * s.radius && z < s.height) surface.place.push_back({r, 0, z});
  };
  add(0);
  for (int c = 0; c < r_axis.cells(); ++c)
    for (int k = 0; k < per_column; ++k)
      add(r_axis.lines()[c] + (k + 0.5) / per_column * (r_axis.lines()[c + 1] - r_axis.lines()[c]));
  surface.count = static_cast<int>(surface.place.size());
  return surface;
}

std::vector<Region> regions_of(const std::vector<Phase>& phases, const std::vector<Piece>& pieces)
{
  std::vector<Region> regions;
  for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
    if (p == 0 || pieces[p].phase != pieces[p - 1].phase)
      regions.push_back({p, p, phases[pieces[p].phase].moduli, pieces[p].phase});
    regions.back().end = p + 1;
  }
  return regions;
}

namespace {

/// The nodes that hold any mass, numbered along the columns of the grid.
struct MassNodes
{
  int columns;               ///< nodes in a column of the grid
  std::vector<double> mass;  ///< of every node of the grid
  std::vector<int> id;       ///< its number in the body; -1: it holds none
  int count = 0;

  MassNodes(const CutSection& s, const std::vector<Piece>& pieces, const SplineAxis& r_axis,
            const SplineAxis& z_axis)
      : columns(z_axis.functions()), mass(std::size_t(r_axis.functions()) * columns, 0.0), id(mass.size(), -1)
  {
    for (const Piece& p : pieces)
      for (int k = 0; k < 9; ++k) mass[corner(p, k)] += s.phases[p.phase].density * p.volume * p.n[k];
    for (std::size_t i = 0; i < mass.size(); ++i)
      if (mass[i] > 0) id[i] = count++;
  }
  /// Node k of the nine whose functions reach a piece.
  std::size_t corner(const Piece& p, int k) const
  {
    return std::size_t(p.r_first + k / 3) * columns + p.z_first + k % 3;
  }
};

/// Places and masses of the nodes; the masses sum up to `exact_mass`, if that is over 0. Returns the nodes on
/// the axis.
std::vector<int> set_nodes(Reference& b, const MassNodes& nodes, const SplineAxis& r_axis,
                           const SplineAxis& z_axis, double exact_mass)
{
  std::vector<int> axis;
  double total = 0;
  for (std::size_t i = 0; i < nodes.mass.size(); ++i) {
    const int node = nodes.id[i];
    if (node < 0) continue;
    const int row = static_cast<int>(i) / nodes.columns, column = static_cast<int>(i) % nodes.columns;
    b.place_i(node, 0) = r_axis.node(row), b.place_i(node, 1) = z_axis.node(column);
    total += b.mass_i[node] = nodes.mass[i];
    if (row == 0) axis.push_back(node);
    if (column == nodes.columns - 1) b.equator.push_back(node);
  }
  const double sampled = std::accumulate(nodes.mass.begin(), nodes.mass.end(), 0.0);
  for (double& m : b.mass_i) m *= (exact_mass > 0 ? exact_mass : sampled) / total;
  return axis;
}

/// Volumes, corners and weights of the points.
void set_points(Reference& b, const MassNodes& nodes, const std::vector<Piece>& pieces)
{
  const int n = b.points;
  for (int p = 0; p < n; ++p) {
    const Piece& piece = pieces[p];
    b.volume_p[p] = piece.volume;
    for (int k = 0; k < 9; ++k) {
      const int at = k * n + p;
      b.corners.node[at] = nodes.id[nodes.corner(piece, k)];
      CornerWeights<double>& w = b.corners.full;
      w.br[at] = piece.br[k], w.bz[at] = piece.bz[k], w.bh[at] = piece.bh[k];
    }
  }
}

/// Places on opposite walls of the pores.
Markers pore_wall_markers(const CutSection& s)
{
  Markers walls;
  for (const auto& [r, z] : s.pore_walls) walls.place.push_back({r, 0, z});
  walls.count = static_cast<int>(s.pore_walls.size());
  return walls;
}

/// Corners of the pieces as they are drawn: all first corners, all second ones, ...
Markers corner_markers(const CutSection& s, const std::vector<Piece>& pieces)
{
  Markers outline;
  for (int k = 0; k < 4; ++k)
    for (const Piece& piece : pieces) {
      const auto [r, z] = s.onto_body(k == 0 || k == 3 ? piece.r0 : piece.r1, k < 2 ? piece.z0 : piece.z1);
      outline.place.push_back({r, 0, z});
    }
  outline.count = static_cast<int>(outline.place.size());
  return outline;
}

}  // namespace

Body rectilinear_body(const CutSection& s)
{
  const SplineAxis r_axis(graded_lines(0, s.block, s.radius, s.fine, growth, coarsest, s.shift));
  const SplineAxis z_axis(graded_lines(0, s.depth, s.height, s.fine, growth, coarsest));
  const std::vector<Piece> pieces = cut_pieces(s, r_axis, z_axis);
  if (pieces.empty()) fail("reference grid", "no part of the body lies on it");
  const MassNodes nodes(s, pieces, r_axis, z_axis);

  Reference b;
  b.resize_nodes(nodes.count, 2), b.resize_corners(static_cast<int>(pieces.size()), 9);
  b.regions = regions_of(s.phases, pieces);
  const std::vector<int> axis = set_nodes(b, nodes, r_axis, z_axis, s.mass);
  set_points(b, nodes, pieces);

  const auto weighed = [&](Markers markers) {
    weigh_markers(markers, r_axis, z_axis);
    for (std::size_t k = 0; k < markers.offset.size(); ++k) {
      int& node = markers.offset[k];
      node = nodes.id[node];
      if (node < 0) node = 0, markers.weight[k] = 0;  // a function of no mass: zero there but for rounding
    }
    return markers;
  };
  b.surface = weighed(section_markers(s, r_axis, 1));
  b.pore_walls = weighed(pore_wall_markers(s));
  if (s.onto_body) b.drawn = weighed(corner_markers(s, pieces));
  b.link(axis);
  return Body(std::move(b));
}

}  // namespace granulaw
