// Links granulaw::atlas alone: a law from a material without solver, farm and HDF5.
#include "atlas/atlas_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "atlas/law_without_runs.hpp"
#include "base/error.hpp"
#include "law/replay.hpp"

namespace granulaw::atlas_numbers_test {

/// Hardening and stiffness change the shape linearly in their coordinates, as a cubic interpolation keeps it.
LawShape shape_of(const MaterialRatios& m)
{
  LawShape shape = LawShape::zero();
  shape.elastic = {0.87, 0.4, -0.2};
  const double rise = 1 + 0.1 * std::log(m.stiffness), soft = 0.5 / (1 + hardening_coordinate(m.stiffness, m.hardening));
  for (int k = 0; k < LawShape::nodes; ++k) {
    const double u = k / (LawShape::nodes - 1.0);
    const auto n = static_cast<std::size_t>(k);
    shape.force_reduction[n] = soft * rise * u * u, shape.widening[n] = 0.1 * u * u;
    shape.residual[n] = rise * u * u, shape.dissipation[n] = rise * u * u;
  }
  for (LawShape::VelocityEffect& effect : shape.velocity_effects) effect.log_overlap = 1.5;
  return shape;
}

Atlas small_atlas()
{
  AtlasGrid grid;
  std::vector<Atlas::Node> nodes;
  for (const MaterialRatios& m : grid.materials()) nodes.push_back({m, shape_of(m)});
  std::vector<ElasticSphere> elastic;
  for (const double nu : grid.poisson_ratios()) elastic.push_back({nu, {{0.87, 0.4, -0.2, 0.1}, 1e-3}, 1e-3});
  std::vector<AtlasCheck> checks(60, {{100, 0.3, 0}, 0.1, 0.003, 0.001, 0.002});
  return {grid, std::move(nodes), std::move(elastic), std::move(checks)};
}

LawMaterial powder()
{
  LawMaterial m;
  m.name = "powder", m.density = 1500, m.youngs_modulus = 10e9, m.poisson_ratio = 0.3, m.yield_stress = 100e6;
  return m;
}

LawMaterial glass()
{
  LawMaterial m;
  m.name = "glass", m.density = 2500, m.youngs_modulus = 70e9, m.poisson_ratio = 0.22;
  return m;
}

TEST(AtlasNumbers, MakeTheSameAtlasAgain)
{
  const Atlas atlas = small_atlas();
  const std::vector<double> numbers = numbers_of(atlas);
  const Atlas again = atlas_of(numbers);
  EXPECT_EQ(numbers_of(again), numbers);
  EXPECT_EQ(again.claimed_force(), atlas.claimed_force());
  EXPECT_EQ(again.shape({137, 0.25, 0.01}).dissipation, atlas.shape({137, 0.25, 0.01}).dissipation);
}

TEST(AtlasNumbers, OthersAreRefused)
{
  std::vector<double> numbers = numbers_of(small_atlas());
  EXPECT_THROW(atlas_of({}), Error);
  EXPECT_THROW(atlas_of(std::span(numbers).first(numbers.size() - 1)), Error);
  EXPECT_THROW(atlas_of(std::span(numbers).first(3)), Error);
  std::vector<double> longer = numbers;
  longer.push_back(0);
  EXPECT_THROW(atlas_of(longer), Error);
  const double version = numbers[0];
  numbers[0] = version + 1;
  EXPECT_THROW(atlas_of(numbers), Error);
  numbers[0] = version, numbers[1] = 1e9;  // the length of the first list
  EXPECT_THROW(atlas_of(numbers), Error);
  numbers[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(atlas_of(numbers), Error);
}

/// A body on a rigid wall, its like pair, and a composed pair.
TEST(LawWithoutRuns, OfABodyItsLikeAndAComposedPair)
{
  const Atlas atlas = atlas_of(numbers_of(small_atlas()));
  const LawMaterial p = powder(), g = glass();
  SceneSizes sizes;
  sizes.radius_ratio = 2;
  std::vector<PlannedPair> pairs{plan_pair(p, nullptr, sizes, true), plan_pair(p, &p, sizes, true),
                                 plan_pair(p, &g, sizes, true)};
  LawRange range;
  range.fastest = 0;
  const Law law = law_without_runs(atlas, {p, g}, pairs, range);
  EXPECT_EQ(law.bodies.size(), 2u);
  EXPECT_EQ(law.bodies.at("powder").certificate.origin, "atlas");
  EXPECT_EQ(law.pair_list(), "powder:wall, powder:powder, powder:glass");
  EXPECT_EQ(law.pair_laws.at("powder:glass").size(), pairs[2].composed_at.size());
  EXPECT_EQ(law.pair_laws.at("powder:glass").front().law.certificate.origin, composed_origin);
  const auto restitution = [&](const char* partner, double m_eff, double r_eff) {
    return replay_collision(resolve_pair(law, "powder", partner, "test"), r_eff, m_eff, 1.0).restitution;
  };
  const double mass = 4.0 / 3.0 * M_PI * 1500 * 1e-9;
  for (const double e : {restitution("wall", mass, 1e-3), restitution("powder", mass / 2, 5e-4),
                         restitution("glass", mass / 2, 5e-4)}) {
    EXPECT_GT(e, 0.2);
    EXPECT_LT(e, 1);
  }
}

}  // namespace granulaw::atlas_numbers_test
