#include "solver/shifted_grids.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace granulaw {

std::vector<RunResult> run_on_shifted_grids(
    int shifted_grids, int threads, const std::function<void(double)>& progress,
    const std::function<RunResult(double, const std::function<void(double)>&)>& job)
{
  std::vector<RunResult> results(static_cast<std::size_t>(shifted_grids));
  std::vector<double> done(results.size(), 0.0);
  std::atomic<int> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;
  std::exception_ptr failure;

  const auto work = [&] {
    for (int k = next++; k < shifted_grids && !stop; k = next++) {
      const auto report = [&, k](double fraction) {
        const std::lock_guard lock(mutex);
        if (stop)
          throw std::runtime_error("stopped");  // another run has failed: its error is the one reported
        done[static_cast<std::size_t>(k)] = fraction;
        double sum = 0;
        for (const double d : done) sum += d;
        if (progress) progress(sum / shifted_grids);
      };
      try {
        results[static_cast<std::size_t>(k)] =
            job(static_cast<double>(k) / shifted_grids - (shifted_grids > 1 ? 0.5 : 0.0), report);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stop = true;
      }
    }
  };
  std::vector<std::jthread> workers;
  for (int t = 1; t < std::min(threads, shifted_grids); ++t) workers.emplace_back(work);
  work();
  workers.clear();
  if (failure) std::rethrow_exception(failure);
  return results;
}

std::vector<TraceSample> mean_trace(const std::vector<RunResult>& members)
{
  if (members.size() == 1) return members.front().trace;
  // start of each member's current segment, walked forward segment by segment
  std::vector<std::size_t> at(members.size(), 0);
  std::vector<TraceSample> mean;
  const double weight = 1.0 / static_cast<double>(members.size());
  for (int segment = 0;; ++segment) {
    std::size_t common = SIZE_MAX;
    std::vector<std::size_t> length(members.size(), 0);
    for (std::size_t m = 0; m < members.size(); ++m) {
      const auto& trace = members[m].trace;
      while (at[m] + length[m] < trace.size() && trace[at[m] + length[m]].segment == segment) ++length[m];
      common = std::min(common, length[m]);
    }
    const bool any = std::any_of(length.begin(), length.end(), [](std::size_t l) { return l > 0; });
    if (!any) return mean;
    for (std::size_t k = 0; k < common; ++k) {
      const double place = common > 1 ? static_cast<double>(k) / static_cast<double>(common - 1) : 0.0;
      TraceSample s = members.front().trace[at[0] + k];
      s.time = s.delta = s.force = s.contact_radius = 0;
      for (std::size_t m = 0; m < members.size(); ++m) {
        const double index = place * static_cast<double>(length[m] - 1);
        const std::size_t below = std::min(static_cast<std::size_t>(index), length[m] - 1);
        const TraceSample& a = members[m].trace[at[m] + below];
        const TraceSample& b = members[m].trace[at[m] + std::min(below + 1, length[m] - 1)];
        const double t = index - static_cast<double>(below);
        const auto add = [&](double TraceSample::*value) {
          s.*value += weight * ((1 - t) * a.*value + t * b.*value);
        };
        add(&TraceSample::time), add(&TraceSample::delta);
        add(&TraceSample::force), add(&TraceSample::contact_radius);
      }
      mean.push_back(s);
    }
    for (std::size_t m = 0; m < members.size(); ++m) at[m] += length[m];
  }
}

}  // namespace granulaw
