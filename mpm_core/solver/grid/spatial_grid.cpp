#include "solver/grid/spatial_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "solver/grid/cell_cutter.hpp"

namespace granulaw {

namespace {

/// Pieces of less than this fraction of an octant are left out.
constexpr double least_share = 1e-6;
/// No node weighs less than this fraction of a finest cell. Nodes that only slivers reach fly far off
/// otherwise, and take the slivers with them. A hundredth takes 0.4 % off e.
constexpr double least_mass = 0.001;
/// V sum_k |b_k|^2/m_k of a filled octant amid filled cells of edge 1 and density 1
/// (SplineCells::step_share).
constexpr double own_stiffness_of_filled = 0.096;

/// Means over one half of the cell.
AxisWeights<double> axis_weights(const CellSplines& s, int direction)
{
  AxisWeights<double> w{};
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

/// Builds a body cell by cell.
class Builder
{
 public:
  explicit Builder(const SpatialSection& section) : section_(section)
  {
    for (int d = 0; d < 3; ++d) {
      cells_.axes[d] = SplineAxis(section.lines[d]);
      for (int c = 0; c < cells_.axes[d].cells(); ++c) {
        splines_[d].emplace_back(cells_.axes[d], c);
        cells_.full.axis[d].push_back(axis_weights(splines_[d].back(), d));
      }
    }
    body_.mirrored = section.mirrored;
    for (int d = 0; d < 3; ++d) cells_.count[d] = cells_.axes[d].functions();
    body_.resize_nodes(cells_.count[0] * cells_.count[1] * cells_.count[2], 3);
    for (int i = 0; i < body_.nodes; ++i)
      for (int d = 0; d < 3; ++d) body_.place_i(i, d) = cells_.axes[d].node(along(i, d));
    filled_.resize(section.phases.size()), cut_.resize(section.phases.size());
  }

  Body build()
  {
    for (int z = 0; z < cells_.axes[2].cells(); ++z)
      for (int y = 0; y < cells_.axes[1].cells(); ++y)
        for (int x = 0; x < cells_.axes[0].cells(); ++x) take_cell({x, y, z});
    join_cells();
    set_masses();
    set_step_shares();
    set_surface();
    if (section_.drawn) set_corners();
    for (Markers* markers : {&body_.surface, &body_.drawn}) set_offsets(*markers);
    return Body(std::move(body_));
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
    Column column;
    Moments moments;
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
    const std::array<int, 3> stride = cells_.strides();
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
        if (content.phases[p].size() < least_share / octants) continue;
        found[p].moments[k] = content.phases[p];
        held[p] += content.phases[p].size();
        any = true;
      }
      if (any && content.patch.size() > 0) patches_.push_back({column, content.patch});
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
      const int begin = static_cast<int>(cells_.cells.size());
      cells_.cells.insert(cells_.cells.end(), filled_[p].begin(), filled_[p].end());
      for (CutCell& c : cut_[p]) {
        c.cell.cut = static_cast<int>(cut_cells++);
        cells_.cells.push_back(c.cell);
      }
      const Moduli& m = section_.phases[p].moduli;
      const double wave_speed2 = (m.bulk + 4.0 / 3.0 * m.shear) / section_.phases[p].density;
      body_.regions.push_back({octants * begin, octants * static_cast<int>(cells_.cells.size()), m,
                               static_cast<int>(p), wave_speed2});
    }
    if (cells_.cells.empty()) fail("reference grid", "no part of the body lies on it");
    cells_.full.cut_moments.assign(cut_cells * cut_moments_each * octants, 0.0);
    cells_.step_share.assign(cut_cells * octants, 0.0);
    body_.points = octants * static_cast<int>(cells_.cells.size());
    body_.volume_p.assign(std::size_t(body_.points), 0.0);
    int at = 0;
    for (std::size_t p = 0; p < section_.phases.size(); ++p) {
      for (const SpatialCell& c : filled_[p]) fill_cell(at++, c, section_.phases[p].density);
      for (const CutCell& c : cut_[p]) cut_cell(at++, c, section_.phases[p].density);
    }
  }

  /// Index of a node along axis d.
  int along(int node, int d) const { return node / cells_.strides()[d] % cells_.count[d]; }

  int node(const SpatialCell& cell, int k) const
  {
    const std::array<int, 3> stride = cells_.strides();
    return cell.node + k / 9 + k / 3 % 3 * stride[1] + k % 3 * stride[2];
  }

  void fill_cell(int at, const SpatialCell& cell, double density)
  {
    const double piece = volume(cell.column) / octants;
    for (int lane = 0; lane < octants; ++lane) body_.volume_p[octants * at + lane] = piece;
    body_.filled += octants;
    Moments whole;
    whole.add_box(Vector3::Zero(), Vector3::Ones());
    add_mass(cell, whole, density);
  }

  void add_mass(const SpatialCell& cell, const Moments& moments, double density)
  {
    const auto s = splines(cell.column);
    for (int k = 0; k < cell_nodes; ++k)
      body_.mass_i[node(cell, k)] +=
          density * volume(cell.column) * moments.of(s[0]->n[k / 9], s[1]->n[k / 3 % 3], s[2]->n[k % 3]);
  }

  /// Each axis runs from where the material is (SpatialCell::along).
  static std::array<int, 3> from_material(const std::array<Moments, octants>& pieces)
  {
    constexpr int first_moment[3] = {9, 3, 1};
    std::array<int, 3> along{};
    for (int d = 0; d < 3; ++d) {
      double sum = 0;
      for (const Moments& m : pieces) sum += m.value[first_moment[d]];
      along[d] = sum > 0 ? -1 : 1;
    }
    return along;
  }

  void cut_cell(int at, const CutCell& c, double density)
  {
    SpatialCell& cell = cells_.cells[at];
    cell.along = from_material(c.moments);
    double* moments = cells_.full.cut_moments.data() + std::size_t(cell.cut) * cut_moments_each * octants;
    for (int lane = 0; lane < octants; ++lane) {
      const Moments& m = c.moments[lane];
      if (m.size() <= 0) continue;
      ++body_.filled;
      body_.volume_p[octants * at + lane] = volume(c.cell.column) * m.size();
      add_mass(c.cell, m, density);
      double power[3][3][3];  // axis, then 1, t, t^2/2 as polynomials of xi
      for (int d = 0; d < 3; ++d) {
        const double s = cell.along[d];
        const double all[3][3] = {{1, 0, 0}, {0.5, s, 0}, {0.125, 0.5 * s, 0.5}};
        std::copy(&all[0][0], &all[0][0] + 9, &power[d][0][0]);
      }
      for (int k = 0; k < cut_moments_each; ++k)
        moments[k * octants + lane] = m.of(power[0][k / 9], power[1][k / 3 % 3], power[2][k % 3]) / m.size();
    }
  }

  /// Before masses are brought to the exact one.
  void raise_masses()
  {
    double density = section_.phases.front().density, finest = 1;
    for (const Phase& phase : section_.phases) density = std::min(density, phase.density);
    for (const auto& splines : splines_)
      finest *= std::min_element(splines.begin(), splines.end(), [](const auto& a, const auto& b) {
                  return a.edge < b.edge;
                })->edge;
    for (double& mass : body_.mass_i)
      if (mass > 0) mass = std::max(mass, least_mass * density * finest);
  }

  /// Own stiffness of each cut piece over the masses of its nodes (SplineCells::step_share).
  void set_step_shares()
  {
    for (const Region& region : body_.regions)
      for (int at = region.begin / octants, end = region.end / octants; at < end; ++at) {
        const SpatialCell& cell = cells_.cells[at];
        if (cell.cut < 0) continue;
        const auto& pieces = cut_[region.material][at - end + cut_[region.material].size()].moments;
        for (int lane = 0; lane < octants; ++lane)
          if (pieces[lane].size() > 0)
            cells_.step_share[std::size_t(cell.cut) * octants + lane] =
                step_share(cell, pieces[lane], section_.phases[region.material].density);
      }
  }

  double step_share(const SpatialCell& cell, const Moments& piece, double density) const
  {
    const auto s = splines(cell.column);
    double sum = 0, finest = s[0]->edge;
    for (int d = 1; d < 3; ++d) finest = std::min(finest, s[d]->edge);
    for (int k = 0; k < cell_nodes; ++k) {
      const int spline[3] = {k / 9, k / 3 % 3, k % 3};
      double slope2 = 0;  // of the mean gradient
      for (int d = 0; d < 3; ++d) {
        double part[3][3];
        for (int e = 0; e < 3; ++e) {
          const double(&n)[3] = s[e]->n[spline[e]];
          const double sloped[3] = {n[1], 2 * n[2], 0};
          std::copy_n(e == d ? sloped : n, 3, part[e]);
        }
        const double slope = piece.of(part[0], part[1], part[2]) / (piece.size() * s[d]->edge);
        slope2 += slope * slope;
      }
      sum += slope2 / body_.mass_i[node(cell, k)];
    }
    const double own = density * volume(cell.column) * piece.size() * finest * finest * sum;
    return std::min(1.0, own / own_stiffness_of_filled);
  }

  void set_masses()
  {
    raise_masses();
    const double sampled = std::accumulate(body_.mass_i.begin(), body_.mass_i.end(), 0.0);
    body_.mass = section_.mass > 0 ? section_.mass : sampled;
    for (int i = 0; i < body_.nodes; ++i) {
      double& mass = body_.mass_i[i];
      mass *= body_.mass / sampled;
      if (mass <= 0) continue;
      for (int d = 0; d < 3; ++d)
        body_.inverse_mass_i(i, d) = section_.mirrored[d] && along(i, d) == 0 ? 0.0 : 1 / mass;
    }
  }

  /// One marker for each patch: with fewer the force swings with every cell that closes (one a cell: ripple
  /// twice to three times as large, force 9 % off), with more the impulses are not unique. It stands for the
  /// mean of the patch: the splines' means are its weights, so that impulses of a uniform pressure are in
  /// balance with uniform stress (Gauss). With the splines at its middle small pieces flow without end.
  void set_surface()
  {
    Markers& surface = body_.surface;
    for (const Patch& patch : patches_) {
      const auto s = splines(patch.column);
      const double area = patch.moments.size();
      constexpr int first_moment[3] = {9, 3, 1};
      Vector3 mean;
      for (int d = 0; d < 3; ++d) {
        mean[d] = s[d]->middle + s[d]->edge * patch.moments.value[first_moment[d]] / area;
        surface.finest = surface.finest > 0 ? std::min(surface.finest, s[d]->edge) : s[d]->edge;
      }
      const std::array<int, 3> stride = cells_.strides();
      const int lowest = patch.column[0] + patch.column[1] * stride[1] + patch.column[2] * stride[2];
      surface.place.push_back({mean[0], mean[1], mean[2]});
      surface.lowest.push_back(lowest);
      surface.area.push_back(area);
      for (int k = 0; k < cell_nodes; ++k) {
        const bool held = body_.mass_i[lowest + k / 9 + k / 3 % 3 * stride[1] + k % 3 * stride[2]] > 0;
        const double sum = patch.moments.of(s[0]->n[k / 9], s[1]->n[k / 3 % 3], s[2]->n[k % 3]);
        surface.weight.push_back(held ? sum / area : 0.0);
      }
    }
    surface.count = static_cast<int>(surface.place.size());
  }

  /// The same of all markers: from the lowest node of a cell to each of its nodes.
  void set_offsets(Markers& markers) const
  {
    const std::array<int, 3> stride = cells_.strides();
    markers.corners = cell_nodes;
    for (int k = 0; k < cell_nodes; ++k)
      markers.offset.push_back(k / 9 + k / 3 % 3 * stride[1] + k % 3 * stride[2]);
  }

  void set_corners()
  {
    const std::array<int, 3> lines{cells_.axes[0].cells() + 1, cells_.axes[1].cells() + 1,
                                   cells_.axes[2].cells() + 1};
    std::vector<int> known(std::size_t(lines[0]) * lines[1] * lines[2], -1);
    for (const SpatialCell& cell : cells_.cells) {
      std::array<int, 8> drawn{};
      for (int k = 0; k < 8; ++k) {
        const int x = cell.column[0] + (k % 4 == 1 || k % 4 == 2), y = cell.column[1] + (k % 4 > 1),
                  z = cell.column[2] + k / 4;
        int& corner = known[(std::size_t(z) * lines[1] + y) * lines[0] + x];
        if (corner < 0) {
          corner = static_cast<int>(body_.drawn.place.size());
          Vector3 place(section_.lines[0][x], section_.lines[1][y], section_.lines[2][z]);
          for (int n = 0; n < 3; ++n) place += std::min(0.0, section_.depth(place)) * section_.normal(place);
          for (int d = 0; d < 3; ++d)
            place[d] = std::clamp(place[d], section_.lines[d].front(), section_.lines[d].back());
          add_marker(body_.drawn, place);
        }
        drawn[k] = corner;
      }
      cells_.drawn.push_back(drawn);
    }
    body_.drawn.count = static_cast<int>(body_.drawn.place.size());
  }

  void add_marker(Markers& s, const Vector3& x)
  {
    SplineAxis::Values v[3];
    for (int d = 0; d < 3; ++d) {
      v[d] = cells_.axes[d].at(x[d]);
      if (s.finest == 0) s.finest = splines_[d][v[d].first].edge;
      s.finest = std::min(s.finest, splines_[d][v[d].first].edge);
    }
    const std::array<int, 3> stride = cells_.strides();
    const int lowest = v[0].first + v[1].first * stride[1] + v[2].first * stride[2];
    s.place.push_back({x[0], x[1], x[2]});
    s.lowest.push_back(lowest);
    for (int k = 0; k < cell_nodes; ++k) {
      const bool held = body_.mass_i[lowest + k / 9 + k / 3 % 3 * stride[1] + k % 3 * stride[2]] > 0;
      s.weight.push_back(held ? v[0].n[k / 9] * v[1].n[k / 3 % 3] * v[2].n[k % 3] : 0.0);
    }
  }

  const SpatialSection& section_;
  Reference body_;
  SplineCells& cells_ = body_.cells;
  std::array<std::vector<CellSplines>, 3> splines_;
  std::vector<std::vector<SpatialCell>> filled_;  ///< by phase
  std::vector<std::vector<CutCell>> cut_;
  std::vector<Patch> patches_;
};

}  // namespace

Body spatial_body(const SpatialSection& section)
{
  return Builder(section).build();
}

std::vector<double> graded_axis(double low, double high, const std::vector<FineZone>& zones, double coarsest,
                                double shift, bool mirrored)
{
  constexpr int samples = 4000;
  const auto edge = [&](double x) {
    double least = coarsest;
    for (const FineZone& z : zones)
      least = std::min(least, z.edge + z.growth * std::max({0.0, z.low - x, x - z.high}));
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
