#include "liggghts_plugin/deck/options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "liggghts_plugin/contact/mpm_physics.hpp"
#include "liggghts_plugin/contact/thornton_physics.hpp"
#include "refusal.hpp"

namespace granulaw::plugin::options_test {

using Words = std::vector<std::string>;

const ModelInfo& mpm = model_info<MpmPhysics>;
const ModelInfo& thornton = model_info<ThorntonPhysics>;
constexpr bool pair = false, wall = true;

/// Options of a command, and the words left for LIGGGHTS.
struct Parsed
{
  Options options;
  Words rest;
};

Parsed parse(const std::string& text, const ModelInfo& model = mpm, bool is_wall = pair)
{
  std::istringstream stream(text);
  Parsed parsed;
  parsed.options = parse_options(model, is_wall, "HERE", Words{std::istream_iterator<std::string>(stream), {}}, parsed.rest);
  return parsed;
}

Options options(const std::string& text, const ModelInfo& model = mpm, bool is_wall = pair)
{
  return parse(text, model, is_wall).options;
}

/// Words of a command and the sentence that refuses them, or its beginning after "HERE: ".
struct Refusal
{
  std::string text, sentence;
  const ModelInfo& model = mpm;
  bool is_wall = pair;
};

TEST(Options, RefuseInOneSentence)
{
  const std::string out_of_order = " is out of order: the order is model, tangential, cohesion, rolling_friction, surface, then the model's keywords";
  std::vector<Refusal> refusals{
      {"law", "'law' needs a value"},
      {"law a.h5", "unknown keyword 'law'", thornton},
      {"law a.h5 law b.h5", "'law' is given twice"},
      {"limitForce on limitForce off", "'limitForce' is given twice"},
      {"materials", "'materials' needs one name for each atom type"},
      {"materials law x.h5", "'materials' needs one name for each atom type"},
      {"materials a", "unknown keyword 'materials'", thornton},
      {"materials a rolling_friction cdt", "'rolling_friction' is out of order"},
      {"materials a primitive", "'primitive' must stand before", mpm, wall},
      {"materials a meanCurvature yes", "unknown keyword 'meanCurvature'"},
      {"beyondRange on", "'beyondRange' has an unknown value: found 'on', allowed is stop, continue, crush"},
      {"beyondRange stop", "unknown keyword 'beyondRange'", thornton},
      {"beyondrange stop", "unknown keyword 'beyondrange' (did you mean 'beyondRange'?)"},
      {"tangentialDampingRatio 1.5", "'tangentialDampingRatio' is out of range: found 1.5, allowed is 0 to 1"},
      {"tangentialDampingRatio -0.1", "'tangentialDampingRatio' is out of range: found -0.1, allowed is 0 to 1"},
      {"tangentialDampingRatio", "'tangentialDampingRatio' needs a value"},
      {"tangentialStiffness hertz", "'tangentialStiffness' has an unknown value: found 'hertz', allowed is computed, mindlin"},
      {"elasticDamping some", "'elasticDamping' has an unknown value: found 'some', allowed is a number from 0 to 1, off, restitution"},
      {"elasticDamping 0.1s", "'elasticDamping' needs a number: found '0.1s'"},
      {"elasticDamping 2", "'elasticDamping' is out of range: found 2, allowed is 0 to 1"},
      {"stretch 0.5", "'stretch' is out of range: found 0.5, allowed is 1 to 1000"},
      {"stretch 1001", "'stretch' is out of range: found 1001, allowed is 1 to 1000"},
      {"stretch far", "'stretch' needs a number: found 'far'"},
      {"heatArea some", "'heatArea' has an unknown value: found 'some', allowed is law, overlap"},
      {"wall soft", "'wall' has an unknown value: found 'soft', allowed is deformable, rigid", mpm, wall},
      {"wall rigid", "unknown keyword 'wall'"},
      {"energy yes", "'energy' has an unknown value: found 'yes', allowed is on, off"},
      {"contactMap yes", "'contactMap' has an unknown value: found 'yes', allowed is on, off"},
      {"energy on", "unknown keyword 'energy'", mpm, wall},
      {"contactMap on", "unknown keyword 'contactMap'", mpm, wall},
      {"stats out.json", "unknown keyword 'stats'", mpm, wall},
      {"computeDissipatedEnergy yes", "'computeDissipatedEnergy' has an unknown value: found 'yes', allowed is on, off"},
      {"yieldPressure 0.9", "'yieldPressure' is out of range: found 0.9, allowed is 1 to 3.5", thornton},
      {"yieldPressure 2.5", "unknown keyword 'yieldPressure'"},
      {"strech 2",
       "unknown keyword 'strech' (did you mean 'stretch'?): allowed is tangentialDampingRatio, tangentialStiffness, elasticDamping, bodyCompliance, "
       "stretch, heatArea, stats, energy, contactMap, computeDissipatedEnergy, yieldPressure, tangential_damping, limitForce, tangential_reduce, "
       "computeElasticPotential, heating_tracking, heating_tangential_history, heating_tangential_no_history, torsionTorque",
       thornton},
  };
  for (const char* no_number : {"much", "0.5x", "nan", "inf", "1e999"})
    refusals.push_back({std::string("tangentialDampingRatio ") + no_number, std::string("'tangentialDampingRatio' needs a number: found '") + no_number + "'"});
  for (const std::string kind : {"model", "tangential", "cohesion", "rolling_friction", "surface"}) {
    refusals.push_back({"stretch 2 " + kind + " x", "'" + kind + "'" + out_of_order});
    refusals.push_back({"stretch 2 " + kind + " x", "'" + kind + "'" + out_of_order + ", after all of the wall's own", mpm, wall});
  }
  for (const std::string word : {"primitive", "mesh", "n_meshes", "meshes", "shear", "store_force", "store_force_contact", "store_force_contact_every",
                                 "store_force_contact_stress", "temperature", "contact_area", "track_energy", "allow_special_domain_periodic"}) {
    refusals.push_back({word, "'" + word + "' must stand before the model's keywords (", mpm, wall});
    refusals.push_back({word, "unknown keyword '" + word + "'"});
  }
  for (const Refusal& r : refusals) {
    const std::string said = sentence_of([&] { parse(r.text, r.model, r.is_wall); });
    EXPECT_EQ(said.rfind("HERE: " + r.sentence, 0), 0u) << r.text << ": " << said;
  }
}

TEST(Options, AreWhatTheWordsSay)
{
  EXPECT_EQ(options(""), Options{});
  EXPECT_EQ(options("", thornton, wall), Options{});
  for (const bool where : {pair, wall}) EXPECT_EQ(options("law a.h5", mpm, where).own_words("law"), Words{"a.h5"});
  EXPECT_EQ(options("beyondRange stop").beyond_range, BeyondRange::stop);
  EXPECT_EQ(options("beyondRange continue").beyond_range, BeyondRange::proceed);
  EXPECT_EQ(options("beyondRange crush").beyond_range, BeyondRange::crush);
  for (const auto& [word, number] : {std::pair{"0.25", 0.25}, {"0", 0.0}, {"1", 1.0}, {"1e-320", 1e-320}})
    EXPECT_EQ(options(std::string("tangentialDampingRatio ") + word).tangential_damping, number);
  EXPECT_EQ(options("tangentialStiffness computed").tangential_computed, true);
  EXPECT_EQ(options("tangentialStiffness mindlin").tangential_computed, false);
  EXPECT_EQ(options("elasticDamping off").elastic_damping, (ElasticDamping{0.0, false}));
  EXPECT_EQ(options("elasticDamping restitution").elastic_damping, (ElasticDamping{0.0, true}));
  EXPECT_EQ(options("elasticDamping 0.02").elastic_damping, (ElasticDamping{0.02, false}));
  EXPECT_EQ(options("stretch 1").stretch, 1.0);
  EXPECT_EQ(options("stretch 1000").stretch, 1000.0);
  EXPECT_EQ(options("heatArea law").heat_by_law, true);
  EXPECT_EQ(options("heatArea overlap").heat_by_law, false);
  EXPECT_TRUE(options("wall deformable", mpm, wall).deformable_wall);
  EXPECT_FALSE(options("wall rigid", thornton, wall).deformable_wall);
  EXPECT_EQ(options("stats out.json").stats_path, "out.json");
  EXPECT_TRUE(options("energy on").energy && options("contactMap on").contact_map);
  EXPECT_FALSE(options("energy off").energy || options("contactMap off").contact_map);
  EXPECT_EQ(options("yieldPressure 2.5", thornton).own_words("yieldPressure"), (Words{"2.5"}));
}

/// Every keyword that may stand behind `model mpm`.
const std::vector<Keyword>& keyword_table()
{
  static const std::vector<Keyword> table = [] {
    std::vector<Keyword> all;
    const auto add = [&](const auto& keywords) { all.insert(all.end(), keywords.begin(), keywords.end()); };
    add(shared_keywords), add(MpmPhysics::keywords), add(liggghts_keywords), add(surface_keywords);
    return all;
  }();
  return table;
}

bool is_one_of(const auto& keywords, const Keyword& k)
{
  return std::any_of(keywords.begin(), keywords.end(), [&](const Keyword& other) { return other.name == k.name; });
}

/// A value of each keyword that the plug-in itself reads; of the others "on".
std::string value_of(const Keyword& k)
{
  static const std::map<std::string_view, std::string> values{
      {"tangentialDampingRatio", "0.1"}, {"tangentialStiffness", "computed"}, {"elasticDamping", "0.01"}, {"stretch", "2"}, {"bodyCompliance", "on"},
      {"heatArea", "law"}, {"wall", "deformable"}, {"stats", "s.json"}, {"energy", "on"}, {"contactMap", "on"}, {"computeDissipatedEnergy", "on"},
      {"law", "x.h5"}, {"materials", "wax"}, {"beyondRange", "stop"}, {"waves", "on"}, {"confinement", "on"}};
  const auto found = values.find(k.name);
  EXPECT_TRUE(found != values.end() || is_one_of(liggghts_keywords, k)) << k.name;
  return found == values.end() ? "on" : found->second;
}

/// The plug-in takes its own keywords and leaves the others to LIGGGHTS, where the list says that they may stand.
TEST(Keywords, AreWhatThePluginReads)
{
  std::set<std::string_view> names;
  for (const Keyword& k : keyword_table()) {
    EXPECT_TRUE(names.insert(k.name).second) << k.name << " is listed twice";
    if (is_one_of(surface_keywords, k)) continue;  // taken out before
    const bool is_own = !is_one_of(liggghts_keywords, k);
    const std::string words = std::string(k.name) + " " + value_of(k);
    for (const bool is_wall : {false, true}) {
      if (is_wall ? !k.in_wall : !k.in_pair_style) {
        EXPECT_ANY_THROW(parse(words, mpm, is_wall)) << k.name;
        continue;
      }
      const Parsed parsed = parse(words, mpm, is_wall);
      EXPECT_EQ(parsed.rest.empty(), is_own) << k.name;
      const bool is_noted = is_own || k.name == "tangential_damping";  // read, and passed on
      EXPECT_EQ(parsed.options != Options{}, is_noted) << k.name;
      if (!is_own) {
        EXPECT_EQ(sentence_of([&] { parse(std::string(k.name), mpm, is_wall); }), "HERE: '" + std::string(k.name) + "' needs a value");
      }
    }
    if (is_one_of(MpmPhysics::keywords, k)) {
      EXPECT_ANY_THROW(parse(std::string(k.name) + " x", thornton)) << k.name;
    }
    // each of them ends the names of materials
    if (k.in_pair_style && k.name != "materials") {
      EXPECT_EQ(options("materials wax steel " + words).own_words("materials"), (Words{"wax", "steel"})) << k.name;
    }
  }
  EXPECT_EQ(options("materials a primitive").own_words("materials"), (Words{"a", "primitive"}));  // no wall
}

TEST(Keywords, NamesAreThoseOfModelAndCommand)
{
  const auto has = [](const Words& found, const char* name) { return std::find(found.begin(), found.end(), name) != found.end(); };
  for (const bool where : {pair, wall}) {
    EXPECT_TRUE(has(keyword_names(mpm, where), "materials"));
    EXPECT_FALSE(has(keyword_names(thornton, where), "materials"));
    EXPECT_EQ(has(keyword_names(thornton, where), "wall"), where);
    EXPECT_EQ(has(keyword_names(thornton, where), "stats"), !where);
  }
}

TEST(Options, LiggghtsReadsItsOwnWords)
{
  EXPECT_EQ(options("limitForce on tangential_damping off").tangential_damping_on, false);
  EXPECT_EQ(options("tangential_damping on").tangential_damping_on, true);
  EXPECT_EQ(parse("stretch 2 limitForce on energy on tangential_damping off").rest, (Words{"limitForce", "on", "tangential_damping", "off"}));
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

}  // namespace granulaw::plugin::options_test
