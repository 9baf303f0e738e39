#include "characterise/file/law_file_plan.hpp"

#include <fmt/format.h>

#include "atlas/composed_law.hpp"
#include "characterise/body/law_material.hpp"
#include "own_atlas.hpp"
#include "refusal.hpp"
#include "scratch_folder.hpp"
#include "some_materials.hpp"

namespace granulaw::law_file_plan_test {

using tests::atlas;

LawFileRequest request(std::vector<std::pair<std::string, std::string>> pairs = {})
{
  LawFileRequest r;
  r.materials = some_materials();
  r.pairs = std::move(pairs);
  r.atlas = &atlas();
  return r;
}

TEST(LawFilePlan, WithoutPairsEveryMaterialMeetsEveryOtherItselfAndTheWall)
{
  const LawFilePlan plan = plan_law_file(request());
  std::string names;
  for (const LawFilePlan::Pair& pair : plan.pairs) names += pair.name() + " ";
  EXPECT_EQ(names,
            "glass:glass glass:powder glass:stronger glass:wall powder:powder powder:stronger powder:wall "
            "stronger:stronger stronger:wall ");
  EXPECT_EQ(plan.bodies.size(), 3u);
  EXPECT_FALSE(plan.needs_runs());
}

/// Every pair of 30 materials fits; with all ratios of radii to 10 the plan is refused before any work.
TEST(LawFilePlan, CountsTheLawsOfAFile)
{
  LawFileRequest r = request();
  const Material powder = r.materials.materials.at("powder");
  r.materials.materials.clear();
  for (int k = 0; k < 30; ++k) r.materials.materials[fmt::format("m{}", k)] = powder;
  EXPECT_EQ(plan_law_file(r).pairs.size(), 30u * 31 / 2 + 30);
  r.radius_ratio = 10;
  expect_error("495 pairs, with a law for each ratio of radii, are too many for one file", [&] { plan_law_file(r); });
}

TEST(LawFilePlan, TheWallMayStandFirst)
{
  const LawFilePlan plan = plan_law_file(request({{"wall", "grain"}}));
  EXPECT_EQ(plan.pairs.at(0).name(), "grain:wall");
}

TEST(LawFilePlan, SaysWhyABodyNeedsRuns)
{
  const LawFilePlan layered = plan_law_file(request({{"coated", "wall"}, {"powder", "wall"}}));
  EXPECT_EQ(layered.bodies.at("coated").why_runs, "its law is its own");
  EXPECT_TRUE(layered.bodies.at("powder").from_atlas());
  EXPECT_TRUE(layered.needs_runs());

  LawFileRequest r = request({{"powder", "wall"}, {"glass", "wall"}});
  r.atlas = nullptr;
  r.words.no_atlas = "it was lost";
  for (const auto& [name, planned] : plan_law_file(r).bodies) EXPECT_EQ(planned.why_runs, "it was lost");

  r = request({{"powder", "wall"}});
  r.materials.materials["powder"].yield_stress = 200e6;
  EXPECT_NE(plan_law_file(r).bodies.at("powder").why_runs.find("E*/Y = 15 lies outside"), std::string::npos);
}

/// Before anything is run: both ends of what runs reach.
TEST(LawFilePlan, RefusesARangeThatRunsDoNotReach)
{
  LawFileRequest r = request({{"powder", "wall"}});
  Material& powder = r.materials.materials["powder"];
  const double e_star = powder.e_star();
  powder.yield_stress = e_star / 1e6;
  expect_error("yields at overlaps too small to be run", [&] { plan_law_file(r); });
  powder.yield_stress = e_star / 2e4;
  EXPECT_FALSE(plan_law_file(r).bodies.at("powder").from_atlas());
  powder.yield_stress = e_star / 11;
  expect_error("yields too late", [&] { plan_law_file(r); });
}

TEST(LawFilePlan, UnlikePairsOfTheAtlasAreComposed)
{
  LawFileRequest r = request({{"powder", "glass"}, {"powder", "powder"}, {"powder", "wall"}});
  constexpr double wall = std::numeric_limits<double>::infinity();
  LawFilePlan plan = plan_law_file(r);
  EXPECT_EQ(plan.pairs[0].composed_at, (std::vector<double>{0, 1, wall}));
  EXPECT_EQ(plan.pairs[1].composed_at, (std::vector<double>{wall}));  // like spheres: its own law
  EXPECT_TRUE(plan.pairs[2].composed_at.empty());
  EXPECT_FALSE(plan.needs_runs());

  r.thick_walls = false;
  r.radius_ratio = 2;
  plan = plan_law_file(r);
  const std::vector<double>& ratios = plan.pairs[0].composed_at;
  ASSERT_EQ(ratios.size(), 9u);
  EXPECT_DOUBLE_EQ(ratios.front(), 0.5);
  EXPECT_DOUBLE_EQ(ratios[4], 1);
  EXPECT_DOUBLE_EQ(ratios.back(), 2);
  for (std::size_t k = 1; k < ratios.size(); ++k)  // half a step of 0.05 at most in R_s/(R_s + R_h)
    EXPECT_LT(1 / (1 + ratios[k - 1]) - 1 / (1 + ratios[k]), 0.0501);
  EXPECT_EQ(plan.pairs[1].composed_at.size(), 4u);  // over 1 only
  EXPECT_GT(plan.pairs[1].composed_at.front(), 1);

  r.atlas = nullptr;
  for (const LawFilePlan::Pair& pair : plan_law_file(r).pairs) EXPECT_TRUE(pair.composed_at.empty());
}

TEST(LawFilePlan, APairWithoutAComposedLawMayHaveItsOwn)
{
  LawFileRequest r = request({{"powder", "glass"}, {"powder", "powder"}, {"powder", "wall"}});
  r.atlas = nullptr;
  LawFilePlan plan = plan_law_file(r);
  EXPECT_TRUE(plan.pairs[0].worth_own_law);
  EXPECT_FALSE(plan.pairs[0].own_law);
  for (int k : {1, 2}) EXPECT_FALSE(plan.pairs[k].worth_own_law);
  r.own_laws = true;
  r.radius_ratio = 1;
  plan = plan_law_file(r);
  EXPECT_TRUE(plan.pairs[0].own_law);
  EXPECT_TRUE(plan.pairs[0].composed_at.empty());
  EXPECT_TRUE(plan.needs_runs());
}

/// Impacts correct what is composed, at each of its ratios of radii, where its own error is above the tolerance: no run
/// is spent on a composed law that is good enough.
TEST(LawFilePlan, AnOwnLawBesideTheAtlasIsComposedFirst)
{
  LawFileRequest r = request({{"powder", "glass"}});
  r.own_laws = true;
  r.radius_ratio = 3;
  const LawMaterial powder = law_material("powder", r.materials.materials.at("powder")),
                    glass = law_material("glass", r.materials.materials.at("glass"));
  const ComposedError composed = composed_error(glass.e_star() / powder.e_star());
  r.tolerance = 0.99 * std::max(composed.force, composed.restitution);
  LawFilePlan plan = plan_law_file(r);
  EXPECT_TRUE(plan.pairs[0].own_law);
  EXPECT_TRUE(plan.needs_runs());
  EXPECT_GT(plan.pairs[0].composed_at.size(), 2u);
  r.tolerance = 1.01 * std::max(composed.force, composed.restitution);
  plan = plan_law_file(r);
  EXPECT_FALSE(plan.pairs[0].own_law);
  EXPECT_FALSE(plan.needs_runs());
}

/// The atlas's equivalent spheres serve a homogeneous sphere of any rate-independent flow law.
TEST(LawFilePlan, AFlowLawOfAnyKindIsComposedOnceItsOwnLawIsMade)
{
  LawFileRequest r = request({{"powder", "glass"}});
  r.materials.materials["powder"].hardening = {"voce", {{"saturation_stress", {150e6}}, {"strain", {0.1}}}};
  const LawFilePlan plan = plan_law_file(r);
  EXPECT_FALSE(plan.bodies.at("powder").from_atlas());
  EXPECT_FALSE(plan.pairs[0].composed_at.empty());
  EXPECT_FALSE(plan.pairs[0].own_law);
}

TEST(LawFilePlan, TheWeakerOfTwoYields)
{
  const LawMaterial weak = law_material("weak", soft_powder()), elastic = law_material("glass", glass());
  EXPECT_EQ(unlike_pair(elastic, weak, 2).yielding.name, "weak");
  EXPECT_EQ(unlike_pair(weak, elastic, 2).yielding.name, "weak");
  EXPECT_EQ(unlike_pair(weak, elastic, 2).radius_ratio, 2);
}

TEST(LawFilePlan, RefusesWhatCannotBeMade)
{
  const auto refuses = [](const std::string& part, const std::function<void(LawFileRequest&)>& spoil) {
    LawFileRequest r = request({{"powder", "wall"}});
    spoil(r);
    expect_error(part, [&] { plan_law_file(r); });
  };
  refuses("no material or particle 'powdr'", [](auto& r) { r.pairs = {{"powdr", "wall"}}; });
  refuses("pair: 'powder:wall' and 'powder:wall' are one pair", [](auto& r) {
    r.pairs = {{"powder", "glass"}, {"powder", "wall"}, {"wall", "powder"}};
  });
  refuses("pair coated:glass", [](auto& r) { r.pairs = {{"coated", "glass"}}; });
  refuses("name a particle of it, --pair PARTICLE:wall", [](auto& r) {
    r.materials.materials["powder"] = rate_dependent_powder();
    r.words.pair = "--pair";
  });
  refuses("slowest: no body of the pairs depends on the rate", [](auto& r) { r.slowest = 1; });
  refuses("slowest: is no slower than the fastest impact of 'rated' (damage_number): found 60 m/s",
          [](auto& r) {
            r.pairs = {{"rated", "wall"}};
            r.slowest = 60;  // the fastest: 0.25 sqrt(Y/rho) = 64.5 m/s
          });
  refuses("depth: cannot be used", [](auto& r) { r.depth = 0; });
  refuses("depth: cannot be used", [](auto& r) { r.depth = 0.6; });
  refuses("damage_number: cannot be used", [](auto& r) { r.damage_number = 1; });
  refuses("tolerance: cannot be used", [](auto& r) { r.tolerance = std::nan(""); });
  refuses("radius_ratio: cannot be used", [](auto& r) { r.radius_ratio = 0.5; });
  refuses("radius_ratio: cannot be used", [](auto& r) { r.radius_ratio = 200; });  // no file holds it
}

}  // namespace granulaw::law_file_plan_test
