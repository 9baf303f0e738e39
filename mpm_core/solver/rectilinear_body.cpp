#include "solver/rectilinear_body.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"

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
int phase_of(const Section& s, double r0, double r1, double z0, double z1)
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

}  // namespace

std::vector<Piece> cut_pieces(const Section& s, const SplineAxis& r_axis, const SplineAxis& z_axis)
{
  std::vector<Piece> pieces;
  const double g = 0.5 / std::sqrt(3.0);
  std::vector<PieceSum> sums;
  for (int c = 0; c < r_axis.cells(); ++c)
    for (int d = 0; d < z_axis.cells(); ++d)
      for (int quarter = 0; quarter < 4; ++quarter) {
        const double hr = 0.5 * (r_axis.lines()[c + 1] - r_axis.lines()[c]);
        const double hz = 0.5 * (z_axis.lines()[d + 1] - z_axis.lines()[d]);
        const double r0 = r_axis.lines()[c] + (quarter & 1) * hr;
        const double z0 = z_axis.lines()[d] + (quarter >> 1) * hz;
        const int whole = phase_of(s, r0, r0 + hr, z0, z0 + hz);
        if (whole == -1) continue;
        sums.clear();
        for (int p = 0; p < static_cast<int>(s.phases.size()); ++p) sums.emplace_back(p);
        if (whole >= 0) {
          for (const double x : {0.5 - g, 0.5 + g})
            for (const double y : {0.5 - g, 0.5 + g})
              sums[whole].add(r_axis, z_axis, r0 + x * hr, z0 + y * hz, 0.25 * hr * hz);
        } else {
          for (int i = 0; i < samples; ++i)
            for (int j = 0; j < samples; ++j) {
              const double r = r0 + (i + 0.5) / samples * hr, z = z0 + (j + 0.5) / samples * hz;
              const int phase = s.phase_at(r, z);
              if (phase >= 0) sums[phase].add(r_axis, z_axis, r, z, hr * hz / (samples * samples));
            }
        }
        for (const PieceSum& sum : sums)
          if (!sum.empty()) {
            pieces.push_back(sum.mean(c, d));
            pieces.back().r0 = r0, pieces.back().r1 = r0 + hr;
            pieces.back().z0 = z0, pieces.back().z1 = z0 + hz;
          }
      }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.phase < b.phase; });
  return pieces;
}

Surface section_markers(const Section& s, const SplineAxis& r_axis, int per_column)
{
  Surface surface;
  const auto add = [&](double r) {
    const double z = s.surface_z(r);
    if (r < 0.99 * s.radius && z < s.height) surface.r.push_back(r), surface.z.push_back(z);
  };
  add(0);
  for (int c = 0; c < r_axis.cells(); ++c)
    for (int k = 0; k < per_column; ++k)
      add(r_axis.lines()[c] + (k + 0.5) / per_column * (r_axis.lines()[c + 1] - r_axis.lines()[c]));
  surface.count = static_cast<int>(surface.r.size());
  return surface;
}

void weigh_markers(Surface& surface, const SplineAxis& r_axis, const SplineAxis& z_axis)
{
  surface.corners = 9;
  const std::size_t n = static_cast<std::size_t>(surface.count);
  surface.node.resize(9 * n), surface.weight.resize(9 * n);
  for (std::size_t m = 0; m < n; ++m) {
    const SplineAxis::Values nr = r_axis.at(surface.r[m]), nz = z_axis.at(surface.z[m]);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        surface.node[(3 * a + b) * n + m] = (nr.first + a) * z_axis.functions() + nz.first + b;
        surface.weight[(3 * a + b) * n + m] = nr.n[a] * nz.n[b];
      }
  }
}

std::vector<Region> regions_of(const std::vector<Phase>& phases, const std::vector<Piece>& pieces)
{
  std::vector<Region> regions;
  for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
    if (p == 0 || pieces[p].phase != pieces[p - 1].phase)
      regions.push_back({p, p, phases[pieces[p].phase].moduli});
    regions.back().end = p + 1;
  }
  return regions;
}

Body rectilinear_body(const Section& s)
{
  const SplineAxis r_axis(graded_lines(0, s.block, s.radius, s.fine, growth, coarsest, s.shift));
  const SplineAxis z_axis(graded_lines(0, s.depth, s.height, s.fine, growth, coarsest));
  const std::vector<Piece> pieces = cut_pieces(s, r_axis, z_axis);
  if (pieces.empty()) fail("reference grid", "no part of the body lies on it");

  // nodes that hold any mass, renumbered
  const int columns = z_axis.functions();
  std::vector<double> mass(std::size_t(r_axis.functions()) * columns, 0.0);
  for (const Piece& p : pieces)
    for (int k = 0; k < 9; ++k)
      mass[std::size_t(p.r_first + k / 3) * columns + p.z_first + k % 3] +=
          s.phases[p.phase].density * p.volume * p.n[k];
  std::vector<int> id(mass.size(), -1);
  int nodes = 0;
  for (std::size_t i = 0; i < mass.size(); ++i)
    if (mass[i] > 0) id[i] = nodes++;

  Body b;
  b.allocate(nodes, static_cast<int>(pieces.size()), 9);
  b.regions = regions_of(s.phases, pieces);
  const double sampled = std::accumulate(mass.begin(), mass.end(), 0.0);
  double total = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    if (id[i] < 0) continue;
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    b.r_i[id[i]] = r_axis.node(row), b.z_i[id[i]] = z_axis.node(column);
    total += b.mass_i[id[i]] = mass[i];
    if (row == 0) b.axis.push_back(id[i]);
    if (column == columns - 1) b.equator.push_back(id[i]);
  }
  for (double& m : b.mass_i) m *= (s.mass > 0 ? s.mass : sampled) / total;

  const int n = b.points;
  for (int p = 0; p < n; ++p) {
    const Piece& piece = pieces[p];
    b.volume_p[p] = piece.volume;
    for (int k = 0; k < 9; ++k) {
      const int at = k * n + p;
      b.corner_p[at] = id[std::size_t(piece.r_first + k / 3) * columns + piece.z_first + k % 3];
      b.br_p[at] = piece.br[k], b.bz_p[at] = piece.bz[k], b.bh_p[at] = piece.bh[k];
    }
  }
  const auto renumber = [&](Surface& surface) {
    weigh_markers(surface, r_axis, z_axis);
    for (std::size_t k = 0; k < surface.node.size(); ++k) {
      int& node = surface.node[k];
      node = id[node];
      if (node < 0) node = 0, surface.weight[k] = 0;  // a function of no mass: zero there but for rounding
    }
  };
  b.surface = section_markers(s, r_axis, 1);
  renumber(b.surface);
  for (const auto& [r, z] : s.pore_walls) b.pore_walls.r.push_back(r), b.pore_walls.z.push_back(z);
  b.pore_walls.count = static_cast<int>(s.pore_walls.size());
  renumber(b.pore_walls);
  if (s.onto_body) {
    for (int k = 0; k < 4; ++k)
      for (const Piece& piece : pieces) {
        const auto [r, z] = s.onto_body(k == 0 || k == 3 ? piece.r0 : piece.r1, k < 2 ? piece.z0 : piece.z1);
        b.outline.r.push_back(r), b.outline.z.push_back(z);
      }
    b.outline.count = static_cast<int>(b.outline.r.size());
    renumber(b.outline);
  }
  b.link();
  return b;
}

}  // namespace granulaw
