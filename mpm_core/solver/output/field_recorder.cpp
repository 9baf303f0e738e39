#include "solver/output/field_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "solver/output/stress.hpp"

namespace granulaw {

namespace {

/// A body as it is drawn: a quadrilateral for each material point, its corners `first`, `first` + 1, ...
/// Values in solver units, in the frame of the first body.
struct Drawing
{
  std::vector<double> r, z, ur, uz, vr, vz;
  std::vector<std::array<int, 4>> cells;

  int add(double r0, double z0, double dr, double dz, double wr, double wz)
  {
    r.push_back(r0 + dr), z.push_back(z0 + dz), ur.push_back(dr), uz.push_back(dz);
    vr.push_back(wr), vz.push_back(wz);
    return static_cast<int>(r.size()) - 1;
  }
};

/// `mapped`: the grid itself.
void draw_cells(const Body& b, Drawing& d)
{
  const int first = static_cast<int>(d.r.size());
  for (int i = 0; i < b.nodes; ++i) d.add(b.r_i[i], b.z_i[i], b.ur_i[i], b.uz_i[i], b.vr_i[i], b.vz_i[i]);
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
      cell[k] = d.add(corners.r[m], corners.z[m], dr, dz, wr, wz);
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
      cell[k] = d.add(m.r[p] + (k == 0 || k == 3 ? -half : half), m.z[p] + (k < 2 ? -half : half), 0, 0,
                      m.vr[p], m.vz[p]);
    d.cells.push_back(cell);
  }
}

Drawing draw(const Scene& scene)
{
  Drawing d;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const Body& b = scene.bodies[k];
    const std::size_t first = d.r.size(), first_cell = d.cells.size();
    if (b.moving)
      draw_points(b, d);
    else if (b.corners == 4)
      draw_cells(b, d);
    else
      draw_pieces(b, d);
    if (k == 0) continue;
    for (std::size_t i = first; i < d.r.size(); ++i)  // the second body is kept mirrored
      d.z[i] = -d.z[i], d.uz[i] = -d.uz[i], d.vz[i] = -d.vz[i];
    for (std::size_t c = first_cell; c < d.cells.size(); ++c) std::swap(d.cells[c][1], d.cells[c][3]);
  }
  return d;
}

}  // namespace

FieldRecorder::FieldRecorder(const FieldObserver& observer, const Scales& scale, double duration)
    : observer_(observer), scale_(scale), interval_(duration / std::max(1, observer.frames - 1))
{
}

void FieldRecorder::begin(const Scene& scene)
{
  if (!observer_) return;
  if (observer_.begin) {
    const Drawing d = draw(scene);
    observer_.begin(static_cast<int>(d.r.size()), d.cells);
  }
  record(scene, 0, 0, 0);
}

void FieldRecorder::record(const Scene& scene, double time, double overlap, double force)
{
  next_ = interval_ * (std::floor(time / interval_ + 1e-9) + 1);
  const auto scaled = [](std::vector<double> values, double scale) {
    for (double& v : values) v *= scale;
    return values;
  };
  Drawing d = draw(scene);
  FieldFrame f;
  f.time = time * scale_.time(), f.delta = overlap * scale_.length, f.force = force * scale_.force();
  f.r = scaled(std::move(d.r), scale_.length), f.z = scaled(std::move(d.z), scale_.length);
  f.ur = scaled(std::move(d.ur), scale_.length), f.uz = scaled(std::move(d.uz), scale_.length);
  f.vr = scaled(std::move(d.vr), scale_.velocity()), f.vz = scaled(std::move(d.vz), scale_.velocity());
  for (const Body& body : scene.bodies) {
    const PointState now = point_state_now(body);
    f.plastic_strain.insert(f.plastic_strain.end(), now.plastic_strain.begin(), now.plastic_strain.end());
    for (const CauchyStress& s : now.stress) {
      f.pressure.push_back(s.pressure() * scale_.stress);
      f.von_mises.push_back(s.von_mises() * scale_.stress);
      f.axial_stress.push_back(s.zz * scale_.stress);
    }
  }
  observer_.frame(f);
}

}  // namespace granulaw
