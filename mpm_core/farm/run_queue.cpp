#include "farm/run_queue.hpp"

#include <algorithm>
#include <ctime>
#include <unordered_map>

#include "base/error.hpp"
#include "farm/run_cache.hpp"
#include "solver/output/checkpoint.hpp"
#include "base/state_archive.hpp"

namespace granulaw {

namespace {

double thread_cpu_s()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

void visit_state(StateArchive& a, RunOutcome& o)
{
  visit_result(a, o.result);
  a.value(o.first_error), a.value(o.error), a.value(o.cpu_s);
}

RunOutcome perform(const RunJob& job, const std::function<void(double)>& progress)
{
  RunOutcome outcome;
  const double start = thread_cpu_s();
  RunOptions options;
  options.threads = 1;
  options.progress = progress;
  try {
    outcome.result = job.run(options);
  } catch (const Error& first) {
    outcome.first_error = first.what();
    options.refine = retry_refinement;
    try {
      outcome.result = job.run(options);
    } catch (const Error& second) {
      outcome.error = second.what();
    }
  }
  outcome.cpu_s = thread_cpu_s() - start;
  return outcome;
}

RunQueue::RunQueue(const std::vector<RunJob>& jobs, const RunCache& cache)
    : jobs_(jobs), cache_(cache), outcomes_(jobs.size()), fraction_(jobs.size(), 0.0)
{
  std::unordered_map<std::string, std::size_t> seen;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    same_as_.push_back(seen.try_emplace(jobs[k].key, k).first->second);
    if (same_as_[k] != k) continue;
    if (cache.load(jobs[k].key, outcomes_[k]))
      fraction_[k] = 1;
    else
      order_.push_back(k);
  }
  open_ = order_.size();
  std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return jobs[a].cost > jobs[b].cost; });
}

void RunQueue::report(std::size_t job, double fraction)
{
  fraction_[job] = fraction;
  label_ = jobs_[job].label;
}

void RunQueue::finish(std::size_t job, RunOutcome outcome)
{
  // A failure is not kept: the next build tries again.
  if (!outcome.failed()) cache_.store(jobs_[job].key, jobs_[job].cost, outcome);
  outcomes_[job] = std::move(outcome);
  report(job, 1.0);
  --open_;
}

double RunQueue::done() const
{
  double done = 0, total = 0;
  for (std::size_t k = 0; k < jobs_.size(); ++k)
    if (same_as_[k] == k) done += fraction_[k] * jobs_[k].cost, total += jobs_[k].cost;
  return total > 0 ? done / total : 1.0;
}

std::vector<RunOutcome> RunQueue::take()
{
  for (std::size_t k = 0; k < jobs_.size(); ++k)
    if (same_as_[k] != k) {
      outcomes_[k] = outcomes_[same_as_[k]];
      outcomes_[k].from_cache = true;
    }
  return std::move(outcomes_);
}

}  // namespace granulaw
