#include "farm/farm.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "farm/worker_pool.hpp"

namespace granulaw {

std::vector<RunOutcome> Farm::run(const std::vector<RunJob>& jobs, const Progress& progress)
{
  std::vector<RunOutcome> outcomes;
  try {
    outcomes = make(jobs, progress);
  } catch (const Error& error) {  // failed runs are outcomes
    throw FarmBroken(error.what());
  }
  for (const RunOutcome& outcome : outcomes) {
    if (outcome.from_cache) {
      ++count_.from_cache;
      count_.cpu_s_saved += outcome.cpu_s;
      continue;
    }
    ++count_.made;
    count_.cpu_s += outcome.cpu_s;
    if (!outcome.first_error.empty()) ++count_.retried;
    if (outcome.failed()) ++count_.failed;
  }
  return outcomes;
}

std::vector<RunResult> Farm::run_all(const std::vector<RunJob>& jobs, const Progress& progress)
{
  std::vector<RunOutcome> outcomes = run(jobs, progress);
  std::vector<RunResult> results;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    if (outcomes[k].failed())
      fail(jobs[k].label, fmt::format("the run failed, on a finer grid too ({})", outcomes[k].error));
    results.push_back(std::move(outcomes[k].result));
  }
  return results;
}

std::vector<RunOutcome> ThreadFarm::make(const std::vector<RunJob>& jobs, const Progress& progress)
{
  RunQueue queue(jobs, cache_);
  WorkerPool pool(std::min(threads_, static_cast<int>(jobs.size())));
  for (;;) {
    while (pool.has_room() && queue.has_next()) {
      const std::size_t k = queue.next();
      pool.start(k, jobs[k]);
    }
    std::exception_ptr broken;
    for (WorkerPool::Finished& end : pool.wait(std::chrono::milliseconds(100))) {
      if (end.broken)
        broken = end.broken;
      else
        queue.finish(end.index, std::move(end.outcome));
    }
    if (broken) std::rethrow_exception(broken);
    for (const auto& [index, fraction] : pool.running()) queue.report(index, fraction);
    if (progress) progress(queue.done(), queue.label());
    if (queue.finished()) return queue.take();
  }
}

}  // namespace granulaw
