#pragma once

#include <vector>

#include "law/law_shape.hpp"
#include "atlas/speed_interpolation.hpp"
#include "contact/curve.hpp"

namespace granulaw {

/// A shape's velocity effects as functions of the speed v = sqrt(rho V^2/Y).
class ImpactsBySpeed
{
 public:
  /// `energy_unit`: kinetic energy at v = 1 over 4/3 E* R^3, the unit of Curve's work. `slow` and
  /// `shape` outlive this.
  ImpactsBySpeed(const LawShape& shape, const Curve& slow, double energy_unit,
                 AxisTable::By kind);

  /// X: the overlap/R that an impact reaches.
  double impact_overlap(double v) const;
  /// Its inverse, between `slowest` and `fastest`.
  double speed(double impact_overlap, double slowest, double fastest) const;
  /// Effect of an impact at any speed; its log_overlap is left out.
  LawShape::VelocityEffect effect(double v) const;

 private:
  double slow_impact_overlap(double v) const;

  const LawShape& shape_;
  const Curve& slow_;
  double energy_unit_;
  SpeedInterpolation between_;
  std::vector<double> log_overlap_ratio_;  // over the rate-independent law's, by the shape's speeds
};

}  // namespace granulaw
