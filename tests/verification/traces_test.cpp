// The solver's numbers against stored ones. A change that moves one of them says so: print them anew with
// solver_traces, and give the difference with its cause where the change is described.
#include "base/larger.hpp"
#include "traces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace granulaw::verification::traces_test {

using Lines = std::map<std::string, std::vector<double>>;

Lines stored(const std::string& run)
{
  std::ifstream file(GRANULAW_TRACES_FILE);
  Lines lines;
  for (std::string text; std::getline(file, text);) {
    std::istringstream words(text);
    std::string owner, name;
    words >> owner >> name;
    if (owner == run)
      for (double value; words >> value;) lines[name].push_back(value);
  }
  return lines;
}

class Traces : public testing::TestWithParam<TracedRun>
{
};

/// Instruction sets differ by the roundings of fused products, which the contact's markers that close one by
/// one magnify: TracedRun::rounding. It is ten times the difference of generic and AVX2, measured over the
/// largest value of a column: 2e-13 in two dimensions, 6e-12 in three, 4e-7 in single precision.
TEST_P(Traces, AreTheStoredOnes)
{
  const Lines expected = stored(GetParam().name);
  const std::vector<TraceLine> found = lines_of(GetParam().run(), stored_places);
  ASSERT_EQ(found.size(), expected.size());
  for (const TraceLine& line : found) {
    const std::vector<double>& values = expected.at(line.name);
    ASSERT_EQ(line.values.size(), values.size()) << line.name;
    // rounding itself, where a column is zero by symmetry; errors of the energy are shares of it
    double largest = line.name == "energy" ? 1 : 1e-12;
    for (const double value : values) largest = larger(largest, std::abs(value));
    const double allowed = line.name == "counts" ? 0 : GetParam().rounding * largest;
    for (std::size_t k = 0; k < values.size(); ++k)
      EXPECT_NEAR(line.values[k], values[k], allowed) << line.name << " " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Runs, Traces, testing::ValuesIn(traced_runs()), [](const auto& run) {
  std::string name = run.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace granulaw::verification::traces_test
