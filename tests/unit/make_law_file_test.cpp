#include "characterise/make_law_file.hpp"

#include <set>

#include "base/version.hpp"
#include "law/law_file.hpp"
#include "scratch_folder.hpp"
#include "some_materials.hpp"

namespace granulaw {
namespace {

class MakeLawFile : public ScratchFolder
{
};

TEST_F(MakeLawFile, FromTheAtlasWithoutARun)
{
  LawFileRequest request;
  request.materials = some_materials();
  const Atlas atlas = read_atlas(GRANULAW_ATLAS_FILE);
  request.atlas = &atlas;
  request.radius_ratio = 2;
  const LawFilePlan plan = plan_law_file(request);
  const MadeLawFile made = make_law_file(plan);
  EXPECT_TRUE(made.runs.empty());
  EXPECT_EQ(made.law.pairs.size(), plan.pairs.size());
  EXPECT_EQ(made.law.provenance.at("version"), version());
  EXPECT_EQ(made.law.provenance.at("reduction_radius_ratio"), "2");
  EXPECT_EQ(made.law.provenance.at("material_hash.powder"), plan.bodies.at("powder").body.hash);
  EXPECT_FALSE(made.law.provenance.contains("runs_made"));

  write_law(made.law, path("law.h5"));
  const Law read = read_law(path("law.h5"));
  EXPECT_EQ(read.pairs, made.law.pairs);
  EXPECT_EQ(read.bodies.at("powder").certificate.origin, "atlas");
  auto provenance = read.provenance;
  EXPECT_EQ(provenance.erase("checksum"), 1u);  // of the file alone
  EXPECT_EQ(provenance, made.law.provenance);
}

/// Against glass ten times the body's size the pair yields beyond half the depth that is asked for: too late
/// for a law of its own.
TEST_F(MakeLawFile, APairThatCannotBeComposedFollowsTheRule)
{
  LawFileRequest request;
  request.materials = some_materials();
  request.materials.materials["powder"].yield_stress = 140e6;  // E*/Y = 21
  request.pairs = {{"powder", "glass"}};
  const Atlas atlas = read_atlas(GRANULAW_ATLAS_FILE);
  request.atlas = &atlas;
  const double onset = make_law_file(plan_law_file(request)).law.bodies.at("powder").curve.onset();
  request.depth = 1.5 * onset;
  const LawFilePlan plan = plan_law_file(request);
  const MadeLawFile made = make_law_file(plan);
  EXPECT_FALSE(made.law.pair_laws.contains("powder:glass"));
  EXPECT_NE(made.law.provenance.at("not_composed.powder:glass").find("begins to yield"), std::string::npos);
  EXPECT_GT(made.law.pairs.at(0).reduction_error_force, 0);
  EXPECT_EQ(made.law.pairs.at(0).reduction_error_force, plan.pairs.at(0).by_rule.force);
}

/// A rough, shallow, rate-free law: two presses, some seconds.
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
  EXPECT_TRUE(made.law.provenance.contains("survey.powder"));
  EXPECT_EQ(told, std::set<std::string>{"powder"});
  EXPECT_GT(last, 0);

  // the same again: out of the cache, to the bit
  ThreadFarm again(1, RunCache(path("runs")));
  const MadeLawFile same = make_law_file(plan, &again);
  EXPECT_EQ(again.count().made, 0);
  EXPECT_EQ(same.law.bodies.at("powder").curve.table().force.value,
            made.law.bodies.at("powder").curve.table().force.value);
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

}  // namespace
}  // namespace granulaw
