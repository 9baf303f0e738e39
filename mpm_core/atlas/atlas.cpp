#include "atlas/atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "base/scales.hpp"
#include "atlas/body_numbers.hpp"
#include "atlas/confident_bound.hpp"
#include "atlas/interpolation.hpp"

namespace granulaw {

namespace {

/// Below this product of H/E and E*/Y a hardening adds less than a tenth of Y at a strain of one.
constexpr double weakest_seen = 0.1;

/// Node values that are wanted at the main Poisson's ratio as well.
std::vector<double> with(std::vector<double> values, double another)
{
  values.push_back(another);
  std::sort(values.begin(), values.end());
  return values;
}

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

std::vector<double> AtlasGrid::hardenings_at(double stiffness) const
{
  std::vector<double> seen;
  for (const double h : hardenings)
    if (h == 0 || h * stiffness >= weakest_seen) seen.push_back(h);
  return seen;
}

std::vector<MaterialRatios> AtlasGrid::main_plane() const
{
  std::vector<MaterialRatios> materials;
  for (const double k : stiffnesses)
    for (const double h : hardenings_at(k)) materials.push_back({k, main_poisson_ratio, h});
  return materials;
}

std::vector<MaterialRatios> AtlasGrid::block() const
{
  std::vector<MaterialRatios> materials;
  for (const double k : block_stiffnesses)
    for (const double h : block_hardenings)
      for (const double nu : block_poisson_ratios) materials.push_back({k, nu, h});
  return materials;
}

std::vector<double> AtlasGrid::poisson_ratios() const
{
  return with(block_poisson_ratios, main_poisson_ratio);
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
  std::vector<MaterialRatios> expected = grid_.main_plane();
  const std::vector<MaterialRatios> block = grid_.block();
  expected.insert(expected.end(), block.begin(), block.end());
  if (expected.size() != nodes_.size())
    fail("atlas", "has the wrong number of materials", std::to_string(nodes_.size()),
         std::to_string(expected.size()));
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (!(nodes_[k].material == expected[k])) fail("atlas", fmt::format("material {} is not the grid's", k));
  for (Node& node : nodes_) node.shape.onset = onset_of(node.material), node.shape.end = depth;
  std::vector<double> force, restitution, solver;
  for (const AtlasCheck& c : checks_) {
    force.push_back(std::abs(c.error_force));
    restitution.push_back(std::abs(c.error_restitution));
    solver.push_back(c.solver_estimate);
  }
  claimed_force_ = confident_bound(std::move(force));
  claimed_restitution_ = confident_bound(std::move(restitution));
  solver_error_ = percentile95(std::move(solver));
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

LawShape Atlas::main_shape(double stiffness, double hardening) const
{
  LawShape result = LawShape::zero(onset_of({stiffness, grid_.main_poisson_ratio, hardening}), depth);
  std::size_t next = 0;
  const std::vector<double> along = interpolation_weights(logarithms(grid_.stiffnesses), std::log(stiffness));
  for (std::size_t i = 0; i < grid_.stiffnesses.size(); ++i) {
    const double k = grid_.stiffnesses[i];
    const std::vector<double> hardenings = grid_.hardenings_at(k);
    const auto across =
        interpolation_weights(hardening_coordinates(k, hardenings), hardening_coordinate(k, hardening));
    for (const double weight : across) {
      if (along[i] != 0 && weight != 0) result.add(along[i] * weight, nodes_[next].shape);
      ++next;
    }
  }
  return result;
}

LawShape Atlas::partner(const MaterialRatios& m) const
{
  LawShape result = main_shape(m.stiffness, m.hardening);
  const double same_ring = m.stiffness * (1 - m.poisson_ratio) / (1 - grid_.main_poisson_ratio);
  result.velocity_effects =
      main_shape(std::clamp(same_ring, grid_.stiffnesses.front(), grid_.stiffnesses.back()), m.hardening)
          .velocity_effects;
  return result;
}

LawShape Atlas::shape(const MaterialRatios& m) const
{
  LawShape result = partner(m);
  result.onset = onset_of(m);
  const std::vector<double> ratios = grid_.poisson_ratios();
  const std::vector<double> by_ratio = interpolation_weights(ratios, m.poisson_ratio);
  const std::vector<double>& stiffnesses = grid_.block_stiffnesses;
  const std::vector<double> unloading(
      stiffnesses.begin(),
      std::upper_bound(stiffnesses.begin(), stiffnesses.end(), AtlasGrid::block_unloading_end));
  const std::vector<double> along = interpolation_weights(logarithms(stiffnesses), std::log(m.stiffness));
  std::vector<double> along_unloading = interpolation_weights(logarithms(unloading), std::log(m.stiffness));
  along_unloading.resize(stiffnesses.size(), 0.0);
  std::size_t next = grid_.main_plane().size();
  for (std::size_t i = 0; i < stiffnesses.size(); ++i) {
    const double k = stiffnesses[i];
    const auto across = interpolation_weights(hardening_coordinates(k, grid_.block_hardenings),
                                              hardening_coordinate(k, m.hardening));
    for (std::size_t j = 0; j < grid_.block_hardenings.size(); ++j)
      for (std::size_t r = 0; r < ratios.size(); ++r) {
        if (ratios[r] == grid_.main_poisson_ratio) continue;
        const Node& node = nodes_[next++];
        if (across[j] * by_ratio[r] == 0 || (along[i] == 0 && along_unloading[i] == 0)) continue;
        LawShape change = node.shape;
        change.add(-1, partner(node.material));
        result.add_loading(along[i] * across[j] * by_ratio[r], change);
        result.add_unloading(along_unloading[i] * across[j] * by_ratio[r], change);
      }
  }
  return result;
}

}  // namespace granulaw
