#include "calibrate/measurement.hpp"

#include <algorithm>
#include <cmath>

#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

bool is_shallower(const Datum& a, const Datum& b)
{
  return a.x < b.x;
}

}  // namespace

double Measurement::sphere_density(double fitted) const
{
  if (body.mass > 0) return body.mass / (4.0 / 3.0 * M_PI * radius * radius * radius);
  return counterpart_is_ball ? counterpart->density : fitted;
}

double Measurement::largest_x() const
{
  return std::max_element(data.begin(), data.end(), is_shallower)->x;
}

double Measurement::largest_y() const
{
  double most = 0;
  for (const Datum& d : data) most = std::max(most, d.y);
  return most;
}

double Measurement::effective_radius() const
{
  return indenter_radius > 0 ? 1 / (1 / radius + 1 / indenter_radius) : radius;
}

double Measurement::largest_overlap() const
{
  return largest_x() / effective_radius() / kind->contacts;
}

std::size_t Measurement::reversal() const
{
  return static_cast<std::size_t>(std::max_element(data.begin(), data.end(), is_shallower) - data.begin());
}

std::vector<Unloading> Measurement::unloadings() const
{
  constexpr double falls = 0.97;       // of the force at the reversal: less is scatter of the displacement
  constexpr double clear = 1.5;        // of the scatter's largest
  constexpr double no_contact = 0.02;  // of the largest force
  struct Recession
  {
    std::size_t top, last;
    double depth;
  };
  std::vector<Recession> found;
  double scatter = 0;
  const double unloaded = no_contact * largest_y();
  for (std::size_t top = 0; top + 1 < data.size();) {
    std::size_t last = top + 1;
    double least = data[top].x;
    for (; last < data.size() && data[last].x < data[top].x; ++last) least = std::min(least, data[last].x);
    const double depth = data[top].x - least;
    double sum = 0, count = 0;
    for (std::size_t k = top + 1; k < last; ++k)
      if (data[top].x - data[k].x >= 0.5 * depth) sum += data[k].y, count += 1;
    const double force = std::max(data[top].y, top > 0 ? data[top - 1].y : 0.0);
    if (count > 0 && force > unloaded) {
      if (sum / count < falls * force)
        found.push_back({top, last, depth});
      else
        scatter = std::max(scatter, depth);
    }
    top = last;
  }
  std::vector<Unloading> all;
  for (const Recession& r : found) {
    if (r.depth < clear * scatter || r.top < 2) continue;
    const auto x = [&](std::size_t back) { return data[r.top - back].x; };
    const bool turned = data[r.top].y < data[r.top - 1].y;
    all.push_back({turned ? r.top : r.top + 1, r.last, std::max(x(0) - x(1), x(1) - x(2))});
  }
  return all;
}

}  // namespace granulaw
