#include "solver/output/drawing.hpp"

#include <algorithm>
#include <cmath>

#include "solver/body/kernels.hpp"
#include "solver/body/spatial_kernels.hpp"
#include "solver/contact/spatial_scene.hpp"

namespace granulaw {

namespace {

/// Stresses of a copy, whose plastic state is brought up to its displacements, in double precision.
template <class Body, class Kernels>
std::vector<CauchyStress> stress_now(Body& copy, const Kernels& kernels, bool moves, std::size_t points)
{
  copy.fetch_state();
  copy.single = {};
  if (!moves) kernels.internal_force(copy, false);
  std::vector<CauchyStress> stress(points);
  kernels.stress(copy, stress.data());
  return stress;
}

void add_cell(FieldFrame& f, const CauchyStress& stress, double plastic_strain)
{
  f.plastic_strain.push_back(plastic_strain);
  f.pressure.push_back(stress.pressure());
  f.von_mises.push_back(stress.von_mises());
  f.axial_stress.push_back(stress.zz);
}

/// A corner of the axisymmetric drawing: its reference place, displacement and velocity.
int add(Drawing& d, double r0, double z0, double dr, double dz, double wr, double wz)
{
  FieldFrame& f = d.frame;
  f.r.push_back(r0 + dr), f.z.push_back(z0 + dz), f.ur.push_back(dr), f.uz.push_back(dz);
  f.vr.push_back(wr), f.vz.push_back(wz);
  return static_cast<int>(f.r.size()) - 1;
}

/// `mapped`: the grid itself.
void draw_cells(const Body& b, Drawing& d)
{
  const int first = static_cast<int>(d.frame.r.size());
  for (int i = 0; i < b.nodes; ++i) add(d, b.r_i[i], b.z_i[i], b.ur_i[i], b.uz_i[i], b.vr_i[i], b.vz_i[i]);
  for (int p = 0; p < b.points; ++p) {
    std::array<int, 4> cell{};
    for (int k = 0; k < 4; ++k) cell[k] = first + b.corner_p[std::size_t(k) * b.points + p];
    d.cells.push_back(cell);
  }
}

/// `rectilinear`: the piece that each point stands for, its corners carried by the splines.
void draw_pieces(const Body& b, Drawing& d)
{
  const Surface& corners = b.outline;
  for (int p = 0; p < b.points; ++p) {
    std::array<int, 4> cell{};
    for (int k = 0; k < 4; ++k) {
      const std::size_t m = std::size_t(k) * b.points + p;
      double dr = 0, dz = 0, wr = 0, wz = 0;
      for (int c = 0; c < corners.corners; ++c) {
        const std::size_t at = std::size_t(c) * corners.count + m;
        const int i = corners.node[at];
        dr += corners.weight[at] * b.ur_i[i], dz += corners.weight[at] * b.uz_i[i];
        wr += corners.weight[at] * b.vr_i[i], wz += corners.weight[at] * b.vz_i[i];
      }
      cell[k] = add(d, corners.r[m], corners.z[m], dr, dz, wr, wz);
    }
    d.cells.push_back(cell);
  }
}

/// `updated`: a square of the size of each point's piece, where the point is now.
void draw_points(const Body& b, Drawing& d)
{
  const MovingPoints& m = *b.moving;
  for (int p = 0; p < b.points; ++p) {
    const double half = std::min(0.5 * std::sqrt(b.volume_p[p] / (2 * M_PI * m.r[p])), m.r[p]);
    std::array<int, 4> cell{};
    for (int k = 0; k < 4; ++k)
      cell[k] = add(d, m.r[p] + (k == 0 || k == 3 ? -half : half), m.z[p] + (k < 2 ? -half : half), 0, 0,
                    m.vr[p], m.vz[p]);
    d.cells.push_back(cell);
  }
}

void add_points(const Body& body, FieldFrame& f)
{
  Body copy = body;
  const std::vector<CauchyStress> stress =
      stress_now(copy, kernels(), copy.moving.has_value(), std::size_t(copy.points));
  for (std::size_t p = 0; p < stress.size(); ++p) add_cell(f, stress[p], copy.plastic_strain_p[p]);
}

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

/// Volume means of the cells.
void add_cells(const SpatialBody& body, FieldFrame& f)
{
  SpatialBody copy = body;
  const std::vector<CauchyStress> stress = stress_now(copy, spatial_kernels(), false, copy.volume_p.size());
  for (std::size_t cell = 0; cell < body.cells.size(); ++cell) {
    CauchyStress mean{};
    double volume = 0, strain = 0;
    for (std::size_t p = octants * cell; p < octants * (cell + 1); ++p) volume += copy.volume_p[p];
    for (std::size_t p = octants * cell; p < octants * (cell + 1); ++p) {
      const double share = copy.volume_p[p] / volume;
      if (share == 0) continue;
      strain += share * copy.plastic_strain_p[p];
      for (double CauchyStress::*part : {&CauchyStress::xx, &CauchyStress::yy, &CauchyStress::zz,
                                         &CauchyStress::xy, &CauchyStress::xz, &CauchyStress::yz})
        mean.*part += share * stress[p].*part;
    }
    add_cell(f, mean, strain);
  }
}

}  // namespace

Drawing draw(const Scene& scene)
{
  Drawing d;
  FieldFrame& f = d.frame;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const Body& b = scene.bodies[k];
    const std::size_t first = f.r.size(), first_cell = d.cells.size();
    if (b.moving)
      draw_points(b, d);
    else if (b.corners == 4)
      draw_cells(b, d);
    else
      draw_pieces(b, d);
    add_points(b, f);
    if (k == 0) continue;
    for (std::size_t i = first; i < f.r.size(); ++i)  // the second body is kept mirrored
      f.z[i] = -f.z[i], f.uz[i] = -f.uz[i], f.vz[i] = -f.vz[i];
    for (std::size_t c = first_cell; c < d.cells.size(); ++c) std::swap(d.cells[c][1], d.cells[c][3]);
  }
  return d;
}

Drawing draw(const SpatialScene& scene)
{
  const SpatialBody& body = scene.bodies.front();
  Drawing d;
  d.solid_cells = body.drawn_cells;
  FieldFrame& f = d.frame;
  std::vector<double>* places[3] = {&f.r, &f.y, &f.z};
  std::vector<double>* displacements[3] = {&f.ur, &f.uy, &f.uz};
  std::vector<double>* velocities[3] = {&f.vr, &f.vy, &f.vz};
  for (int k = 0; k < body.corners.count; ++k) {
    const Vector3 u = carried(body, body.u_i, body.corners, k), v = carried(body, body.v_i, body.corners, k);
    for (int e = 0; e < 3; ++e) {
      places[e]->push_back(body.corners.place[k][e] + u[e]);
      displacements[e]->push_back(u[e]), velocities[e]->push_back(v[e]);
    }
  }
  add_cells(body, f);
  return d;
}

}  // namespace granulaw
