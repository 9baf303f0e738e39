#include "liggghts_plugin/plan/waiting_loops.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw::plugin::plan {

namespace {

double distance(const Box& a, const Box& b)
{
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double gap = std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

double diagonal(const Box& box)
{
  const Box::Point size = box.size();
  return std::hypot(size[0], size[1], size[2]);
}

/// Way of the corner that moved farthest.
double way(const Box& from, const Box& to)
{
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max({longest, std::abs(to.low[k] - from.low[k]), std::abs(to.high[k] - from.high[k])});
  return longest;
}

}  // namespace

bool WaitingLoops::arrive(const std::string& where, std::size_t runs, const Places& places)
{
  const auto [found, is_new] = runs_.try_emplace(where, runs);
  const bool is_pass = !is_new && runs > found->second;
  found->second = runs;
  if (where != where_ || !is_pass) {
    where_ = where;
    passes_ = is_pass ? 1 : 0;
    stride_ = 1, nothing_new_ = false;
    least_.clear();
  } else {
    ++passes_;
  }
  follow(places);
  before_ = places;
  return passes_ == 1;
}

/// Sets whether the loop is left, and the stride.
void WaitingLoops::follow(const Places& places)
{
  leaves_ = inside() && nothing_new_;
  if (places.meshes.empty() || places.centres.empty()) return;
  constexpr int plain_passes = 64;    // of the deck's own way
  constexpr double long_passes = 100;  // for the way through all that there is
  bool all_gone = true;
  double longest = 0;
  Box everything = places.centres;
  for (const auto& [id, box] : places.meshes) {
    const double now = distance(box, places.centres);
    double& least = least_.try_emplace(id, now).first->second;
    everything.include(box);
    all_gone = all_gone && now > least + 1e-9 * diagonal(box);
    least = std::min(least, now);
    if (const auto last = before_.meshes.find(id); last != before_.meshes.end()) longest = std::max(longest, way(last->second, box));
  }
  leaves_ = leaves_ || (inside() && all_gone);
  if (passes_ < plain_passes || longest == 0) return;
  stride_ = std::max(1.0, diagonal(everything) / long_passes / (longest / stride_));
}

double WaitingLoops::decide(double value)
{
  if (!leaves_) return value;
  leaves_ = nothing_new_ = false;
  passes_ = 0, stride_ = 1;
  return value == 0 ? 1 : 0;
}

}  // namespace granulaw::plugin::plan
