// Single numbers of a sphere.
#include <cmath>

#include "base/scales.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

constexpr double onset_error = 0.02;  // sd of the model, relative

/// Force on a flat at which a sphere begins to yield (Johnson 1985, sect. 6.1).
double onset_of(const LawMaterial& m, double radius)
{
  const double pressure = onset_pressure_ratio(m.poisson_ratio) * m.yield_stress;
  return std::pow(M_PI * pressure, 3) * radius * radius / (6 * m.e_star() * m.e_star());
}

Prediction predict_onset(const Measurement& m, const Trial& t)
{
  const double force = onset_of(t.material, m.radius);
  return same_value(m, force, force * onset_error);
}

}  // namespace

extern const Kind onset_force_kind{
    .name = "onset force",
    .help = "on a flat, at which yield begins",
    .y = {.quantity = "onset_force", .unit = "N"},
    .predict = predict_onset,
    .starts =
        [](const Measurement&, const LawMaterial&, std::vector<double>& likely) {
          for (double y = 1e6; y < 1e10; y *= 3) likely.push_back(y);
        },
    .model_error = [](const AtlasErrors&) { return onset_error; }};

}  // namespace granulaw
