#include "liggghts_plugin/books/stats_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "liggghts_plugin/books/energy_series.hpp"

namespace granulaw::plugin::stats_json_test {

TEST(StatsJson, NumbersThatAreNoneAreNull)
{
  EXPECT_TRUE(json_number(NAN).is_null());
  EXPECT_TRUE(json_number(INFINITY).is_null());
  EXPECT_EQ(json_number(1.0 / 3, 6).dump(), "0.333333");
  EXPECT_EQ(json_number(7).dump(), "7");
}

/// A run that is stopped because a number became none is the one whose file is read.
TEST(StatsJson, AStoppedRunsFileIsJson)
{
  EnergySeries series;
  EnergySeries::Row row{};
  row[EnergySeries::kinetic] = NAN, row[EnergySeries::fastest] = INFINITY;
  series.add(1, row);
  ContactStatistics statistics;
  ContactStatistics::Pair& pair = statistics.pairs[{PairKey::particles, 1, 2}];
  pair.touches = 1, pair.speed_max = NAN, pair.info.a = "a \"b\"\n\xff";
  pair.open_map();
  nlohmann::ordered_json file{{"series", series.json({}, false)}};
  file.update(to_json(statistics, {}));
  const auto read = nlohmann::json::parse(text_of(file));
  EXPECT_TRUE(read["series"]["kinetic_J"][0].is_null());
  EXPECT_TRUE(read["series"]["fastest_particle_m_per_s"][0].is_null());
  EXPECT_EQ(read["pairs"][0]["contacts_begun"], 1);
  EXPECT_TRUE(read["pairs"][0]["impact_speed_max_m_per_s"].is_null());
  EXPECT_EQ(read["pairs"][0]["materials"][0], "a \"b\"\n\xef\xbf\xbd");
}

TEST(StatsJson, ListsOfNumbersStandOnOneLine)
{
  const nlohmann::ordered_json file{
      {"a", {1, 2.5}}, {"b", {{"c", nullptr}}}, {"d", {{{"e", "f"}}, {{"e", {{1, 2}, {3, 4}}}}}}, {"g", nlohmann::ordered_json::array()}};
  EXPECT_EQ(text_of(file),
            "{\n  \"a\": [1, 2.5],\n  \"b\": {\n    \"c\": null\n  },\n  \"d\": [\n    {\n      \"e\": \"f\"\n    },\n"
            "    {\n      \"e\": [[1, 2], [3, 4]]\n    }\n  ],\n  \"g\": []\n}\n");
}

}  // namespace granulaw::plugin::stats_json_test
