#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/output/trace.hpp"

/// Small runs that between them pass through every grid, contact, programme and precision of the solver: what
/// holds it while it is rebuilt.
namespace granulaw::verification {

struct TracedRun
{
  std::string name;
  /// Largest difference between instruction sets, over the largest value of the column (traces_test.cpp).
  double rounding;
  std::function<RunResult()> run;
};
const std::vector<TracedRun>& traced_runs();

/// The stored numbers of a run, each with its name.
struct TraceLine
{
  std::string name;
  std::vector<double> values;
};
inline constexpr int stored_places = 9;
/// Steps, summary, and `places` samples of each column of the trace and of its planes.
std::vector<TraceLine> lines_of(const RunResult& run, int places);

}  // namespace granulaw::verification
