#include "atlas/midplane.hpp"

#include <fmt/format.h>

#include <limits>

#include "atlas/confident_bound.hpp"
#include "atlas/interpolation.hpp"
#include "base/error.hpp"

namespace granulaw {

MidplaneShapes::MidplaneShapes(MidplaneGrid grid, std::vector<ElasticCorrection> elastic, std::vector<Node> nodes,
                               std::vector<MidplaneCheck> checks)
    : grid_(std::move(grid)), elastic_(std::move(elastic)), nodes_(std::move(nodes)), checks_(std::move(checks))
{
  check_nodes(grid_, nodes_, "midplane material");
  if (elastic_.size() != grid_.poisson_ratios().size())
    fail("atlas", "its elastic midplane presses are not those of its Poisson's ratios");
  for (const Node& node : nodes_) {
    std::array<Spline, changed>& change = changes_.emplace_back();
    for (std::size_t f = 0; f < change.size(); ++f) change[f] = node.shape.by_q(LawShape::functions[f]);
  }
  const auto bound = [&](double MidplaneCheck::*error) { return confident_bound(checks_, error); };
  claimed_force_ = bound(&MidplaneCheck::error_force);
  claimed_restitution_ = bound(&MidplaneCheck::error_restitution);
  claimed_recovery_ = bound(&MidplaneCheck::error_recovery);
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
  LawShape result = free.as_skin_of(elastic(m.poisson_ratio), free.end);
  const std::vector<double> weights = grid_.weights(m, std::numeric_limits<double>::infinity());
  for (std::size_t node = 0; node < nodes_.size(); ++node)
    for (std::size_t k = 1; weights[node] != 0 && k < LawShape::nodes; ++k) {
      const double q = nodes_[node].shape.q(result.overlap(k));  // at the same overlap
      for (std::size_t f = 0; f < changed; ++f)
        (result.*LawShape::functions[f])[k] += weights[node] * changes_[node][f].value(q);
    }
  return result;
}

}  // namespace granulaw
