#include "atlas/midplane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "atlas/atlas.hpp"
#include "atlas/confident_bound.hpp"
#include "atlas/interpolation.hpp"

namespace granulaw {

namespace {

/// A node's share in a material.
struct Weighted
{
  std::size_t node;
  double weight;
};

/// The weights of a block of stiffnesses and hardenings whose first node is `first`; `stride` nodes lie
/// between two hardenings.
void add_weights(std::vector<Weighted>& sum, const MaterialRatios& m, const std::vector<double>& stiffnesses,
                 const std::vector<double>& hardenings, std::size_t first, std::size_t stride, double factor)
{
  const std::vector<double> along = interpolation_weights(logarithms(stiffnesses), std::log(m.stiffness));
  for (std::size_t i = 0; i < stiffnesses.size(); ++i) {
    if (along[i] == 0) continue;
    const double k = stiffnesses[i];
    const auto across =
        interpolation_weights(hardening_coordinates(k, hardenings), hardening_coordinate(k, m.hardening));
    for (std::size_t j = 0; j < hardenings.size(); ++j)
      if (across[j] != 0)
        sum.push_back({first + (i * hardenings.size() + j) * stride, factor * along[i] * across[j]});
  }
}

/// The reference set at m's stiffness and hardening, and for another Poisson's ratio what the block says it
/// changes.
std::vector<Weighted> weights_of(const MidplaneGrid& grid, const MaterialRatios& m)
{
  std::vector<Weighted> weights;
  add_weights(weights, m, grid.stiffnesses, grid.hardenings, 0, 1, 1.0);
  const std::vector<double> ratios = grid.poisson_ratios();
  const std::vector<double> by_ratio = interpolation_weights(ratios, m.poisson_ratio);
  const std::size_t main_nodes = grid.stiffnesses.size() * grid.hardenings.size(),
                    stride = grid.block_poisson_ratios.size();
  std::size_t place = 0;
  for (std::size_t r = 0; r < ratios.size(); ++r) {
    if (ratios[r] == grid.main_poisson_ratio) continue;
    if (by_ratio[r] != 0) {
      std::vector<Weighted> block;
      add_weights(block, m, grid.block_stiffnesses, grid.block_hardenings, main_nodes + place, stride,
                  by_ratio[r]);
      for (const Weighted& w : block) {
        weights.push_back(w);
        const std::size_t k = (w.node - main_nodes) / stride;
        const double stiffness = grid.block_stiffnesses[k / grid.block_hardenings.size()];
        const double hardening = grid.block_hardenings[k % grid.block_hardenings.size()];
        add_weights(weights, {stiffness, grid.main_poisson_ratio, hardening}, grid.stiffnesses,
                    grid.hardenings, 0, 1, -w.weight);
      }
    }
    ++place;
  }
  return weights;
}

}  // namespace

std::vector<double> MidplaneGrid::poisson_ratios() const
{
  std::vector<double> ratios = block_poisson_ratios;
  ratios.push_back(main_poisson_ratio);
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

std::vector<MaterialRatios> MidplaneGrid::materials() const
{
  std::vector<MaterialRatios> all;
  for (const double k : stiffnesses)
    for (const double h : hardenings) all.push_back({k, main_poisson_ratio, h});
  for (const double k : block_stiffnesses)
    for (const double h : block_hardenings)
      for (const double nu : block_poisson_ratios) all.push_back({k, nu, h});
  return all;
}

MidplaneShapes::MidplaneShapes(MidplaneGrid grid, std::vector<ElasticCorrection> elastic,
                               std::vector<Node> nodes, std::vector<MidplaneCheck> checks)
    : grid_(std::move(grid)),
      elastic_(std::move(elastic)),
      nodes_(std::move(nodes)),
      checks_(std::move(checks))
{
  const std::vector<MaterialRatios> expected = grid_.materials();
  if (elastic_.size() != grid_.poisson_ratios().size() || nodes_.size() != expected.size())
    fail("atlas", "has the wrong number of midplane presses", std::to_string(nodes_.size()),
         std::to_string(expected.size()));
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (!(nodes_[k].material == expected[k]))
      fail("atlas", fmt::format("midplane material {} is not the grid's", k));
  for (const Node& node : nodes_)
    changes_.push_back({Spline::through(node.change.force_reduction, 1.0),
                        Spline::through(node.change.widening, 1.0), Spline::through(node.change.residual, 1.0),
                        Spline::through(node.change.dissipation, 1.0),
                        Spline::through(node.change.hertz_share, 1.0)});
  std::vector<double> force, restitution, recovery;
  for (const MidplaneCheck& c : checks_) {
    force.push_back(std::abs(c.error_force));
    restitution.push_back(std::abs(c.error_restitution));
    recovery.push_back(std::abs(c.error_recovery));
  }
  claimed_force_ = confident_bound(std::move(force));
  claimed_restitution_ = confident_bound(std::move(restitution));
  claimed_recovery_ = confident_bound(std::move(recovery));
}

MidplaneShapes MidplaneShapes::with_checks(std::vector<MidplaneCheck> checks) const
{
  return {grid_, elastic_, nodes_, std::move(checks)};
}

ElasticCorrection MidplaneShapes::elastic(double poisson_ratio) const
{
  const std::vector<double> weights = interpolation_weights(grid_.poisson_ratios(), poisson_ratio);
  ElasticCorrection mean;
  for (std::size_t k = 0; k < elastic_.size(); ++k) mean.add(weights[k], elastic_[k]);
  return mean;
}

LawShape MidplaneShapes::shape(const MaterialRatios& m, const LawShape& free) const
{
  const double onset = onset_of(m), range = std::log(Atlas::depth / onset);
  LawShape result = free.as_skin_of(elastic(m.poisson_ratio), Atlas::depth);
  std::vector<double> weights(nodes_.size(), 0.0);
  for (const Weighted& w : weights_of(grid_, m)) weights[w.node] += w.weight;
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    if (weights[node] == 0) continue;
    const double node_range = std::log(Atlas::depth / nodes_[node].onset);
    for (std::size_t k = 1; k < LawShape::nodes; ++k) {
      // at the same overlap, counted from the end that all share
      const double u = 1 - (1 - static_cast<double>(k) / (LawShape::nodes - 1)) * range / node_range;
      if (u <= 0) continue;
      for (std::size_t f = 0; f < LawShape::functions.size(); ++f)
        (result.*LawShape::functions[f])[k] += weights[node] * changes_[node][f].value(u);
    }
  }
  return result;
}

}  // namespace granulaw
