#include "solver/output/drawing.hpp"

#include <algorithm>
#include <cmath>

#include "solver/body/kernels.hpp"
#include "solver/body/motion.hpp"

namespace granulaw {

namespace {

/// A corner: its reference place, displacement and velocity.
int add(Drawing& d, const Vector3& reference, const Vector3& u, const Vector3& v)
{
  FieldFrame& f = d.frame;
  const Vector3 x = reference + u;
  f.r.push_back(x[0]), f.z.push_back(x[2]), f.ur.push_back(u[0]), f.uz.push_back(u[2]);
  f.vr.push_back(v[0]), f.vz.push_back(v[2]);
  if (!d.solid_cells.empty()) f.y.push_back(x[1]), f.uy.push_back(u[1]), f.vy.push_back(v[1]);
  return static_cast<int>(f.r.size()) - 1;
}

/// Marker of a drawing, carried by the splines.
int add(Drawing& d, const Body& b, int m)
{
  const Markers& drawn = b.reference().drawn;
  const auto& x = drawn.place[m];
  return add(d, {x[0], x[1], x[2]}, carried(b.u_i, drawn, m), carried(b.v_i, drawn, m));
}

/// `mapped`: the grid itself.
void draw_cells(const Body& b, Drawing& d)
{
  const int first = static_cast<int>(d.frame.r.size());
  for (int i = 0; i < b.nodes(); ++i) add(d, reference_place(b, i), at(b.u_i, i), at(b.v_i, i));
  for (int p = 0; p < b.points(); ++p) {
    std::array<int, 4> cell{};
    for (int k = 0; k < 4; ++k) cell[k] = first + b.reference().corners.node[std::size_t(k) * b.points() + p];
    d.cells.push_back(cell);
  }
}

/// `rectilinear`: the piece that each point stands for.
void draw_pieces(const Body& b, Drawing& d)
{
  for (int p = 0; p < b.points(); ++p) {
    std::array<int, 4> cell{};
    for (int k = 0; k < 4; ++k) cell[k] = add(d, b, k * b.points() + p);
    d.cells.push_back(cell);
  }
}

/// `updated`: a square of the size of each point's piece, where the point is now.
void draw_points(const Body& b, Drawing& d)
{
  const MovingPoints& m = *b.moving;
  for (int p = 0; p < b.points(); ++p) {
    const double half = std::min(0.5 * std::sqrt(m.own.volume_p[p] / (2 * M_PI * m.r[p])), m.r[p]);
    std::array<int, 4> cell{};
    for (int k = 0; k < 4; ++k)
      cell[k] = add(d, {m.r[p] + (k == 0 || k == 3 ? -half : half), 0, m.z[p] + (k < 2 ? -half : half)},
                    Vector3::Zero(), {m.vr[p], 0, m.vz[p]});
    d.cells.push_back(cell);
  }
}

/// Three dimensions.
void draw_solid(const Body& b, Drawing& d)
{
  d.solid_cells = b.reference().cells.drawn;
  for (int k = 0; k < b.reference().drawn.count; ++k) add(d, b, k);
}

/// Volume means of `each` points, of a copy whose plastic state is brought up to its displacements, in double
/// precision.
void add_stress(const Body& body, FieldFrame& f)
{
  Body copy = body;
  copy.fetch_state();
  copy.single = {};
  if (!copy.moving) kernels(copy).points_to_grid(copy);
  std::vector<CauchyStress> stress(std::size_t(copy.points()));
  kernels(copy).stress(copy, stress.data());
  const auto& volume_p = copy.reference().volume_p;
  const std::size_t each = copy.reference().is_spatial() ? octants : 1;
  for (std::size_t first = 0; first < stress.size(); first += each) {
    CauchyStress mean{};
    double volume = 0, strain = 0;
    for (std::size_t p = first; p < first + each; ++p) volume += volume_p[p];
    for (std::size_t p = first; p < first + each; ++p) {
      const double share = volume_p[p] / volume;
      if (share == 0) continue;
      strain += share * copy.state.plastic_strain_p[p];
      for (double CauchyStress::*part : {&CauchyStress::xx, &CauchyStress::yy, &CauchyStress::zz,
                                         &CauchyStress::xy, &CauchyStress::xz, &CauchyStress::yz})
        mean.*part += share * stress[p].*part;
    }
    f.plastic_strain.push_back(strain);
    f.pressure.push_back(mean.pressure());
    f.von_mises.push_back(mean.von_mises());
    f.axial_stress.push_back(mean.zz);
  }
}

void draw_body(const Body& b, Drawing& d)
{
  if (b.reference().is_spatial())
    draw_solid(b, d);
  else if (b.moving)
    draw_points(b, d);
  else if (b.reference().corners.each == 4)
    draw_cells(b, d);
  else
    draw_pieces(b, d);
}

}  // namespace

Drawing draw(std::span<const Body> bodies)
{
  Drawing d;
  FieldFrame& f = d.frame;
  for (const Body& b : bodies) {
    const std::size_t first = f.r.size(), first_cell = d.cells.size();
    draw_body(b, d);
    add_stress(b, f);
    if (&b == bodies.data()) continue;
    for (std::size_t i = first; i < f.r.size(); ++i) f.z[i] = -f.z[i], f.uz[i] = -f.uz[i], f.vz[i] = -f.vz[i];
    for (std::size_t c = first_cell; c < d.cells.size(); ++c) std::swap(d.cells[c][1], d.cells[c][3]);
  }
  return d;
}

}  // namespace granulaw
