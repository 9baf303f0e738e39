#include "solver/run/shifted_grids.hpp"

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

namespace {

/// Between two samples of a member's trace.
struct Between
{
  std::size_t below, above;
  double t;

  double operator()(double a, double b) const { return (1 - t) * a + t * b; }
};
/// What one sample of the mean is made of: for each member, where in its trace.
using MeanSample = std::vector<Between>;

/// Samples of a member's trace in one segment: the first, and how many.
struct SegmentSamples
{
  std::size_t first, count;
};

/// The samples of `segment` in each member's trace, which begin at `next`; `next` moves on behind them.
std::vector<SegmentSamples> take_segment(const std::vector<RunResult>& members,
                                         std::vector<std::size_t>& next, int segment)
{
  std::vector<SegmentSamples> taken;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const std::vector<TraceSample>& trace = members[k].trace;
    const std::size_t first = next[k];
    while (next[k] < trace.size() && trace[next[k]].segment == segment) ++next[k];
    taken.push_back({first, next[k] - first});
  }
  return taken;
}

/// `place`: 0 at the segment's first sample, 1 at its last; linear between samples.
MeanSample mean_sample_at(const std::vector<SegmentSamples>& members, double place)
{
  MeanSample sample;
  for (const SegmentSamples& samples : members) {
    const std::size_t last = samples.count - 1;
    const double index = place * static_cast<double>(last);
    const std::size_t below = std::min(static_cast<std::size_t>(index), last);
    sample.push_back({samples.first + below, samples.first + std::min(below + 1, last),
                      index - static_cast<double>(below)});
  }
  return sample;
}

/// Of all segments; each has as many samples as the shortest member's.
std::vector<MeanSample> mean_samples(const std::vector<RunResult>& members)
{
  std::vector<std::size_t> next(members.size(), 0);
  std::vector<MeanSample> samples;
  for (int segment = 0;; ++segment) {
    const std::vector<SegmentSamples> now = take_segment(members, next, segment);
    const auto shorter = [](const SegmentSamples& a, const SegmentSamples& b) { return a.count < b.count; };
    const auto [shortest, longest] = std::minmax_element(now.begin(), now.end(), shorter);
    if (longest->count == 0) return samples;
    const std::size_t common = shortest->count;
    for (std::size_t k = 0; k < common; ++k)
      samples.push_back(
          mean_sample_at(now, common > 1 ? static_cast<double>(k) / static_cast<double>(common - 1) : 0.0));
  }
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
      for (double TraceSample::*value :
           {&TraceSample::time, &TraceSample::delta, &TraceSample::force, &TraceSample::contact_radius})
        mean.*value += weight * sample[k](a.*value, b.*value);
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
    planes[p].samples.assign(samples.size(), PlaneSample{});
    for (std::size_t n = 0; n < samples.size(); ++n)
      for (std::size_t k = 0; k < members.size(); ++k) {
        const std::vector<PlaneSample>& from = members[k].planes[p].samples;
        const Between& between = samples[n][k];
        const PlaneSample &a = from[between.below], &b = from[between.above];
        PlaneSample& mean = planes[p].samples[n];
        mean.delta += weight * between(a.delta, b.delta), mean.force += weight * between(a.force, b.force);
        for (auto PlaneSample::*value : {&PlaneSample::vector, &PlaneSample::torque, &PlaneSample::centre})
          for (int d = 0; d < 3; ++d) (mean.*value)[d] += weight * between((a.*value)[d], (b.*value)[d]);
        for (int d = 0; d < 2; ++d) mean.axes[d] += weight * between(a.axes[d], b.axes[d]);
      }
  }
  return planes;
}

}  // namespace granulaw
