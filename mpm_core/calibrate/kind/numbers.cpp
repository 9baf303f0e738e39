// Single numbers of a material or a sphere.
#include <algorithm>
#include <cmath>

#include "base/scales.hpp"
#include "atlas/stand_in.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibrate/parameters.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw {

namespace {

constexpr double hardness_error = 0.07, onset_error = 0.02;  // sd of the model, relative

}  // namespace

double hardness_of(const CandidateMaterial& m)
{
  constexpr double strain = 0.08;  // of a pyramid
  const double tan_beta = std::tan((90 - 70.3) * M_PI / 180), nu = m.poisson_ratio;
  const double flow = flow_stress(solver_material(m), strain);
  const double cavity =
      2.0 / 3.0 * (1 + std::log((m.youngs_modulus / flow * tan_beta + 4 * (1 - 2 * nu)) / (6 * (1 - nu))));
  return flow * std::clamp(cavity, 1.0, 3.0);
}

namespace {

/// Force on a flat at which a sphere begins to yield (Johnson 1985, sect. 6.1).
double onset_of(const LawMaterial& m, double radius)
{
  const double pressure = onset_pressure_ratio(m.poisson_ratio) * m.yield_stress;
  return std::pow(M_PI * pressure, 3) * radius * radius / (6 * m.e_star() * m.e_star());
}

/// All data are of one true value; `sd`: of the model.
Prediction same(const Measurement& m, double value, double sd)
{
  Prediction p;
  p.values.assign(m.data.size(), value);
  p.errors = {std::vector<double>(m.data.size(), sd)};
  p.scatter.assign(m.data.size(), 0.0);
  return p;
}

Prediction predict_hardness(const Measurement& m, const Trial& t)
{
  constexpr double normal95 = 1.959964;
  if (!m.ratio_to_yield) {
    const double hardness = hardness_of(t.material);
    return same(m, hardness, hardness * hardness_error);
  }
  const auto [low, high] = *m.ratio_to_yield;
  const double value = std::sqrt(low * high) * t.material.yield_stress;
  return same(m, value, std::log(high / low) / (2 * normal95) * value);
}

Prediction predict_onset(const Measurement& m, const Trial& t)
{
  const double force = onset_of(t.material, m.radius);
  return same(m, force, force * onset_error);
}

}  // namespace

extern const Kind hardness_kind{
    .name = "hardness",
    .help = "Vickers: force over the dent's area",
    .y = {.quantity = "hardness", .unit = "Pa"},
    .shows = Kind::Shows::slow,
    .has_ratio_to_yield = true,
    .predict = predict_hardness,
    .starts =
        [](const Measurement& m, const LawMaterial&, std::vector<double>& likely) {
          for (const double ratio : {3.0, 2.5, 2.0, 1.5}) likely.push_back(m.data.front().y / ratio);
        },
    .model_error = [](const AtlasErrors&) { return hardness_error; }};
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
