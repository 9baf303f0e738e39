#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/runs.hpp"

namespace granulaw {

class RunCache;
class StateArchive;

/// One solver run of a characterisation.
struct RunJob
{
  std::string label;  ///< for progress: "press to 0.02 R"
  std::string key;    ///< everything that determines the result, on one line; solver_id() belongs to it
  double cost = 1;    ///< expected, any unit: long jobs start first, progress counts in it
  std::function<RunResult(const RunOptions&)> run;  ///< obeys RunOptions::refine; Error: the run has failed
};

/// Outcome of a job.
struct RunOutcome
{
  RunResult result;         ///< empty if the run failed
  std::string first_error;  ///< why the first attempt failed; `result` is then that of a second, finer one
  std::string error;        ///< why the second attempt failed too; empty: there is a result
  double cpu_s = 0;         ///< of all attempts, when they were made
  bool from_cache = false;  ///< taken from the cache, or the same run stands in the list before
  bool failed() const { return !error.empty(); }
};

/// Bytes and back, every bit kept (state_archive.hpp); `from_cache` is not carried.
void visit_state(StateArchive& archive, RunOutcome& outcome);

/// Resolution of a second attempt over that of the first.
inline constexpr double retry_refinement = 1.4;

/// Makes a job's run on the calling thread; if it fails (Error), once more on a finer grid. Any other
/// exception (no memory, what `progress` throws) goes through.
RunOutcome perform(const RunJob& job, const std::function<void(double fraction)>& progress);

/// The jobs of one batch: which run is next, what is done. Equal keys are one run; what the cache holds is
/// taken from it and what is made is put into it. One thread uses it.
class RunQueue
{
 public:
  /// Both outlive the queue.
  RunQueue(const std::vector<RunJob>& jobs, const RunCache& cache);

  bool has_next() const { return next_ < order_.size(); }
  std::size_t next() { return order_[next_++]; }  ///< index of the most expensive job not yet begun
  void report(std::size_t job, double fraction);  ///< of a run under way
  void finish(std::size_t job, RunOutcome outcome);
  bool finished() const { return open_ == 0; }
  double done() const;              ///< share of the expected cost, 0..1
  const std::string& label() const  ///< of the job last reported
  {
    return label_;
  }
  std::vector<RunOutcome> take();  ///< in the order of the jobs, once finished

 private:
  const std::vector<RunJob>& jobs_;
  const RunCache& cache_;
  std::vector<RunOutcome> outcomes_;
  std::vector<std::size_t> same_as_;  ///< first job with that key
  std::vector<std::size_t> order_;    ///< of the runs to make
  std::vector<double> fraction_;
  std::size_t next_ = 0, open_ = 0;
  std::string label_;
};

}  // namespace granulaw
