#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "farm/run_cache.hpp"
#include "farm/run_queue.hpp"

namespace granulaw {

/// Runs and CPU time that a farm has spent and saved since it was made.
struct FarmCount
{
  long made = 0;           ///< runs, whether they failed or not
  long from_cache = 0;     ///< runs that were not necessary
  long retried = 0;        ///< of those made: failed at first, tried again on a finer grid
  long failed = 0;         ///< of those made: failed then too
  double cpu_s = 0;        ///< of the runs made
  double cpu_s_saved = 0;  ///< of the runs taken from the cache, when they were made
};

/// What ends the program on this process because its farm broke: a rank had to stop, or the cache cannot be used. No
/// Error, so that nobody takes it for a run that failed and goes on without it while other ranks leave.
class FarmBroken : public std::runtime_error
{
 public:
  using std::runtime_error::runtime_error;
};

/// Makes batches of independent runs. The outcomes depend on neither the number of workers nor the order in
/// which they end: each run is made by one thread, and the outcomes are in the order of the jobs.
class Farm
{
 public:
  virtual ~Farm() = default;

  /// All outcomes of a batch. A run that fails is tried again on a finer grid; if that fails too its outcome
  /// says why, and the caller decides what to do without it. Whatever `progress` throws stops the batch and
  /// goes through; what is finished by then is in the cache. Throws FarmBroken where runs cannot be made.
  std::vector<RunOutcome> run(const std::vector<RunJob>& jobs, const Progress& progress = {});

  /// The same where no run is dispensable: throws Error with the sentence of the first that failed.
  std::vector<RunResult> run_all(const std::vector<RunJob>& jobs, const Progress& progress = {});

  const FarmCount& count() const { return count_; }

 private:
  virtual std::vector<RunOutcome> make(const std::vector<RunJob>& jobs, const Progress& progress) = 0;
  FarmCount count_;
};

/// On threads of this process.
class ThreadFarm : public Farm
{
 public:
  explicit ThreadFarm(int threads, RunCache cache = RunCache{}) : threads_(threads), cache_(std::move(cache))
  {
  }

 private:
  std::vector<RunOutcome> make(const std::vector<RunJob>& jobs, const Progress& progress) override;
  int threads_;
  RunCache cache_;
};

}  // namespace granulaw
