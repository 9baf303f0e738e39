// Prints the runs of traces.hpp in full digits; GRANULAW_ISA chooses the instruction set.
//
//   solver_traces > traces.txt       what traces_test.cpp is held by
//   solver_traces all                every sample
//   solver_traces speed              M point updates a second of each run
#include <fmt/format.h>

#include <string_view>

#include "traces.hpp"

int main(int count, char** words)
{
  using namespace granulaw;
  using namespace granulaw::verification;
  const std::string_view word = count > 1 ? words[1] : "";
  for (const TracedRun& run : traced_runs()) {
    const RunResult result = run.run();
    if (word == "speed") {
      fmt::print("{:<24} {:8.2f} M/s {:8.3f} CPU s\n", run.name, result.summary.point_updates_per_s / 1e6,
                 result.summary.cpu_s);
      continue;
    }
    const int places = word == "all" ? static_cast<int>(result.trace.size()) : stored_places;
    for (const TraceLine& line : lines_of(result, places)) {
      fmt::print("{} {}", run.name, line.name);
      for (const double value : line.values) fmt::print(" {:.17g}", value);
      fmt::print("\n");
    }
  }
}
