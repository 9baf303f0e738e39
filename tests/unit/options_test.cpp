#include "liggghts_plugin/deck/options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "liggghts_plugin/contact/mpm_physics.hpp"
#include "liggghts_plugin/contact/thornton_physics.hpp"
#include "refusal.hpp"

namespace granulaw::plugin::options_test {

using Words = std::vector<std::string>;

const ModelInfo& mpm = model_info<MpmPhysics>;
const ModelInfo& thornton = model_info<ThorntonPhysics>;
constexpr bool pair = false, wall = true;

Words words_of(const std::string& text)
{
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Options of a command, and the words left for LIGGGHTS.
struct Parsed
{
  Options options;
  Words rest;
};

Parsed parse(const std::string& text, const ModelInfo& model = mpm, bool is_wall = pair)
{
  Parsed parsed;
  parsed.options = parse_options(model, is_wall, "HERE", words_of(text), parsed.rest);
  return parsed;
}

Options options(const std::string& text, const ModelInfo& model = mpm, bool is_wall = pair)
{
  return parse(text, model, is_wall).options;
}

/// The sentence that refuses the words; empty: they are accepted.
std::string refusal(const std::string& text, const ModelInfo& model = mpm, bool is_wall = pair)
{
  return sentence_of([&] { parse(text, model, is_wall); });
}

std::string refused_at_wall(const std::string& text)
{
  return refusal(text, mpm, wall);
}

bool holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(Options, NothingSaidIsTheDefault)
{
  EXPECT_EQ(options(""), Options{});
  EXPECT_EQ(options("", thornton, wall), Options{});
}

TEST(Options, Law)
{
  EXPECT_EQ(options("law a.h5").own_words("law"), Words{"a.h5"});
  EXPECT_EQ(options("law a.h5", mpm, wall).own_words("law"), Words{"a.h5"});
  EXPECT_EQ(refusal("law"), "HERE: 'law' needs a value");
  EXPECT_TRUE(holds(refusal("law a.h5", thornton), "HERE: unknown keyword 'law'"));
}

TEST(Options, MaterialsEndAtTheNextKeyword)
{
  const Options said = options("materials a b c law x.h5");
  EXPECT_EQ(said.own_words("materials"), (Words{"a", "b", "c"}));
  EXPECT_EQ(said.own_words("law"), Words{"x.h5"});
  EXPECT_EQ(options("materials a limitForce on").own_words("materials"), Words{"a"});
  EXPECT_EQ(refusal("materials"), "HERE: 'materials' needs one name for each atom type");
  EXPECT_EQ(refusal("materials law x.h5"), "HERE: 'materials' needs one name for each atom type");
  EXPECT_TRUE(holds(refusal("materials a", thornton), "unknown keyword 'materials'"));
}

TEST(Options, MaterialsEndAtWordsThatAreMisplaced)
{
  EXPECT_TRUE(holds(refusal("materials a rolling_friction cdt"), "'rolling_friction' is out of order"));
  EXPECT_TRUE(holds(refused_at_wall("materials a primitive"), "'primitive' must stand before"));
  EXPECT_TRUE(holds(refusal("materials a meanCurvature yes"), "unknown keyword 'meanCurvature'"));
  EXPECT_EQ(options("materials a primitive").own_words("materials"), (Words{"a", "primitive"}));  // no wall
}

TEST(Options, BeyondRange)
{
  EXPECT_EQ(options("beyondRange stop").beyond_range, BeyondRange::stop);
  EXPECT_EQ(options("beyondRange continue").beyond_range, BeyondRange::proceed);
  EXPECT_EQ(options("beyondRange crush").beyond_range, BeyondRange::crush);
  EXPECT_EQ(refusal("beyondRange on"),
            "HERE: 'beyondRange' has an unknown value: found 'on', allowed is stop, continue, crush");
  EXPECT_TRUE(holds(refusal("beyondRange stop", thornton), "unknown keyword 'beyondRange'"));
}

TEST(Options, TangentialDampingRatio)
{
  EXPECT_EQ(options("tangentialDampingRatio 0.25").tangential_damping, 0.25);
  EXPECT_EQ(options("tangentialDampingRatio 0").tangential_damping, 0.0);
  EXPECT_EQ(options("tangentialDampingRatio 1").tangential_damping, 1.0);
  EXPECT_EQ(options("tangentialDampingRatio 1e-320").tangential_damping, 1e-320);
  EXPECT_EQ(refusal("tangentialDampingRatio 1.5"),
            "HERE: 'tangentialDampingRatio' is out of range: found 1.5, allowed is 0 to 1");
  EXPECT_EQ(refusal("tangentialDampingRatio -0.1"),
            "HERE: 'tangentialDampingRatio' is out of range: found -0.1, allowed is 0 to 1");
  for (const char* no_number : {"much", "0.5x", "nan", "inf", "1e999"})
    EXPECT_EQ(refusal(std::string("tangentialDampingRatio ") + no_number),
              std::string("HERE: 'tangentialDampingRatio' needs a number: found '") + no_number + "'");
  EXPECT_EQ(refusal("tangentialDampingRatio"), "HERE: 'tangentialDampingRatio' needs a value");
}

TEST(Options, TangentialStiffness)
{
  EXPECT_EQ(options("tangentialStiffness computed").tangential_computed, true);
  EXPECT_EQ(options("tangentialStiffness mindlin").tangential_computed, false);
  EXPECT_EQ(refusal("tangentialStiffness hertz"),
            "HERE: 'tangentialStiffness' has an unknown value: found 'hertz', allowed is computed, mindlin");
}

TEST(Options, ElasticDamping)
{
  EXPECT_EQ(options("elasticDamping off").elastic_damping, (ElasticDamping{0.0, false}));
  EXPECT_EQ(options("elasticDamping restitution").elastic_damping, (ElasticDamping{0.0, true}));
  EXPECT_EQ(options("elasticDamping 0.02").elastic_damping, (ElasticDamping{0.02, false}));
  EXPECT_EQ(refusal("elasticDamping some"),
            "HERE: 'elasticDamping' has an unknown value: found 'some', allowed is a number from 0 to 1, "
            "off, restitution");
  EXPECT_EQ(refusal("elasticDamping 0.1s"), "HERE: 'elasticDamping' needs a number: found '0.1s'");
  EXPECT_EQ(refusal("elasticDamping 2"),
            "HERE: 'elasticDamping' is out of range: found 2, allowed is 0 to 1");
}

TEST(Options, Stretch)
{
  EXPECT_EQ(options("stretch 1").stretch, 1.0);
  EXPECT_EQ(options("stretch 1000").stretch, 1000.0);
  EXPECT_EQ(refusal("stretch 0.5"), "HERE: 'stretch' is out of range: found 0.5, allowed is 1 to 1000");
  EXPECT_EQ(refusal("stretch 1001"), "HERE: 'stretch' is out of range: found 1001, allowed is 1 to 1000");
  EXPECT_EQ(refusal("stretch far"), "HERE: 'stretch' needs a number: found 'far'");
}

TEST(Options, HeatArea)
{
  EXPECT_EQ(options("heatArea law").heat_by_law, true);
  EXPECT_EQ(options("heatArea overlap").heat_by_law, false);
  EXPECT_EQ(refusal("heatArea some"),
            "HERE: 'heatArea' has an unknown value: found 'some', allowed is law, overlap");
}

TEST(Options, WallIsForWalls)
{
  EXPECT_TRUE(options("wall deformable", mpm, wall).deformable_wall);
  EXPECT_FALSE(options("wall rigid", thornton, wall).deformable_wall);
  EXPECT_EQ(refused_at_wall("wall soft"),
            "HERE: 'wall' has an unknown value: found 'soft', allowed is deformable, rigid");
  EXPECT_TRUE(holds(refusal("wall rigid"), "unknown keyword 'wall'"));
}

TEST(Options, StatsEnergyAndContactMapAreForPairs)
{
  EXPECT_EQ(options("stats out.json").stats_path, "out.json");
  for (const char* key : {"energy", "contactMap"}) {
    const std::string word = key;
    EXPECT_EQ(refusal(word + " yes"),
              "HERE: '" + word + "' has an unknown value: found 'yes', allowed is on, off");
    EXPECT_TRUE(holds(refused_at_wall(word + " on"), "unknown keyword '" + word + "'"));
  }
  EXPECT_TRUE(holds(refused_at_wall("stats out.json"), "unknown keyword 'stats'"));
  EXPECT_TRUE(options("energy on").energy);
  EXPECT_FALSE(options("energy off").energy);
  EXPECT_TRUE(options("contactMap on").contact_map);
  EXPECT_FALSE(options("contactMap off").contact_map);
}

TEST(Options, DissipatedEnergyIsOurs)
{
  for (const bool where : {pair, wall}) {
    const Parsed parsed = parse("computeDissipatedEnergy on", mpm, where);
    EXPECT_TRUE(parsed.options.dissipated_energy);
    EXPECT_TRUE(parsed.rest.empty());
  }
  EXPECT_EQ(refusal("computeDissipatedEnergy yes"),
            "HERE: 'computeDissipatedEnergy' has an unknown value: found 'yes', allowed is on, off");
}

TEST(Options, LiggghtsReadsItsOwnWords)
{
  for (const char* key :
       {"tangential_damping", "limitForce", "tangential_reduce", "computeElasticPotential",
        "heating_tracking", "heating_tangential_history", "heating_tangential_no_history", "torsionTorque"})
    for (const bool where : {pair, wall}) {
      EXPECT_EQ(parse(std::string(key) + " on", thornton, where).rest, (Words{key, "on"}));
      EXPECT_EQ(refusal(key, thornton, where), std::string("HERE: '") + key + "' needs a value");
    }
  EXPECT_EQ(options("limitForce on tangential_damping off").tangential_damping_on, false);
  EXPECT_EQ(options("tangential_damping on").tangential_damping_on, true);
  EXPECT_EQ(parse("stretch 2 limitForce on energy on tangential_damping off").rest,
            (Words{"limitForce", "on", "tangential_damping", "off"}));
}

TEST(Options, YieldPressure)
{
  EXPECT_EQ(parse("yieldPressure 2.5", thornton).options.own_words("yieldPressure"), (Words{"2.5"}));
  EXPECT_EQ(refusal("yieldPressure 0.9", thornton), "HERE: 'yieldPressure' is out of range: found 0.9, allowed is 1 to 3.5");
  EXPECT_TRUE(holds(refusal("yieldPressure 2.5"), "unknown keyword 'yieldPressure'"));  // of model mpm
}

TEST(Options, UnknownKeywordsGetTheNearestAndAll)
{
  EXPECT_EQ(refusal("strech 2", thornton),
            "HERE: unknown keyword 'strech' (did you mean 'stretch'?): allowed is tangentialDampingRatio, "
            "tangentialStiffness, "
            "elasticDamping, bodyCompliance, stretch, heatArea, stats, energy, contactMap, computeDissipatedEnergy, yieldPressure, "
            "tangential_damping, limitForce, "
            "tangential_reduce, computeElasticPotential, heating_tracking, heating_tangential_history, "
            "heating_tangential_no_history, torsionTorque");
  EXPECT_TRUE(holds(refusal("beyondrange stop"), "(did you mean 'beyondRange'?)"));
}

TEST(Options, AKeywordIsGivenOnce)
{
  EXPECT_EQ(refusal("law a.h5 law b.h5"), "HERE: 'law' is given twice");
  EXPECT_EQ(refusal("limitForce on limitForce off"), "HERE: 'limitForce' is given twice");
}

TEST(Options, ModelsStandInFront)
{
  for (const char* kind : {"model", "tangential", "cohesion", "rolling_friction", "surface"}) {
    const std::string order = std::string("HERE: '") + kind +
                              "' is out of order: the order is model, tangential, cohesion, "
                              "rolling_friction, surface, then the model's keywords";
    EXPECT_EQ(refusal(std::string("stretch 2 ") + kind + " x"), order);
    EXPECT_EQ(refused_at_wall(std::string("stretch 2 ") + kind + " x"),
              order + ", after all of the wall's own");
  }
}

TEST(Options, WordsOfTheWallStandInFront)
{
  for (const char* word : {"primitive", "mesh", "n_meshes", "meshes", "shear", "store_force",
                           "store_force_contact", "store_force_contact_every", "store_force_contact_stress",
                           "temperature", "contact_area", "track_energy", "allow_special_domain_periodic"}) {
    EXPECT_TRUE(holds(refused_at_wall(word),
                      std::string("HERE: '") + word + "' must stand before the model's keywords ("))
        << word;
    EXPECT_TRUE(holds(refusal(word), std::string("unknown keyword '") + word)) << word;
  }
}

TEST(Options, AWallInheritsWhatItLeavesOpen)
{
  const Options from = options(
      "law a.h5 materials a b stretch 2 elasticDamping off beyondRange continue tangentialDampingRatio 0.5 "
      "tangentialStiffness computed heatArea law bodyCompliance on tangential_damping off energy on stats out.json");
  Options bare = options("wall deformable", mpm, wall);
  bare.inherit(from);
  EXPECT_EQ(bare.own, from.own);
  EXPECT_EQ(bare.stretch, 2.0);
  EXPECT_EQ(bare.elastic_damping, ElasticDamping{0.0});
  EXPECT_EQ(bare.beyond_range, BeyondRange::proceed);
  EXPECT_EQ(bare.tangential_damping, 0.5);
  EXPECT_EQ(bare.tangential_computed, true);
  EXPECT_EQ(bare.heat_by_law, true);
  EXPECT_EQ(bare.body_compliance, true);
  EXPECT_EQ(bare.tangential_damping_on, false);
  EXPECT_TRUE(bare.deformable_wall);
  EXPECT_FALSE(bare.energy);  // these two are the pair style's alone
  EXPECT_TRUE(bare.stats_path.empty());

  Options own = options("materials c d stretch 3 beyondRange stop heatArea overlap", mpm, wall);
  own.inherit(from);
  EXPECT_EQ(own.own_words("materials"), (Words{"c", "d"}));
  EXPECT_EQ(own.own_words("law"), Words{"a.h5"});
  EXPECT_EQ(own.stretch, 3.0);
  EXPECT_EQ(own.beyond_range, BeyondRange::stop);
  EXPECT_EQ(own.heat_by_law, false);
}

TEST(Options, KeywordNamesAreThoseOfModelAndCommand)
{
  const auto has = [](const Words& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const bool where : {pair, wall}) {
    EXPECT_TRUE(has(keyword_names(mpm, where), "materials"));
    EXPECT_FALSE(has(keyword_names(thornton, where), "materials"));
    EXPECT_EQ(has(keyword_names(thornton, where), "wall"), where);
    EXPECT_EQ(has(keyword_names(thornton, where), "stats"), !where);
  }
}

}  // namespace granulaw::plugin::options_test
