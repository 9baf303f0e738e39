// The energies of a run over time: a run of any length leaves a few hundred rows, first and last among them.
#include "liggghts_plugin/books/energy_series.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace granulaw::plugin::energy_series_test {

nlohmann::ordered_json after(std::int64_t steps, const DeckUnits& units = {}, bool energies = false)
{
  EnergySeries series;
  for (std::int64_t step = 0; step <= steps; ++step) {
    if (!series.due(step) && step != steps) continue;
    EnergySeries::Row row{};
    row[EnergySeries::time] = 0.5 * static_cast<double>(step);
    row[EnergySeries::kinetic] = 2.0;
    row[EnergySeries::fastest] = 3.0;
    series.add(step, row);
  }
  return series.json(units, energies);
}

TEST(EnergySeries, KeepsAFewHundredRowsOfAnyRun)
{
  for (const std::int64_t steps : {0, 1, 399, 400, 1000, 123457}) {
    const auto times = after(steps)["time_s"].get<std::vector<double>>();
    EXPECT_LE(times.size(), EnergySeries::capacity);
    EXPECT_GE(times.size(), std::min<std::size_t>(EnergySeries::capacity / 2, static_cast<std::size_t>(steps) + 1));
    EXPECT_EQ(times.front(), 0.0);
    EXPECT_NEAR(times.back(), 0.5 * static_cast<double>(steps), 1e-6 * static_cast<double>(steps));  // six digits
    for (std::size_t k = 1; k < times.size(); ++k) EXPECT_LT(times[k - 1], times[k]);
  }
}

TEST(EnergySeries, IsInSiAndHoldsWhatIsCounted)
{
  const auto cgs = after(1, {0.01, 0.001});
  EXPECT_DOUBLE_EQ(cgs["kinetic_J"][0], 2e-7);
  EXPECT_DOUBLE_EQ(cgs["fastest_particle_m_per_s"][0], 0.03);
  EXPECT_FALSE(cgs.contains("elastic_J"));
  EXPECT_TRUE(after(1, {}, true).contains("elastic_J"));
}

TEST(EnergySeries, ARowOfTheSameStepIsReplaced)
{
  EnergySeries series;
  series.add(7, {0.7, 1});
  series.add(7, {0.7, 2});
  const auto found = series.json({}, false);
  EXPECT_EQ(found["particles"], nlohmann::ordered_json::array({2}));
}

}  // namespace granulaw::plugin::energy_series_test
