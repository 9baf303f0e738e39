#pragma once

#include <functional>
#include <string>
#include <vector>

#include "characterise/run_cache.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// One solver run of a characterisation.
struct RunJob
{
  std::string label;  ///< for progress: "press to 0.02 R"
  std::string key;    ///< everything that determines the result, on one line
  double cost = 1;    ///< expected, any unit: long jobs start first, progress counts in it
  std::function<RunResult(const RunOptions&)> run;
};

/// Told the share of the work that is done, 0..1. May throw to stop.
using Progress = std::function<void(double done, const std::string& what)>;

/// Runs all jobs on `threads` threads (each run on one), or takes them from the cache; results in the order
/// of the jobs. The first exception stops the rest and is thrown on. `progress` is called by one thread at a
/// time.
std::vector<RunResult> run_all(const std::vector<RunJob>& jobs, const RunOptions& options, int threads,
                               const RunCache& cache, const Progress& progress);

}  // namespace granulaw
