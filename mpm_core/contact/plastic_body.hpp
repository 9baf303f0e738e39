#pragma once

#include <vector>

#include "contact/contact.hpp"

namespace granulaw {

/// Numbers of one material in the law of a particle that is pressed from all sides (confined.hpp). Made once, of the law of one
/// contact. Stresses are over the yield stress Y, lengths over the particle's radius R, forces over Y R^2, stiffness over Y R,
/// energies over Y R^3.
class PlasticBody
{
 public:
  /// `curve`: of a sphere on the rigid wall, without its velocity axis, kept; `flow`: of its material, Pa, yields.
  PlasticBody(const Curve& curve, double youngs_modulus, double poisson_ratio, const FlowStress& flow);

  const Curve& curve() const { return *curve_; }
  double youngs_modulus() const { return modulus_; }      ///< E/Y
  double poisson_ratio() const { return poisson_; }
  double bulk_modulus() const { return modulus_ / (3.0 - 6.0 * poisson_); }
  /// Flow stress at an equivalent plastic strain, over Y: 1 without hardening.
  double flow_stress(double strain) const { return flow_.hardens() ? flow_.at(strain) / flow_.yield : 1.0; }
  bool hardens() const { return flow_.hardens(); }
  /// 4/3 E*: Hertz's force at an overlap of R.
  double unit() const { return unit_; }

  /// Force of one contact at an overlap, of first loading.
  double force(double overlap) const { return overlap > 0 ? unit_ * curve_->force(overlap) : 0.0; }
  /// A contact whose largest overlap is `deepest`.
  struct PairAnswer
  {
    double force = 0, stiffness = 0, stored = 0, lost = 0;
    double residual = 0;  ///< overlap at which the force ends
    double area = 0;
  };
  PairAnswer pair(double overlap, double deepest) const;
  /// What such a contact has dissipated.
  double lost(double deepest) const { return unit_ * curve_->lost(deepest); }

  /// Part of the mean strain of one force that is in the compliance of one contact.
  static constexpr double own_part = 0.5;
  /// Force that one contact bears whose face has the radius a, where nothing else presses: L'.
  double cap(double radius) const { return at(caps_, radius); }
  /// Stiffness of a spring that stores at that force what the contact gives back.
  double stiffness(double radius) const { return at(springs_, radius); }

 private:
  static constexpr double step = 0.005;  // of the radius, over R
  static double at(const std::vector<double>& table, double x);

  const Curve* curve_;
  double unit_, modulus_, poisson_;
  FlowStress flow_;
  std::vector<double> caps_, springs_;
};

}  // namespace granulaw
