#include "radii_build.hpp"

#include <algorithm>
#include <limits>

#include "characterise/fit/fit_curve.hpp"
#include "material_runs.hpp"

namespace granulaw {

namespace {

SamplingPlan plan_for(const MaterialRatios& m)
{
  SamplingPlan plan = plan_sampling(sphere_of(m));
  plan.slow_impacts.clear(), plan.fast_speeds.clear();
  return plan;
}

/// The node of the next softer material that is otherwise the same; null: there is none.
const LatticeNode* softer(const std::vector<LatticeNode>& nodes, const MaterialRatios& m)
{
  const auto found = std::find_if(nodes.rbegin(), nodes.rend(), [&](const LatticeNode& node) {
    return node.material.poisson_ratio == m.poisson_ratio && node.material.hardening == m.hardening;
  });
  return found == nodes.rend() ? nullptr : &*found;
}

}  // namespace

std::vector<RunJob> radius_jobs(const RadiusGrid& grid, const RunSource& source)
{
  std::vector<RunJob> jobs;
  for (const MaterialRatios& m : grid.materials()) add_jobs(jobs, m, plan_for(m), source);
  return jobs;
}

Atlas with_radii(const Atlas& atlas, const RadiusGrid& grid, const std::vector<RunOutcome>& outcomes)
{
  std::vector<LatticeNode> known;
  std::size_t next = 0;
  for (const MaterialRatios& m : grid.materials()) {
    ContactRecords records = records_of(m, plan_for(m), outcomes, next);
    LawShape shape = LawShape::zero(onset_of(m), Atlas::depth);
    shape.elastic = atlas.shape(m).elastic;
    std::erase_if(records.slow, [&](const ContactRecord& r) { return r.depth <= shape.onset; });
    LawShape below;
    const LatticeNode* softer_node = softer(known, m);
    const bool has_gap = softer_node && records.slow.front().depth > 2 * shape.onset;
    if (has_gap) below = softer_node->shape.at_range(shape.onset, Atlas::depth);
    fit_radii(shape, records.slow, has_gap ? &below : nullptr);
    known.push_back({m, std::move(shape)});
  }
  std::vector<Atlas::Node> nodes = atlas.nodes();
  for (Atlas::Node& node : nodes) {
    const std::vector<double> weights =
        grid.weights({node.material.stiffness, grid.main_poisson_ratio, node.material.hardening}, std::numeric_limits<double>::infinity());
    for (std::size_t f = LawShape::first_radius; f < LawShape::function_count; ++f) {
      std::vector<double>& values = node.shape.*LawShape::functions[f];
      std::fill(values.begin(), values.end(), 0.0);
      for (std::size_t k = 0; k < known.size(); ++k)
        for (std::size_t n = 0; weights[k] != 0 && n < values.size(); ++n)
          values[n] += weights[k] * (known[k].shape.*LawShape::functions[f])[n];
    }
  }
  return Atlas(atlas.grid(), std::move(nodes), atlas.elastic_spheres(), atlas.checks(), atlas.midplane());
}

}  // namespace granulaw
