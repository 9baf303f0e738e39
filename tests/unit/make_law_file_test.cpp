#include "characterise/body/law_body.hpp"
#include "characterise/check/check_law.hpp"
#include "characterise/file/make_law_file.hpp"

#include <set>

#include "base/version.hpp"
#include "law/pair_statement.hpp"
#include "law/law_file.hpp"
#include "scratch_folder.hpp"
#include "some_materials.hpp"
#include "own_atlas.hpp"

namespace granulaw::make_law_file_test {

class MakeLawFile : public ScratchFolder
{
};

TEST_F(MakeLawFile, FromTheAtlasWithoutARun)
{
  LawFileRequest request;
  request.materials = some_materials();
  request.atlas = &tests::atlas();
  request.radius_ratio = 2;
  const LawFilePlan plan = plan_law_file(request);
  const MadeLawFile made = make_law_file(plan);
  EXPECT_TRUE(made.runs.empty());
  EXPECT_EQ(made.law.pairs.size(), plan.pairs.size());
  EXPECT_EQ(made.law.provenance.at("version"), version());
  EXPECT_EQ(made.law.provenance.at("radius_ratio"), "2");
  EXPECT_EQ(made.law.provenance.at("material_hash.powder"), plan.bodies.at("powder").body->hash);
  EXPECT_FALSE(made.law.provenance.contains("runs_made"));

  write_law(made.law, path("law.h5"));
  const Law read = read_law(path("law.h5"));
  EXPECT_EQ(read.pairs, made.law.pairs);
  EXPECT_EQ(read.bodies.at("powder").certificate.origin, "atlas");
  auto provenance = read.provenance;
  EXPECT_EQ(provenance.erase("checksum"), 1u);  // of the file alone
  EXPECT_EQ(provenance, made.law.provenance);
}

/// Laws so shallow that they hardly leave Hertz cannot be composed: at no ratio of radii, or not at all of
/// them.
TEST_F(MakeLawFile, APairThatCannotBeComposedFollowsTheRule)
{
  LawFileRequest request;
  request.materials = some_materials();
  request.pairs = {{"powder", "glass"}};
  request.atlas = &tests::atlas();
  const auto made_to = [&](double depth) {
    request.depth = depth;
    return make_law_file(plan_law_file(request));
  };
  const MadeLawFile none = made_to(0.003);
  EXPECT_FALSE(none.law.pair_laws.contains("powder:glass"));
  EXPECT_NE(none.law.provenance.at("not_composed.powder:glass.1").find("begins to yield"), std::string::npos);
  const PairStatement stated = statement_of(none.law, resolve_pair(none.law, "powder", "glass", ""), "powder", "glass");
  EXPECT_EQ(stated.kind, LawKind::reduced);
  EXPECT_FALSE(stated.bound.stated());

  MadeLawFile some;
  for (double depth = 0.004; some.law.pair_laws.empty() && depth < 0.01; depth *= 1.01) some = made_to(depth);
  EXPECT_EQ(some.law.pair_laws.at("powder:glass").size(), 1u);
}

/// A soft elastic partner: every ratio has a law of its own, and none is left to the pair rule.
TEST_F(MakeLawFile, APairWithASoftElasticPartnerIsComposed)
{
  LawFileRequest request;
  Material hard = soft_powder(), soft = glass();
  hard.youngs_modulus = 0.7e9, hard.yield_stress = 7e6;
  soft.youngs_modulus = 20.8e6;
  request.materials = {"test", {{"hard", hard}, {"soft", soft}}, {}};
  request.pairs = {{"hard", "soft"}};
  request.radius_ratio = 2;
  request.atlas = &tests::atlas();
  const LawFilePlan plan = plan_law_file(request);
  const MadeLawFile made = make_law_file(plan);
  ASSERT_EQ(made.law.pair_laws.at("hard:soft").size(), plan.pairs.at(0).composed_at.size());
  for (const TwoBodyLaw& own : made.law.pair_laws.at("hard:soft"))
    EXPECT_LE(own.law.certificate.atlas_error_force, 0.042);
}

/// A rough, shallow, rate-independent law: two presses, some seconds.
TEST_F(MakeLawFile, ByRunsThatTheFarmCounts)
{
  LawFileRequest request;
  request.materials = some_materials();
  request.pairs = {{"powder", "wall"}};
  request.depth = 0.05;
  request.damage_number = 0;
  request.tolerance = 0.3;
  ThreadFarm farm(2, RunCache(path("runs")));
  double last = 0;
  std::set<std::string> told;
  const Progress progress = [&](double done, const std::string& what) {
    EXPECT_GE(done, 0);
    EXPECT_LE(done, 1);
    last = done;
    told.insert(what.substr(0, what.find(':')));
  };
  const LawFilePlan plan = plan_law_file(request);
  const MadeLawFile made = make_law_file(plan, &farm, progress);
  EXPECT_GT(made.runs.at("powder").made, 0u);
  EXPECT_LE(made.runs.at("powder").sampling_error, request.tolerance);
  EXPECT_EQ(made.law.provenance.at("runs_made"), std::to_string(farm.count().made));
  EXPECT_TRUE(made.law.provenance.contains("sampling_plan.powder"));
  EXPECT_EQ(told, std::set<std::string>{"powder"});
  EXPECT_GT(last, 0);

  // the same again: out of the cache, to the bit
  ThreadFarm again(1, RunCache(path("runs")));
  const MadeLawFile same = make_law_file(plan, &again);
  EXPECT_EQ(again.count().made, 0);
  EXPECT_EQ(same.law.bodies.at("powder").curve.table().force.value,
            made.law.bodies.at("powder").curve.table().force.value);
}

TEST(CheckLaw, ANegativeNumberOfImpactsIsRefused)
{
  LawCheckRequest request;
  request.impacts = -1;
  EXPECT_THROW(check_law({}, request), Error);
}

TEST_F(MakeLawFile, WhatProgressThrowsStopsIt)
{
  LawFileRequest request;
  request.materials = some_materials();
  request.pairs = {{"powder", "wall"}};
  struct Stop
  {
  };
  ThreadFarm farm(1);
  EXPECT_THROW(make_law_file(plan_law_file(request), &farm, [](double, const std::string&) { throw Stop{}; }),
               Stop);
}

}  // namespace granulaw::make_law_file_test
