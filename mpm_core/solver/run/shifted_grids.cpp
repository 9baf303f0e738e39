#include "solver/run/shifted_grids.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <span>
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

/// A member's samples of one segment.
using SegmentSamples = std::span<const TraceSample>;

/// Cuts each member's samples of `segment` off the front of what is left of its trace.
std::vector<SegmentSamples> take_segment(std::vector<SegmentSamples>& left, int segment)
{
  std::vector<SegmentSamples> taken;
  for (SegmentSamples& samples : left) {
    std::size_t length = 0;
    while (length < samples.size() && samples[length].segment == segment) ++length;
    taken.push_back(samples.first(length));
    samples = samples.subspan(length);
  }
  return taken;
}

/// The mean at `place`, 0 at the segment's first sample, 1 at its last; linear between samples.
TraceSample mean_at(const std::vector<SegmentSamples>& members, double place, TraceSample mean)
{
  const double weight = 1.0 / static_cast<double>(members.size());
  mean.time = mean.delta = mean.force = mean.contact_radius = 0;
  for (const SegmentSamples& samples : members) {
    const std::size_t last = samples.size() - 1;
    const double index = place * static_cast<double>(last);
    const std::size_t below = std::min(static_cast<std::size_t>(index), last);
    const TraceSample &a = samples[below], &b = samples[std::min(below + 1, last)];
    const double t = index - static_cast<double>(below);
    for (double TraceSample::*value :
         {&TraceSample::time, &TraceSample::delta, &TraceSample::force, &TraceSample::contact_radius})
      mean.*value += weight * ((1 - t) * a.*value + t * b.*value);
  }
  return mean;
}

}  // namespace

std::vector<TraceSample> mean_trace(const std::vector<RunResult>& members)
{
  if (members.size() == 1) return members.front().trace;
  std::vector<SegmentSamples> left;
  for (const RunResult& member : members) left.emplace_back(member.trace);
  std::vector<TraceSample> mean;
  for (int segment = 0;; ++segment) {
    const std::vector<SegmentSamples> now = take_segment(left, segment);
    const auto shorter = [](const SegmentSamples& a, const SegmentSamples& b) { return a.size() < b.size(); };
    const auto [shortest, longest] = std::minmax_element(now.begin(), now.end(), shorter);
    if (longest->empty()) return mean;
    const std::size_t common = shortest->size();
    for (std::size_t k = 0; k < common; ++k) {
      const double place = common > 1 ? static_cast<double>(k) / static_cast<double>(common - 1) : 0.0;
      mean.push_back(mean_at(now, place, now.front()[k]));
    }
  }
}

}  // namespace granulaw
