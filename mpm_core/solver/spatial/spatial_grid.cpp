#include "solver/spatial/spatial_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// Halvings of an octant that is cut.
constexpr int levels = 2;
/// Pieces of less than this share of an octant are left out.
constexpr double least_share = 1e-6;
/// Shares of a sub-box below which its patch of the surface is not worth a marker's place.
constexpr double on_surface = 1e-3;

/// The three splines that reach into a cell as polynomials of xi = (x - middle)/edge, -1/2 to 1/2.
struct CellSplines
{
  double middle, edge;
  double left, right;  ///< as in AxisWeights
  double n[3][3];      ///< spline, power

  CellSplines(const SplineAxis& axis, int cell)
  {
    const std::vector<double>& t = axis.lines();
    const int last = axis.cells() - 1;
    edge = t[cell + 1] - t[cell], middle = 0.5 * (t[cell] + t[cell + 1]);
    left = edge / (t[cell + 1] - (cell > 0 ? t[cell - 1] : t[cell]));
    right = edge / ((cell < last ? t[cell + 2] : t[cell + 1]) - t[cell]);
    const double lower[3] = {0.25 * left, -left, left}, upper[3] = {0.25 * right, right, right};
    for (int m = 0; m < 3; ++m) {
      n[0][m] = lower[m], n[2][m] = upper[m];
      n[1][m] = (m == 0 ? 1.0 : 0.0) - lower[m] - upper[m];
    }
  }
};

/// Means over one half of the cell.
AxisWeights axis_weights(const CellSplines& s, int direction)
{
  AxisWeights w{};
  w.per_edge = 1 / s.edge, w.left = s.left, w.right = s.right;
  for (int octant = 0; octant < octants; ++octant) {
    const bool upper = octant >> (2 - direction) & 1;
    const double xi = upper ? 0.25 : -0.25, xi2 = xi * xi + 0.25 / 12;
    for (int a = 0; a < 3; ++a) {
      w.n[a][octant] = s.n[a][0] + s.n[a][1] * xi + s.n[a][2] * xi2;
      w.dn[a][octant] = (s.n[a][1] + 2 * s.n[a][2] * xi) / s.edge;
    }
  }
  return w;
}

/// Integrals of xi^l eta^m zeta^n over a piece of a cell, l, m, n up to 2, over the cell's volume.
struct Moments
{
  double value[27]{};

  double volume() const { return value[0]; }
  /// Adds `share` of a box at `centre` with `edges`, both in the cell's coordinates.
  void add(const Vector3& centre, const Vector3& edges, double share)
  {
    const double volume = share * edges.prod();
    double power[3][3];
    for (int d = 0; d < 3; ++d) {
      power[d][0] = 1, power[d][1] = centre[d];
      power[d][2] = centre[d] * centre[d] + edges[d] * edges[d] / 12;
    }
    for (int k = 0; k < 27; ++k) value[k] += volume * power[0][k / 9] * power[1][k / 3 % 3] * power[2][k % 3];
  }
  /// Integral of the product of three polynomials, one in each coordinate.
  double of(const double (&x)[3], const double (&y)[3], const double (&z)[3]) const
  {
    double sum = 0;
    for (int k = 0; k < 27; ++k) sum += x[k / 9] * y[k / 3 % 3] * z[k % 3] * value[k];
    return sum;
  }
};

/// What an octant holds: moments of each phase, and the middle of its patch of the outer surface.
struct OctantContent
{
  std::vector<Moments> phases;
  Vector3 patch = Vector3::Zero();
  double patch_weight = 0, patch_area = 0;
};

/// Cuts the octants of one cell.
class CellCutter
{
 public:
  CellCutter(const SpatialSection& section, const std::array<const CellSplines*, 3>& splines)
      : section_(section)
  {
    for (int d = 0; d < 3; ++d) middle_[d] = splines[d]->middle, edge_[d] = splines[d]->edge;
  }

  /// The phase that fills the whole cell; -1: it lies outside, -2: neither.
  int whole_phase() const
  {
    const double depth = section_.depth(middle_), reach = 0.5 * edge_.norm();
    if (depth <= -reach) return -1;
    return depth >= reach ? phase_of_whole(middle_, reach) : -2;
  }

  OctantContent octant(int k)
  {
    content_ = {};
    content_.phases.resize(section_.phases.size());
    const Vector3 sign(k & 4 ? 1 : -1, k & 2 ? 1 : -1, k & 1 ? 1 : -1);
    divide(middle_ + 0.25 * sign.cwiseProduct(edge_), 0.5 * edge_, levels);
    if (content_.patch_weight > 0) content_.patch /= content_.patch_weight;
    return std::move(content_);
  }

 private:
  /// -2: an interface passes through the ball of radius `reach` about x.
  int phase_of_whole(const Vector3& x, double reach) const
  {
    if (!section_.phase_at) return 0;
    return section_.interface_distance(x) >= reach ? section_.phase_at(x) : -2;
  }

  void divide(const Vector3& x, const Vector3& edges, int left)
  {
    const double depth = section_.depth(x), reach = 0.5 * edges.norm();
    if (depth <= -reach) return;
    const int phase = depth >= reach ? phase_of_whole(x, reach) : -2;
    if (phase != -2) return add(phase, x, edges, 1);
    if (left == 0) return add_cut(x, edges, depth);
    for (int k = 0; k < octants; ++k) {
      const Vector3 sign(k & 4 ? 1 : -1, k & 2 ? 1 : -1, k & 1 ? 1 : -1);
      divide(x + 0.25 * sign.cwiseProduct(edges), 0.5 * edges, left - 1);
    }
  }

  /// The share of a small box on the inner side of the tangent plane: exact where the plane lies along two
  /// axes, without bias elsewhere.
  void add_cut(const Vector3& x, const Vector3& edges, double depth)
  {
    const Vector3 normal = section_.normal(x);
    const double width = normal.cwiseAbs().dot(edges);
    const double share = std::clamp(0.5 + depth / width, 0.0, 1.0);
    const Vector3 inside = x + std::min(0.0, depth) * normal;
    add(section_.phase_at ? section_.phase_at(inside) : 0, x, edges, share);
    if (share < on_surface || share > 1 - on_surface) return;
    const double weight = share * (1 - share);
    content_.patch += weight * (x + depth * normal);
    content_.patch_weight += weight;
    content_.patch_area += edges.prod() / width;  // the share falls from 1 to 0 over the width
  }

  void add(int phase, const Vector3& x, const Vector3& edges, double share)
  {
    if (phase < 0 || share <= 0) return;
    content_.phases[phase].add((x - middle_).cwiseQuotient(edge_), edges.cwiseQuotient(edge_), share);
  }

  const SpatialSection& section_;
  Vector3 middle_, edge_;
  OctantContent content_;
};

/// Builds a body cell by cell.
class Builder
{
 public:
  explicit Builder(const SpatialSection& section) : section_(section)
  {
    for (int d = 0; d < 3; ++d) {
      body_.axes[d] = SplineAxis(section.lines[d]);
      for (int c = 0; c < body_.axes[d].cells(); ++c) {
        splines_[d].emplace_back(body_.axes[d], c);
        body_.axis_weights[d].push_back(axis_weights(splines_[d].back(), d));
      }
    }
    body_.mirrored = section.mirrored;
    body_.allocate_nodes();
    filled_.resize(section.phases.size()), cut_.resize(section.phases.size());
  }

  SpatialBody build()
  {
    for (int z = 0; z < body_.axes[2].cells(); ++z)
      for (int y = 0; y < body_.axes[1].cells(); ++y)
        for (int x = 0; x < body_.axes[0].cells(); ++x) take_cell({x, y, z});
    join_cells();
    set_masses();
    set_surface();
    if (section_.drawn) set_corners();
    return std::move(body_);
  }

 private:
  struct CutCell
  {
    SpatialCell cell;
    std::array<Moments, octants> moments;
  };
  using Column = std::array<int, 3>;
  struct Patch
  {
    Vector3 middle;
    double area;
  };

  std::array<const CellSplines*, 3> splines(const Column& c) const
  {
    return {&splines_[0][c[0]], &splines_[1][c[1]], &splines_[2][c[2]]};
  }
  double volume(const Column& c) const
  {
    return splines_[0][c[0]].edge * splines_[1][c[1]].edge * splines_[2][c[2]].edge;
  }

  void take_cell(const Column& column)
  {
    const std::array<int, 3> stride = body_.strides();
    const SpatialCell cell{column[0] + column[1] * stride[1] + column[2] * stride[2], column, -1};
    CellCutter cutter(section_, splines(column));
    const int whole = cutter.whole_phase();
    if (whole == -1) return;
    if (whole >= 0) return filled_[whole].push_back(cell);
    std::vector<CutCell> found(section_.phases.size(), CutCell{cell, {}});
    std::vector<double> held(section_.phases.size(), 0.0);
    for (int k = 0; k < octants; ++k) {
      OctantContent content = cutter.octant(k);
      bool any = false;
      for (std::size_t p = 0; p < found.size(); ++p) {
        if (content.phases[p].volume() < least_share / octants) continue;
        found[p].moments[k] = content.phases[p];
        held[p] += content.phases[p].volume();
        any = true;
      }
      if (any && content.patch_weight > 0) patches_.push_back({content.patch, content.patch_area});
    }
    for (std::size_t p = 0; p < found.size(); ++p) {
      if (held[p] >= 1 - 1e-12)
        filled_[p].push_back(cell);
      else if (held[p] > 0)
        cut_[p].push_back(found[p]);
    }
  }

  void join_cells()
  {
    std::size_t cut_cells = 0;
    for (std::size_t p = 0; p < section_.phases.size(); ++p) {
      if (filled_[p].empty() && cut_[p].empty()) continue;
      const int begin = static_cast<int>(body_.cells.size());
      body_.cells.insert(body_.cells.end(), filled_[p].begin(), filled_[p].end());
      for (CutCell& c : cut_[p]) {
        c.cell.cut = static_cast<int>(cut_cells++);
        body_.cells.push_back(c.cell);
      }
      body_.regions.push_back(
          {begin, static_cast<int>(body_.cells.size()), section_.phases[p].moduli, static_cast<int>(p)});
    }
    if (body_.cells.empty()) fail("reference grid", "no part of the body lies on it");
    body_.cut_moments.assign(cut_cells * cut_moments_each * octants, 0.0);
    body_.allocate_points();
    int at = 0;
    for (std::size_t p = 0; p < section_.phases.size(); ++p) {
      for (const SpatialCell& c : filled_[p]) fill_cell(at++, c, section_.phases[p].density);
      for (const CutCell& c : cut_[p]) cut_cell(at++, c, section_.phases[p].density);
    }
  }

  int node(const SpatialCell& cell, int k) const
  {
    const std::array<int, 3> stride = body_.strides();
    return cell.node + k / 9 + k / 3 % 3 * stride[1] + k % 3 * stride[2];
  }

  void fill_cell(int at, const SpatialCell& cell, double density)
  {
    const double piece = volume(cell.column) / octants;
    for (int lane = 0; lane < octants; ++lane) body_.volume_p[octants * at + lane] = piece;
    body_.points += octants;
    Moments whole;
    whole.add(Vector3::Zero(), Vector3::Ones(), 1);
    add_mass(cell, whole, density);
  }

  void add_mass(const SpatialCell& cell, const Moments& moments, double density)
  {
    const auto s = splines(cell.column);
    for (int k = 0; k < cell_nodes; ++k)
      body_.mass_i[node(cell, k)] +=
          density * volume(cell.column) * moments.of(s[0]->n[k / 9], s[1]->n[k / 3 % 3], s[2]->n[k % 3]);
  }

  void cut_cell(int at, const CutCell& c, double density)
  {
    double* moments =
        body_.cut_moments.data() + std::size_t(body_.cells[at].cut) * cut_moments_each * octants;
    for (int lane = 0; lane < octants; ++lane) {
      const Moments& m = c.moments[lane];
      if (m.volume() <= 0) continue;
      ++body_.points;
      body_.volume_p[octants * at + lane] = volume(c.cell.column) * m.volume();
      add_mass(c.cell, m, density);
      for (int k = 0; k < cut_moments_each; ++k) {
        const double halves = (k / 9 == 2 ? 0.5 : 1) * (k / 3 % 3 == 2 ? 0.5 : 1) * (k % 3 == 2 ? 0.5 : 1);
        moments[k * octants + lane] = halves * m.value[k] / m.volume();
      }
    }
  }

  void set_masses()
  {
    const double sampled = std::accumulate(body_.mass_i.begin(), body_.mass_i.end(), 0.0);
    body_.mass = section_.mass > 0 ? section_.mass : sampled;
    for (int i = 0; i < body_.nodes; ++i) {
      double& mass = body_.mass_i[i];
      mass *= body_.mass / sampled;
      if (mass <= 0) continue;
      const int place[3] = {i % body_.count[0], i / body_.count[0] % body_.count[1],
                            i / (body_.count[0] * body_.count[1])};
      for (int d = 0; d < 3; ++d)
        body_.inverse_mass_i[4 * i + d] = section_.mirrored[d] && place[d] == 0 ? 0.0 : 1 / mass;
    }
  }

  /// One marker for each patch: with fewer the force swings with every cell that closes (one a cell: ripple
  /// twice to three times as large, force 9 % off), with more the impulses are not unique.
  void set_surface()
  {
    SpatialSurface& s = body_.surface;
    for (auto& [x, area] : patches_) {
      for (int n = 0; n < 3; ++n) x += section_.depth(x) * section_.normal(x);
      for (int d = 0; d < 3; ++d)
        x[d] = std::clamp(x[d], section_.lines[d].front(), section_.lines[d].back());
      add_marker(s, x);
      s.area.push_back(area);
    }
    s.count = static_cast<int>(s.place.size());
  }

  void set_corners()
  {
    const std::array<int, 3> lines{body_.axes[0].cells() + 1, body_.axes[1].cells() + 1,
                                   body_.axes[2].cells() + 1};
    std::vector<int> known(std::size_t(lines[0]) * lines[1] * lines[2], -1);
    for (const SpatialCell& cell : body_.cells) {
      std::array<int, 8> drawn{};
      for (int k = 0; k < 8; ++k) {
        const int x = cell.column[0] + (k % 4 == 1 || k % 4 == 2), y = cell.column[1] + (k % 4 > 1),
                  z = cell.column[2] + k / 4;
        int& corner = known[(std::size_t(z) * lines[1] + y) * lines[0] + x];
        if (corner < 0) {
          corner = static_cast<int>(body_.corners.place.size());
          Vector3 place(section_.lines[0][x], section_.lines[1][y], section_.lines[2][z]);
          for (int n = 0; n < 3; ++n) place += std::min(0.0, section_.depth(place)) * section_.normal(place);
          for (int d = 0; d < 3; ++d)
            place[d] = std::clamp(place[d], section_.lines[d].front(), section_.lines[d].back());
          add_marker(body_.corners, place);
        }
        drawn[k] = corner;
      }
      body_.drawn_cells.push_back(drawn);
    }
    body_.corners.count = static_cast<int>(body_.corners.place.size());
  }

  void add_marker(SpatialSurface& s, const Vector3& x)
  {
    SplineAxis::Values v[3];
    for (int d = 0; d < 3; ++d) {
      v[d] = body_.axes[d].at(x[d]);
      if (s.finest == 0) s.finest = splines_[d][v[d].first].edge;
      s.finest = std::min(s.finest, splines_[d][v[d].first].edge);
    }
    const std::array<int, 3> stride = body_.strides();
    const int lowest = v[0].first + v[1].first * stride[1] + v[2].first * stride[2];
    s.place.push_back({x[0], x[1], x[2]});
    s.node.push_back(lowest);
    for (int k = 0; k < cell_nodes; ++k) {
      const bool held = body_.mass_i[lowest + k / 9 + k / 3 % 3 * stride[1] + k % 3 * stride[2]] > 0;
      s.weight.push_back(held ? v[0].n[k / 9] * v[1].n[k / 3 % 3] * v[2].n[k % 3] : 0.0);
    }
  }

  const SpatialSection& section_;
  SpatialBody body_;
  std::array<std::vector<CellSplines>, 3> splines_;
  std::vector<std::vector<SpatialCell>> filled_;  ///< by phase
  std::vector<std::vector<CutCell>> cut_;
  std::vector<Patch> patches_;
};

}  // namespace

SpatialBody spatial_body(const SpatialSection& section)
{
  return Builder(section).build();
}

std::vector<double> graded_axis(double low, double high, const std::vector<FineZone>& zones, double coarsest,
                                double shift, bool mirrored)
{
  // Cells of 15 % growth: the edge gains 0.15/1.15 of the way.
  constexpr double slope = 0.13;
  constexpr int samples = 4000;
  const auto edge = [&](double x) {
    double least = coarsest;
    for (const FineZone& z : zones)
      least = std::min(least, z.edge + slope * std::max({0.0, z.low - x, x - z.high}));
    return least;
  };
  // index of the line at x, a real number: integral of dx/edge
  std::vector<double> place(samples + 1), index(samples + 1, 0.0);
  for (int k = 0; k <= samples; ++k) place[k] = low + (high - low) * k / samples;
  for (int k = 1; k <= samples; ++k)
    index[k] = index[k - 1] + (place[k] - place[k - 1]) / edge(0.5 * (place[k] + place[k - 1]));
  const double cells = std::ceil(index.back() - 1e-9), step = index.back() / cells;
  const auto line = [&](double at) {
    at *= step;
    if (at <= 0) return low + at * edge(low);
    if (at >= index.back()) return high + (at - index.back()) * edge(high);
    const auto above = std::upper_bound(index.begin(), index.end(), at);
    const std::size_t k = static_cast<std::size_t>(above - index.begin()) - 1;
    const double t = (at - index[k]) / (index[k + 1] - index[k]);
    return place[k] + t * (place[k + 1] - place[k]);
  };
  std::vector<double> lines{mirrored ? low : line(shift - 0.5)};
  for (int k = 1; lines.back() < high - 1e-9 * coarsest; ++k)
    lines.push_back(line(mirrored ? k - shift : k + shift - 0.5));
  return lines;
}

}  // namespace granulaw
