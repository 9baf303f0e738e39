#include "solver/output/field_recorder.hpp"

#include <cmath>

namespace granulaw {

void FieldRecorder::record(FieldFrame f, double time, double overlap, double force)
{
  next_ = interval_ * (std::floor(time / interval_ + 1e-9) + 1);
  const auto scale = [](double by, auto&... fields) {
    for (std::vector<double>* field : {&fields...})
      for (double& value : *field) value *= by;
  };
  f.time = time * scale_.time(), f.delta = overlap * scale_.length, f.force = force * scale_.force();
  scale(scale_.length, f.r, f.y, f.z, f.ur, f.uy, f.uz);
  scale(scale_.velocity(), f.vr, f.vy, f.vz);
  scale(scale_.stress, f.pressure, f.von_mises, f.axial_stress);
  observer_.frame(f);
}

}  // namespace granulaw
