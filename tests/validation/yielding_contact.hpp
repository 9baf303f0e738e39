#pragma once

#include "law/law.hpp"

namespace granulaw {

/// Flow stress of a material that hardens linearly, Pa; no yield stress: elastic.
struct FlowStress
{
  double yield = 0, hardening = 0;
  double at(double strain) const { return yield + hardening * strain; }
};

/// Forces of one contact, N.
struct ContactForces
{
  double normal;
  double tangential;  ///< against the sliding
};

/// A contact that is elastic and plastic in both directions. F follows the law's unloading curve from its
/// depth: the largest overlap of a head-on contact that has flowed as far. T is a spring's, k_t = 8 G* a. It
/// flows where
///
///     F/F_0 = 1 - c + c sqrt(1 - q^2),   q = T/T_0,   F_0 the law's loading force at the depth,
///
/// in the direction of that curve's normal: sliding over deepening = c (F_0/T_0) q/sqrt(1 - q^2).
/// T_0 = w Y(strain)/sqrt(3) pi a^2 with the present radius a. The strain is Tabor's representative one, 0.2
/// a/R, and the shear's, s u/a of the flow's sliding u, their squares added.
class YieldingContact
{
 public:
  static constexpr double normal_loss = 0.35;  ///< c
  static constexpr double widening = 1.25;     ///< w
  static constexpr double shear_strain = 1.1;  ///< s
  static constexpr double tabor_strain = 0.2;  ///< Tabor, The Hardness of Metals (1951)

  /// `stiffness`: 8 G*, Pa; `impact_overlap`: what the law latched.
  YieldingContact(const PairLaw& pair, double radius, double impact_overlap, double stiffness,
                  double friction, const FlowStress& material)
      : pair_(pair),
        radius_(radius),
        impact_overlap_(impact_overlap),
        stiffness_(stiffness),
        friction_(friction),
        material_(material)
  {
  }

  /// At overlap `delta`, m, after the surfaces have moved against each other by `slide`, m, in `dt`.
  ContactForces move(double delta, double slide, double dt);

 private:
  Answer law(double delta, double depth) const
  {
    return pair_.evaluate(radius_, delta, depth, impact_overlap_);
  }
  double shear_strength(double contact_radius) const;  ///< T_0, N
  bool overloaded(double delta, double depth, double q) const;
  double sliding_slope(double strength) const;
  double flow(double delta, double k, double stretched, double strength);
  void flow_sliding(double delta, double strength);

  const PairLaw& pair_;
  double radius_, impact_overlap_, stiffness_, friction_;
  FlowStress material_;
  double stretch_ = 0;  // m, of the spring
  double depth_ = 0;    // m
  double slid_ = 0;     // m, sliding of the flow
};

}  // namespace granulaw
