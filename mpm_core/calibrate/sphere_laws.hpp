#pragma once

#include <array>
#include <list>
#include <memory>
#include <optional>

#include "calibrate/parameters.hpp"
#include "characterise/atlas.hpp"
#include "characterise/impacts_by_speed.hpp"
#include "law/contact_curve.hpp"

namespace granulaw {

/// A shape's curve, as deep as it is a law, to `depth` at most: of a few interpolated ones the force falls or
/// the unloading is none before the end; beyond, the curve goes on with its last stiffness.
ContactCurve deepest_curve(const LawShape& shape, double onset, double shape_end, double depth);

/// What the atlas says of one homogeneous sphere: lengths over R, forces over 4/3 E* R^2. Impacts come from
/// the law shape itself, without the tables of a velocity axis, which `mpm table` makes of it: e is within
/// 0.1 % of a replay of that law (0.4 % at E*/Y over 1000), at a twentieth of the time.
class SphereLaws
{
 public:
  /// Ratios outside the atlas count as those at its edge.
  SphereLaws(const Atlas& atlas, const MaterialRatios& material);
  /// Of a material that does not harden linearly: flow_shape(), and what its own law departs from it by, if
  /// that is known.
  SphereLaws(const Atlas& atlas, const CandidateMaterial& material, const LawShape* departure);
  SphereLaws(const SphereLaws&) = delete;  // impacts_ points into it
  SphereLaws& operator=(const SphereLaws&) = delete;

  const MaterialRatios& material() const { return material_; }
  const Atlas* atlas() const { return atlas_; }
  double onset() const { return onset_; }  ///< overlap where yield begins

  /// An impact on the rigid wall at v = sqrt(rho V^2/Y); faster than fastest() counts as that.
  struct Impact
  {
    double restitution, overlap, residual, contact_radius;
    double contact_time;  ///< over R/V
  };
  Impact impact(double v) const;
  static constexpr double fastest = 0.3;

  const ContactCurve& free() const { return free_; }  ///< slow press of a free sphere
  const ContactCurve& midplane() const;               ///< of one held at its equator; made when asked for

 private:
  SphereLaws(const Atlas& atlas, const MaterialRatios& material, LawShape shape, ContactCurve free);
  double contact_time(double x, double residual, double restitution) const;
  ContactCurve make_midplane() const;

  MaterialRatios material_;
  const Atlas* atlas_;
  double onset_, energy_unit_;
  LawShape shape_;
  ContactCurve free_;
  std::unique_ptr<ImpactsBySpeed> impacts_;
  mutable std::unique_ptr<ContactCurve> midplane_;
};

/// Keeps the laws of the last materials that were asked for: a fit varies what is no property of the material
/// at a fixed material.
class SphereLawsCache
{
 public:
  explicit SphereLawsCache(const Atlas& atlas) : atlas_(atlas) {}
  const SphereLaws& of(const CandidateMaterial& material);
  const Atlas& atlas() const { return atlas_; }
  /// Of all laws whose hardening is not linear, from now on.
  void set_departure(LawShape departure);

 private:
  using Key = std::array<double, all_parameters.size()>;  // stresses over the yield stress
  static constexpr std::size_t most = 32;
  const Atlas& atlas_;
  std::optional<LawShape> departure_;
  std::list<std::pair<Key, SphereLaws>> kept_;
};

}  // namespace granulaw
