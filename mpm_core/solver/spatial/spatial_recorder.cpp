#include "solver/spatial/spatial_recorder.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "solver/spatial/cell_cutter.hpp"
#include "solver/spatial/spatial_kernels.hpp"

namespace granulaw {

namespace {

/// A field at one of the places whose weights a surface keeps.
Vector3 carried(const SpatialBody& body, const NodeField& field, const SpatialSurface& places, int k)
{
  const std::array<int, 3> stride = body.strides();
  Vector3 sum = Vector3::Zero();
  for (int n = 0; n < cell_nodes; ++n) {
    const int node = places.node[k] + n / 9 + n / 3 % 3 * stride[1] + n % 3 * stride[2];
    const double weight = places.weight[std::size_t(cell_nodes) * k + n];
    for (int d = 0; d < 3; ++d) sum[d] += weight * field[4 * node + d];
  }
  return sum;
}

/// 1 plus the displacement gradient: `slope(a, b, c)` is the mean gradient of the function of a cell's node.
template <class Slope>
Eigen::Matrix3d one_plus_gradient(const SpatialBody& body, const SpatialCell& cell, Slope slope)
{
  const std::array<int, 3> stride = body.strides();
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  for (int k = 0; k < cell_nodes; ++k) {
    const int a = k / 9, b = k / 3 % 3, c = k % 3;
    const double* u = body.u_i.data() + 4 * (cell.node + a + b * stride[1] + c * stride[2]);
    f += Vector3(u[0], u[1], u[2]) * slope(a, b, c).transpose();
  }
  return f;
}

/// Mean of the three splines of an axis over a half of a filled cell, or of their slopes, for one octant.
std::array<double, 3> half_cell_means(const double (&of)[3][octants], int lane)
{
  return {of[0][lane], of[1][lane], of[2][lane]};
}

/// Mean of F over an octant of a filled cell.
Eigen::Matrix3d filled_deformation(const SpatialBody& body, const SpatialCell& cell, int lane)
{
  std::array<double, 3> n[3], slope[3];
  for (int d = 0; d < 3; ++d) {
    const AxisWeights<double>& w = body.axis_weights[d][cell.column[d]];
    n[d] = half_cell_means(w.n, lane), slope[d] = half_cell_means(w.dn, lane);
  }
  return one_plus_gradient(body, cell, [&](int a, int b, int c) {
    return Vector3(slope[0][a] * n[1][b] * n[2][c], n[0][a] * slope[1][b] * n[2][c],
                   n[0][a] * n[1][b] * slope[2][c]);
  });
}

/// The three splines of a cut cell's axis as polynomials of its own coordinate t (SpatialCell::along).
std::array<std::array<double, 3>, 3> splines_of_t(const CellSplines& axis, int along)
{
  std::array<std::array<double, 3>, 3> of_t;
  for (int a = 0; a < 3; ++a) {
    const double(&n)[3] = axis.n[a];  // of xi = along (t - 1/2)
    of_t[a] = {n[0] - 0.5 * along * n[1] + 0.25 * n[2], along * n[1] - n[2], n[2]};
  }
  return of_t;
}

/// Mean of F over the piece of a cut cell that an octant holds, by the piece's moments.
Eigen::Matrix3d cut_deformation(const SpatialBody& body, const SpatialCell& cell, int lane)
{
  std::array<std::array<double, 3>, 3> splines[3];
  double per_edge[3];
  for (int d = 0; d < 3; ++d) {
    const CellSplines axis(body.axes[d], cell.column[d]);
    splines[d] = splines_of_t(axis, cell.along[d]);
    per_edge[d] = cell.along[d] / axis.edge;
  }
  const double* moments = body.cut_moments.data() + std::size_t(cell.cut) * cut_moments_each * octants + lane;
  return one_plus_gradient(body, cell, [&](int a, int b, int c) {
    const int node[3] = {a, b, c};
    Vector3 mean = Vector3::Zero();
    for (int k = 0; k < cut_moments_each; ++k) {
      const int power[3] = {k / 9, k / 3 % 3, k % 3};
      for (int along = 0; along < 3; ++along) {
        if (power[along] == 2) continue;
        double term = moments[k * octants];  // of t^2/2
        for (int d = 0; d < 3; ++d) {
          const std::array<double, 3>& n = splines[d][node[d]];
          if (d == along)
            term *= (power[d] + 1) * n[power[d] + 1] * per_edge[d];
          else
            term *= (power[d] == 2 ? 2 : 1) * n[power[d]];
        }
        mean[along] += term;
      }
    }
    return mean;
  });
}

/// Cauchy stress of a point, by principal axes: the equations of the kernel, written for reading.
Eigen::Matrix3d cauchy_stress(const SpatialBody& body, const Moduli& m, const SpatialCell& cell,
                              std::size_t p)
{
  const int lane = static_cast<int>(p % octants);
  const Eigen::Matrix3d f =
      cell.cut < 0 ? filled_deformation(body, cell, lane) : cut_deformation(body, cell, lane);
  Eigen::Matrix3d c;
  c << body.c_p[0][p], body.c_p[3][p], body.c_p[4][p], body.c_p[3][p], body.c_p[1][p], body.c_p[5][p],
      body.c_p[4][p], body.c_p[5][p], body.c_p[2][p];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(f * (Eigen::Matrix3d::Identity() + c) *
                                                            f.transpose());
  const Eigen::Array3d e = 0.5 * axes.eigenvalues().array().max(1e-12).log();
  const double trace = e.sum();
  const Vector3 tau = (2 * m.shear * (e - trace / 3) + m.bulk * trace).matrix();
  return axes.eigenvectors() * tau.asDiagonal() * axes.eigenvectors().transpose() / f.determinant();
}

/// Volume means of the cells.
void add_cells(const SpatialBody& body, double unit, FieldFrame& frame)
{
  for (const SpatialRegion& region : body.regions)
    for (int k = region.begin; k < region.end; ++k) {
      Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
      double volume = 0, strain = 0;
      for (int lane = 0; lane < octants; ++lane) {
        const std::size_t p = std::size_t(octants) * k + lane;
        const double v = body.volume_p[p];
        if (v == 0) continue;
        volume += v, strain += v * body.plastic_strain_p[p];
        stress += v * cauchy_stress(body, region.moduli, body.cells[k], p);
      }
      stress *= unit / volume;
      const Eigen::Matrix3d deviator = stress - stress.trace() / 3 * Eigen::Matrix3d::Identity();
      frame.plastic_strain.push_back(strain / volume);
      frame.pressure.push_back(-stress.trace() / 3);
      frame.von_mises.push_back(std::sqrt(1.5) * deviator.norm());
      frame.axial_stress.push_back(stress(2, 2));
    }
}

}  // namespace

void SpatialRecorder::begin(const SpatialScene& scene)
{
  if (!observer_) return;
  const SpatialBody& body = scene.bodies.front();
  if (observer_.begin_solid) observer_.begin_solid(body.corners.count, body.drawn_cells);
  record(scene, 0, 0, 0);
}

void SpatialRecorder::record(const SpatialScene& scene, double time, double overlap, double force)
{
  next_ = interval_ * (std::floor(time / interval_ + 1e-9) + 1);
  SpatialBody body = scene.bodies.front();  // a copy, whose plastic state is brought up to the displacements
  spatial_kernels().internal_force(body, false);
  body.fetch_state();
  FieldFrame frame;
  frame.time = time * scale_.time(), frame.delta = overlap * scale_.length;
  frame.force = force * scale_.force();
  std::vector<double>* places[3] = {&frame.r, &frame.y, &frame.z};
  std::vector<double>* displacements[3] = {&frame.ur, &frame.uy, &frame.uz};
  std::vector<double>* velocities[3] = {&frame.vr, &frame.vy, &frame.vz};
  for (int k = 0; k < body.corners.count; ++k) {
    const Vector3 u = carried(body, body.u_i, body.corners, k), v = carried(body, body.v_i, body.corners, k);
    for (int d = 0; d < 3; ++d) {
      places[d]->push_back((body.corners.place[k][d] + u[d]) * scale_.length);
      displacements[d]->push_back(u[d] * scale_.length);
      velocities[d]->push_back(v[d] * scale_.velocity());
    }
  }
  add_cells(body, scale_.stress, frame);
  observer_.frame(frame);
}

}  // namespace granulaw
