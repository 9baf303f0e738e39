#pragma once

#include <vector>

#include "characterise/interpolation.hpp"
#include "characterise/law_shape.hpp"
#include "law/contact_curve.hpp"

namespace granulaw {

/// A shape's velocity effects as functions of the speed v = sqrt(rho V^2/Y). Inertia: Lagrange's polynomials
/// in v through the standstill, where it changes nothing; it goes as v^2, so the two slowest impacts stand at
/// -v, too. A rate: the same in ln v, and below its slowest impact as there.
class ImpactsBySpeed
{
 public:
  /// `energy_unit`: kinetic energy at v = 1 over 4/3 E* R^3, the unit of ContactCurve's work. `slow` and
  /// `shape` outlive this.
  ImpactsBySpeed(const LawShape& shape, const ContactCurve& slow, double energy_unit,
                 VelocityAxis::Kind kind);

  /// X: the overlap/R that an impact reaches.
  double impact_overlap(double v) const;
  /// Its inverse, between `slowest` and `fastest`.
  double speed(double impact_overlap, double slowest, double fastest) const;
  /// What an impact changes, at any speed; its log_overlap is left out.
  LawShape::VelocityEffect effect(double v) const;

 private:
  template <class Of>
  double mix(double v, const Of& of) const;
  double slow_impact_overlap(double v) const;

  const LawShape& shape_;
  const ContactCurve& slow_;
  double energy_unit_;
  bool rate_;
  static constexpr auto standstill = static_cast<std::size_t>(-1);  // where inertia changes nothing
  std::vector<double> nodes_;              // where speeds are known: v, of a rate ln v
  std::vector<std::size_t> sources_;       // and which of the shape's it is
  std::vector<double> log_overlap_ratio_;  // over the rate-free law's, by the shape's speeds
};

}  // namespace granulaw
