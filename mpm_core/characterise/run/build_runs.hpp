#pragma once

#include <string>
#include <vector>

#include "characterise/run/request.hpp"
#include "farm/run_queue.hpp"

namespace granulaw {

/// The runs of one build: their farm, their progress, what failed.
class BuildRuns
{
 public:
  explicit BuildRuns(const BuildOptions& options) : options_(options) {}

  /// Makes runs; their part of the progress ends at `until`. A run that fails leaves a hole.
  std::vector<RunOutcome> make(const std::vector<RunJob>& jobs, double until);
  /// The same of runs that the law cannot do without: throws Error where one fails, with `what` it was.
  std::vector<RunOutcome> make_needed(const std::vector<RunJob>& jobs, double until, const std::string& what);

  double done() const { return done_; }
  const std::vector<std::string>& holes() const { return holes_; }
  std::size_t count() const { return count_; }

 private:
  const BuildOptions& options_;
  double done_ = 0;
  std::size_t count_ = 0;
  std::vector<std::string> holes_;  ///< each with its run and why it failed
};

}  // namespace granulaw
