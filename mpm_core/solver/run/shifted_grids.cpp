#include "solver/run/shifted_grids.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
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

namespace {

/// Between two samples of a member's trace.
struct Between
{
  std::size_t below, above;
  double t;

  double operator()(double a, double b) const { return (1 - t) * a + t * b; }
};
/// Parts of one sample of the mean: for each member, the place in its trace.
using MeanSample = std::vector<Between>;

/// Index of the first sample of `segment` in a trace.
std::size_t begin_of(int segment, const std::vector<TraceSample>& trace)
{
  const auto before = [segment](const TraceSample& t) { return t.segment < segment; };
  return static_cast<std::size_t>(std::partition_point(trace.begin(), trace.end(), before) - trace.begin());
}

/// Samples of the mean, all segments; each segment has as many as the shortest member's.
std::vector<MeanSample> mean_samples(const std::vector<RunResult>& members)
{
  std::vector<MeanSample> samples;
  int segments = 0;
  for (const RunResult& m : members)
    if (!m.trace.empty()) segments = std::max(segments, m.trace.back().segment + 1);
  for (int segment = 0; segment < segments; ++segment) {
    std::size_t common = std::numeric_limits<std::size_t>::max();
    for (const RunResult& m : members)
      common = std::min(common, begin_of(segment + 1, m.trace) - begin_of(segment, m.trace));
    for (std::size_t k = 0; k < common; ++k) {
      // 0 at the segment's first sample, 1 at its last
      const double place = common > 1 ? static_cast<double>(k) / static_cast<double>(common - 1) : 0.0;
      MeanSample& sample = samples.emplace_back();
      for (const RunResult& m : members) {
        const std::size_t first = begin_of(segment, m.trace),
                          last = begin_of(segment + 1, m.trace) - 1 - first;
        const double index = place * static_cast<double>(last);
        const std::size_t below = std::min(static_cast<std::size_t>(index), last);
        sample.push_back(
            {first + below, first + std::min(below + 1, last), index - static_cast<double>(below)});
      }
    }
  }
  return samples;
}

}  // namespace

std::vector<TraceSample> mean_trace(const std::vector<RunResult>& members)
{
  if (members.size() == 1) return members.front().trace;
  const double weight = 1.0 / static_cast<double>(members.size());
  std::vector<TraceSample> trace;
  for (const MeanSample& sample : mean_samples(members)) {
    TraceSample mean = members.front().trace[sample.front().below];
    mean.time = mean.delta = mean.force = mean.contact_radius = 0;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const TraceSample &a = members[k].trace[sample[k].below], &b = members[k].trace[sample[k].above];
      for (const auto& [value, unit] : trace_numbers) mean.*value += weight * sample[k](a.*value, b.*value);
    }
    trace.push_back(mean);
  }
  return trace;
}

std::vector<PlaneTrace> mean_planes(const std::vector<RunResult>& members)
{
  std::vector<PlaneTrace> planes = members.front().planes;
  if (members.size() == 1 || planes.empty()) return planes;
  const double weight = 1.0 / static_cast<double>(members.size());
  const std::vector<MeanSample> samples = mean_samples(members);
  for (std::size_t p = 0; p < planes.size(); ++p) {
    planes[p].samples.clear();
    for (const MeanSample& sample : samples) {
      auto mean = numbers_of(PlaneSample{});
      for (std::size_t k = 0; k < members.size(); ++k) {
        const std::vector<PlaneSample>& from = members[k].planes[p].samples;
        const auto a = numbers_of(from[sample[k].below]), b = numbers_of(from[sample[k].above]);
        for (std::size_t d = 0; d < mean.size(); ++d) mean[d] += weight * sample[k](a[d], b[d]);
      }
      planes[p].samples.push_back(std::bit_cast<PlaneSample>(mean));
    }
  }
  return planes;
}

}  // namespace granulaw
