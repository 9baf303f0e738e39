#include "atlas/atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "base/scales.hpp"
#include "atlas/body_numbers.hpp"
#include "atlas/confident_bound.hpp"
#include "atlas/interpolation.hpp"

namespace granulaw {

namespace {

/// The value that 95 of 100 do not exceed; 0 of none.
double percentile95(std::vector<double> values)
{
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto k = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size()))) - 1;
  return values[k];
}

}  // namespace

MaterialRatios MaterialRatios::of(const LawMaterial& m)
{
  return {m.e_star() / m.yield_stress, m.poisson_ratio, m.hardening_modulus / m.youngs_modulus};
}

double onset_of(const MaterialRatios& m)
{
  return onset_overlap(1.0, 1 / m.stiffness, m.poisson_ratio);
}

BodyNumbers body_numbers(const MaterialRatios& m)
{
  BodyNumbers numbers;
  numbers.onset = onset_of(m);
  numbers.yield = 1 / m.stiffness;
  return numbers;
}

double hardening_coordinate(double stiffness, double hardening)
{
  return std::log1p(2 * hardening * stiffness);
}

std::vector<double> hardening_coordinates(double stiffness, const std::vector<double>& hardenings)
{
  std::vector<double> z;
  for (const double h : hardenings) z.push_back(hardening_coordinate(stiffness, h));
  return z;
}

Atlas::Atlas(AtlasGrid grid, std::vector<Node> nodes, std::vector<ElasticSphere> elastic,
             std::vector<AtlasCheck> checks, MidplaneShapes midplane)
    : grid_(std::move(grid)),
      nodes_(std::move(nodes)),
      elastic_(std::move(elastic)),
      checks_(std::move(checks)),
      midplane_(std::move(midplane))
{
  const std::vector<double> ratios = grid_.poisson_ratios();
  if (!std::equal(elastic_.begin(), elastic_.end(), ratios.begin(), ratios.end(),
                  [](const ElasticSphere& e, double nu) { return e.poisson_ratio == nu; }))
    fail("atlas", "its elastic spheres are not those of its Poisson's ratios");
  check_nodes(grid_, nodes_, "material");
  for (Node& node : nodes_) node.shape.onset = onset_of(node.material), node.shape.end = depth;
  claimed_force_ = confident_bound(checks_, &AtlasCheck::error_force);
  claimed_restitution_ = confident_bound(checks_, &AtlasCheck::error_restitution);
}

NearBounds Atlas::bounds_near(double stiffness) const
{
  constexpr std::size_t near = 93;
  constexpr double true_over_estimate = 0.67;
  std::vector<AtlasCheck> checks = checks_;
  const auto distance = [&](const AtlasCheck& c) { return std::abs(std::log(c.material.stiffness / stiffness)); };
  std::sort(checks.begin(), checks.end(),
            [&](const AtlasCheck& a, const AtlasCheck& b) { return distance(a) < distance(b); });
  checks.resize(std::min(checks.size(), near));
  std::vector<double> estimates;
  for (const AtlasCheck& c : checks) estimates.push_back(c.solver_estimate);
  return {confident_bound(checks, &AtlasCheck::error_force), confident_bound(checks, &AtlasCheck::error_restitution),
          true_over_estimate * percentile95(std::move(estimates))};
}

std::string Atlas::why_not(const MaterialRatios& m) const
{
  const auto outside = [](const char* name, double value, double low, double high) {
    return fmt::format("{} = {:.4g} lies outside {:.4g} to {:.4g}", name, value, low, high);
  };
  const double soft = grid_.stiffnesses.front(), stiff = grid_.stiffnesses.back(),
               flat = grid_.hardenings.front(), steep = grid_.hardenings.back();
  const auto ratios = grid_.poisson_ratios();
  if (!(m.stiffness >= soft && m.stiffness <= stiff)) return outside("E*/Y", m.stiffness, soft, stiff);
  if (!(m.poisson_ratio >= ratios.front() && m.poisson_ratio <= ratios.back()))
    return outside("nu", m.poisson_ratio, ratios.front(), ratios.back());
  if (!(m.hardening >= flat && m.hardening <= steep)) return outside("H/E", m.hardening, flat, steep);
  return {};
}

ElasticSphere Atlas::elastic(double poisson_ratio) const
{
  const std::vector<double> weights = interpolation_weights(grid_.poisson_ratios(), poisson_ratio);
  ElasticSphere mean;
  mean.poisson_ratio = poisson_ratio;
  for (std::size_t k = 0; k < elastic_.size(); ++k) {
    mean.fit.correction.add(weights[k], elastic_[k].fit.correction);
    mean.fit.error = larger(mean.fit.error, elastic_[k].fit.error);
    mean.solver_error = larger(mean.solver_error, elastic_[k].solver_error);
  }
  return mean;
}

namespace {

/// Inertia acts by the sphere's ringing: its period goes with the shear wave's, E*/rho (1 - nu)/2, and the contact's
/// time with rho/Y. So a material has the effects of the stiffness E*/Y (1 - nu) in the reference set.
MaterialRatios of_same_ringing(const Lattice& grid, const MaterialRatios& m)
{
  const double stiffness = m.stiffness * (1 - m.poisson_ratio) / (1 - grid.main_poisson_ratio);
  return {std::clamp(stiffness, grid.stiffnesses.front(), grid.stiffnesses.back()), m.poisson_ratio, m.hardening};
}

}  // namespace

LawShape Atlas::shape(const MaterialRatios& m) const
{
  constexpr double all = std::numeric_limits<double>::infinity(), unloading_end = AtlasGrid::block_unloading_end;
  const std::vector<double> loading = grid_.weights(m, all), unloading = grid_.weights(m, unloading_end),
                            impacts = grid_.weights(m, unloading_end, of_same_ringing);
  LawShape result = LawShape::zero(onset_of(m), depth);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const LawShape& node = nodes_[k].shape;
    if (loading[k] != 0) result.add(loading[k], node, LawShape::Part::loading);
    if (unloading[k] != 0) result.add(unloading[k], node, LawShape::Part::unloading);
    if (impacts[k] != 0) result.add(impacts[k], node, LawShape::Part::impacts);
  }
  return result;
}

}  // namespace granulaw
