#include "liggghts_plugin/keywords.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "liggghts_plugin/options.hpp"

namespace granulaw::plugin {
namespace {

/// A value of each keyword that the plug-in itself reads.
const std::map<std::string_view, std::string> values{{"tangentialDampingRatio", "0.1"},
                                                     {"tangentialStiffness", "computed"},
                                                     {"elasticDamping", "0.01"},
                                                     {"stretch", "2"},
                                                     {"heatArea", "law"},
                                                     {"wall", "deformable"},
                                                     {"stats", "s.json"},
                                                     {"energy", "on"},
                                                     {"contactMap", "on"},
                                                     {"computeDissipatedEnergy", "on"},
                                                     {"law", "x.h5"},
                                                     {"materials", "wax"},
                                                     {"beyondRange", "stop"}};

TEST(Keywords, AreListedOnce)
{
  std::set<std::string_view> names;
  for (const Keyword& k : keyword_table) EXPECT_TRUE(names.insert(k.name).second) << k.name;
}

/// The plug-in takes its own keywords and leaves the others to LIGGGHTS, where the list says that they may
/// stand.
TEST(Keywords, AreWhatThePluginReads)
{
  for (const Keyword& k : keyword_table)
    for (const bool is_wall : {false, true}) {
      if (k.reader == KeywordReader::surface_model) continue;  // taken out before
      const bool is_own = k.reader == KeywordReader::plugin;
      ASSERT_TRUE(!is_own || values.contains(k.name)) << k.name;
      const std::vector<std::string> words{std::string(k.name), is_own ? values.at(k.name) : "on"};
      std::vector<std::string> rest;
      if (is_wall ? !k.in_wall : !k.in_pair_style) {
        EXPECT_ANY_THROW(parse_options(Model::mpm, is_wall, "here", words, rest)) << k.name;
        continue;
      }
      const Options options = parse_options(Model::mpm, is_wall, "here", words, rest);
      EXPECT_EQ(rest.empty(), is_own) << k.name;
      const bool is_noted = is_own || k.name == "tangential_damping";  // read, and passed on
      EXPECT_EQ(options != Options{}, is_noted) << k.name;
      EXPECT_EQ(find_keyword(k.name, is_wall), &k);
    }
}

TEST(Keywords, OfMpmAloneAreNoneOfThornton)
{
  for (const Keyword& k : keyword_table) {
    if (!k.only_mpm) continue;
    std::vector<std::string> rest;
    EXPECT_ANY_THROW(parse_options(Model::thornton, false, "here", {std::string(k.name), "x"}, rest))
        << k.name;
  }
}

/// Each of them ends the names of materials.
TEST(Keywords, EndTheMaterials)
{
  for (const Keyword& k : keyword_table) {
    if (!k.in_pair_style || k.name == "materials" || k.reader == KeywordReader::surface_model) continue;
    const auto value = values.find(k.name);
    std::vector<std::string> rest;
    const Options options = parse_options(
        Model::mpm, false, "here",
        {"materials", "wax", "steel", std::string(k.name), value == values.end() ? "on" : value->second},
        rest);
    EXPECT_EQ(options.materials, (std::vector<std::string>{"wax", "steel"})) << k.name;
  }
}

}  // namespace
}  // namespace granulaw::plugin
