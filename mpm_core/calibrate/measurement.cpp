#include "calibrate/measurement.hpp"

#include <algorithm>

namespace granulaw {

bool is_curve(MeasurementKind kind)
{
  return kind == MeasurementKind::platens || kind == MeasurementKind::flat ||
         kind == MeasurementKind::indenter;
}

bool is_impact(MeasurementKind kind)
{
  return kind == MeasurementKind::restitution || kind == MeasurementKind::contact_radius ||
         kind == MeasurementKind::residual_displacement || kind == MeasurementKind::contact_time;
}

std::size_t Measurement::reversal() const
{
  const auto deepest =
      std::max_element(data.begin(), data.end(), [](const Datum& a, const Datum& b) { return a.x < b.x; });
  return static_cast<std::size_t>(deepest - data.begin());
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

double Measurement::effective_radius() const
{
  return kind == MeasurementKind::indenter ? 1 / (1 / radius + 1 / indenter_radius) : radius;
}

}  // namespace granulaw
