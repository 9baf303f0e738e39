#include "deck/speeds.hpp"

#include <algorithm>
#include <cmath>

#include "deck/plan_options.hpp"

namespace granulaw::deck {

SpeedBound::SpeedBound(const Scene& scene, const std::map<int, AtomType>& types, const PlanOptions& options)
    : scene_(scene), g_(norm(scene.gravity)), drop_height_(options.drop_height)
{
  if (g_ > 0) upward_ = -1 / g_ * scene.gravity;
  for (const Wall& w : scene.walls) {
    push_ = std::max(push_, w.push_speed);
    drag_ = std::max({drag_, w.speed, w.drag_speed});
  }
  for (const Wall& w : scene.walls)
    if (w.level_push_speed > shake_ && encloses(w)) shake_ = w.level_push_speed;
  follow_sources(types);
  double largest_radius = 0;
  for (const auto& [type, t] : types) largest_radius = std::max(largest_radius, t.radius_max);
  find_walls(largest_radius);
}

/// True of a wall around all starts, as seen along gravity: a box.
bool SpeedBound::encloses(const Wall& wall) const
{
  for (const Source& s : scene_.sources)
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(upward_[k]) < 0.5 && (s.centres.low[k] < wall.box.low[k] || s.centres.high[k] > wall.box.high[k])) return false;
  return true;
}

/// A wall that rises takes what lies on it along, to its own top at most.
void SpeedBound::lift(Flight& flight) const
{
  const double start = flight.top;
  for (const Wall& w : scene_.walls)
    if (w.lift > 0) flight.top = std::max(flight.top, std::min(w.box.top(upward_) + flight.radius_min, start + w.lift));
}

void SpeedBound::follow_sources(const std::map<int, AtomType>& types)
{
  for (const Source& s : scene_.sources) {
    const auto [found, is_new] = flights_.try_emplace(s.type);
    Flight& f = found->second;
    const double top = g_ > 0 ? s.centres.top(upward_) : 0.0;
    f.known = f.known && (g_ == 0 || std::isfinite(top));
    f.top = is_new ? top : std::max(f.top, top);
    f.speed = std::max(f.speed, s.speed);
  }
  for (const auto& [type, t] : types) {
    Flight& f = flights_.try_emplace(type, Flight{0, 0, 0, g_ == 0}).first->second;
    f.radius_min = t.radius_min;
    if (g_ > 0) lift(f);
  }
}

/// Greatest height that particles reach if they start upwards at their first speed; infinite where a start is not known.
double SpeedBound::highest() const
{
  if (g_ == 0) return Box::infinity;
  double height = -Box::infinity;
  for (const Source& s : scene_.sources) {
    const Flight& f = flights_.at(s.type);
    if (!f.known) return Box::infinity;
    height = std::max(height, f.top + f.speed * f.speed / (2 * g_));
  }
  return height;
}

void SpeedBound::find_walls(double largest_radius)
{
  const double reached = highest() + largest_radius;
  for (const Wall& w : scene_.walls) {
    if (g_ > 0 && w.box.bottom(upward_) > reached) continue;
    walls_.push_back(&w);
    if (g_ > 0) floor_ = std::min(floor_, w.box.bottom(upward_));
  }
  if (g_ > 0 && walls_.empty() && !scene_.domain.empty()) floor_ = scene_.domain.bottom(upward_);
}

double SpeedBound::falling_speed(const Flight& f, double radius, double height) const
{
  const double fall = drop_height_.value_or(std::max(0.0, f.top - radius - height));
  return std::sqrt(f.speed * f.speed + drag_ * drag_ + 2 * g_ * fall);
}

double SpeedBound::free_speed(int type, double radius, double height) const
{
  const Flight& f = flights_.at(type);
  const double speed = f.known || drop_height_ ? falling_speed(f, radius, height) : 0.0;
  return std::isfinite(speed) ? speed : 0.0;
}

double SpeedBound::start_speed(int type) const { return flights_.at(type).speed; }

void SpeedBound::ask_for_missing(std::vector<Question>& questions) const
{
  bool unknown = false;
  for (const auto& [type, f] : flights_)
    if (g_ > 0 && (!f.known || !std::isfinite(floor_) || !std::isfinite(falling_speed(f, 0, floor_)))) unknown = true;
  if (unknown && !drop_height_) ask(questions, "from how high the particles fall", "--drop-height H");
  if (!scene_.unknown_speeds.empty()) ask(questions, first_of(scene_.unknown_speeds), "--speed V");
}

double SpeedBound::fall() const
{
  if (drop_height_) return *drop_height_;
  double largest = 0;
  if (g_ > 0 && std::isfinite(floor_))
    for (const auto& [type, f] : flights_)
      if (f.known) largest = std::max(largest, f.top - f.radius_min - floor_);
  return largest;
}

}  // namespace granulaw::deck
