#include "solver/field_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "solver/stress.hpp"

namespace granulaw {

FieldRecorder::FieldRecorder(const FieldObserver& observer, const Scales& scale, double duration)
    : observer_(observer), scale_(scale), interval_(duration / std::max(1, observer.frames - 1))
{
}

void FieldRecorder::begin(const Body& body)
{
  if (!observer_) return;
  if (body.corners != 4) fail("--fields", "this version shows bodies on the grid 'mapped' only");
  if (observer_.begin) {
    std::vector<std::array<int, 4>> cells(static_cast<std::size_t>(body.points));
    for (int k = 0; k < 4; ++k)
      for (int p = 0; p < body.points; ++p) cells[p][k] = body.corner_p[std::size_t(k) * body.points + p];
    observer_.begin(body.nodes, cells);
  }
  record(body, 0, 0, 0);
}

void FieldRecorder::record(const Body& body, double time, double overlap, double force)
{
  next_ = interval_ * (std::floor(time / interval_ + 1e-9) + 1);
  const auto scaled = [](std::vector<double> values, double scale) {
    for (double& v : values) v *= scale;
    return values;
  };
  FieldFrame f;
  f.time = time * scale_.time(), f.delta = overlap * scale_.length, f.force = force * scale_.force();
  f.ur = scaled(body.ur_i, scale_.length), f.uz = scaled(body.uz_i, scale_.length);
  f.vr = scaled(body.vr_i, scale_.velocity()), f.vz = scaled(body.vz_i, scale_.velocity());
  f.r = scaled(body.r_i, scale_.length), f.z = scaled(body.z_i, scale_.length);
  for (int i = 0; i < body.nodes; ++i) f.r[i] += f.ur[i], f.z[i] += f.uz[i];
  PointState now = point_state_now(body);
  f.plastic_strain = std::move(now.plastic_strain);
  for (const CauchyStress& s : now.stress) {
    f.pressure.push_back(s.pressure() * scale_.stress);
    f.von_mises.push_back(s.von_mises() * scale_.stress);
    f.axial_stress.push_back(s.zz * scale_.stress);
  }
  observer_.frame(f);
}

}  // namespace granulaw
