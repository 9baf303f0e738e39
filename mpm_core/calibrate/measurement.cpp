#include "calibrate/measurement.hpp"

#include <algorithm>

#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

bool is_shallower(const Datum& a, const Datum& b)
{
  return a.x < b.x;
}

}  // namespace

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

std::size_t Measurement::loading_rows() const
{
  const std::size_t top = reversal();
  const bool turned = top > 0 && top + 1 < data.size() && data[top].y < data[top - 1].y;
  return turned ? top : top + 1;
}

double Measurement::turn_gap() const
{
  const std::size_t top = reversal();
  if (top < 2 || loading_rows() == data.size()) return 0;
  return std::max(data[top].x - data[top - 1].x, data[top - 1].x - data[top - 2].x);
}

}  // namespace granulaw
