#include "characterise/run_queue.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

namespace granulaw {

namespace {

struct Stopped
{
};  // thrown through the solver once another run has failed

}  // namespace

std::vector<RunResult> run_all(const std::vector<RunJob>& jobs, const RunOptions& options, int threads,
                               const RunCache& cache, const Progress& progress)
{
  std::vector<std::size_t> order(jobs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return jobs[a].cost > jobs[b].cost; });
  const double total =
      std::accumulate(jobs.begin(), jobs.end(), 1e-300, [](double s, const RunJob& j) { return s + j.cost; });

  std::vector<RunResult> results(jobs.size());
  std::vector<double> done(jobs.size(), 0.0);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;  // guards done, error and progress
  std::exception_ptr error;

  const auto report = [&](std::size_t job, double fraction) {
    const std::lock_guard lock(mutex);
    done[job] = fraction * jobs[job].cost;
    if (progress && !stop) progress(std::accumulate(done.begin(), done.end(), 0.0) / total, jobs[job].label);
  };
  const auto work = [&] {
    for (std::size_t k = next++; k < order.size() && !stop; k = next++) {
      const RunJob& job = jobs[order[k]];
      try {
        if (!cache.load(job.key, results[order[k]])) {
          RunOptions own = options;
          own.threads = 1;
          own.progress = [&](double fraction) {
            if (stop) throw Stopped{};
            report(order[k], fraction);
          };
          results[order[k]] = job.run(own);
          cache.store(job.key, results[order[k]]);
        }
        report(order[k], 1.0);
      } catch (const Stopped&) {
        return;
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!stop.exchange(true)) error = std::current_exception();
        return;
      }
    }
  };
  std::vector<std::jthread> pool;
  for (int k = 1; k < threads; ++k) pool.emplace_back(work);
  work();
  pool.clear();  // joins
  if (error) std::rethrow_exception(error);
  return results;
}

}  // namespace granulaw
