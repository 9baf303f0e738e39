#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "liggghts_plugin/contact/mpm_physics.hpp"
#include "liggghts_plugin/contact/thornton_physics.hpp"
#include "liggghts_plugin/deck/options.hpp"

namespace granulaw::plugin::keywords_test {

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
  return std::any_of(keywords.begin(), keywords.end(),
                     [&](const Keyword& other) { return other.name == k.name; });
}

/// A value of each keyword that the plug-in itself reads.
const std::map<std::string_view, std::string> values{{"tangentialDampingRatio", "0.1"},
                                                     {"tangentialStiffness", "computed"},
                                                     {"elasticDamping", "0.01"},
                                                     {"stretch", "2"},
                                                     {"bodyCompliance", "on"},
                                                     {"heatArea", "law"},
                                                     {"wall", "deformable"},
                                                     {"stats", "s.json"},
                                                     {"energy", "on"},
                                                     {"contactMap", "on"},
                                                     {"computeDissipatedEnergy", "on"},
                                                     {"law", "x.h5"},
                                                     {"materials", "wax"},
                                                     {"beyondRange", "stop"},
                                                     {"waves", "on"}};

TEST(Keywords, AreListedOnce)
{
  std::set<std::string_view> names;
  for (const Keyword& k : keyword_table()) EXPECT_TRUE(names.insert(k.name).second) << k.name;
}

/// The plug-in takes its own keywords and leaves the others to LIGGGHTS, where the list says that they may
/// stand.
TEST(Keywords, AreWhatThePluginReads)
{
  for (const Keyword& k : keyword_table())
    for (const bool is_wall : {false, true}) {
      if (is_one_of(surface_keywords, k)) continue;  // taken out before
      const bool is_own = !is_one_of(liggghts_keywords, k);
      ASSERT_TRUE(!is_own || values.contains(k.name)) << k.name;
      const std::vector<std::string> words{std::string(k.name), is_own ? values.at(k.name) : "on"};
      std::vector<std::string> rest;
      if (is_wall ? !k.in_wall : !k.in_pair_style) {
        EXPECT_ANY_THROW(parse_options(model_info<MpmPhysics>, is_wall, "here", words, rest)) << k.name;
        continue;
      }
      const Options options = parse_options(model_info<MpmPhysics>, is_wall, "here", words, rest);
      EXPECT_EQ(rest.empty(), is_own) << k.name;
      const bool is_noted = is_own || k.name == "tangential_damping";  // read, and passed on
      EXPECT_EQ(options != Options{}, is_noted) << k.name;
    }
}

TEST(Keywords, OfMpmAloneAreNoneOfThornton)
{
  for (const Keyword& k : keyword_table()) {
    if (!is_one_of(MpmPhysics::keywords, k)) continue;
    std::vector<std::string> rest;
    EXPECT_ANY_THROW(
        parse_options(model_info<ThorntonPhysics>, false, "here", {std::string(k.name), "x"}, rest))
        << k.name;
  }
}

/// Each of them ends the names of materials.
TEST(Keywords, EndTheMaterials)
{
  for (const Keyword& k : keyword_table()) {
    if (!k.in_pair_style || k.name == "materials" || is_one_of(surface_keywords, k)) continue;
    const auto value = values.find(k.name);
    std::vector<std::string> rest;
    const Options options = parse_options(
        model_info<MpmPhysics>, false, "here",
        {"materials", "wax", "steel", std::string(k.name), value == values.end() ? "on" : value->second},
        rest);
    EXPECT_EQ(options.own_words("materials"), (std::vector<std::string>{"wax", "steel"})) << k.name;
  }
}

}  // namespace granulaw::plugin::keywords_test
