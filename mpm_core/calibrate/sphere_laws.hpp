#pragma once

#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "calibrate/atlas_errors.hpp"
#include "calibrate/parameters.hpp"
#include "atlas/atlas.hpp"
#include "atlas/departure.hpp"
#include "atlas/impacts_by_speed.hpp"
#include "contact/curve.hpp"

namespace granulaw {

/// Laws of one homogeneous sphere by the atlas: lengths over R, forces over 4/3 E* R^2. Impacts come from the
/// law shape itself, without the tables of a velocity axis, which `mpm table` makes of it: e is within 0.1 %
/// of a replay of that law (0.4 % at E*/Y over 1000), at a twentieth of the time.
class SphereLaws
{
 public:
  /// Ratios outside the atlas count as those at its edge. Of hardening that is not linear: stand_in(), and
  /// the departure of the material's own law from it, if there is one.
  SphereLaws(const Atlas& atlas, const CandidateMaterial& material, const Departure* departure = nullptr);
  SphereLaws(const Atlas& atlas, const MaterialRatios& material);
  SphereLaws(const SphereLaws&) = delete;  // impacts_ points into it
  SphereLaws& operator=(const SphereLaws&) = delete;

  const MaterialRatios& material() const { return material_; }
  const AtlasErrors& errors() const { return errors_; }
  double onset() const { return free_.onset(); }  ///< overlap where yield begins

  /// An impact on the rigid wall at v = sqrt(rho V^2/Y); faster than fastest() counts as that.
  struct Impact
  {
    double restitution, overlap, residual, contact_radius;
    double contact_time;  ///< over R/V
  };
  Impact impact(double v) const;
  static constexpr double fastest = 0.3;

  const LawShape& shape() const { return shape_; }
  const Curve& free() const { return free_; }  ///< slow press of a free sphere
  const Curve& midplane() const;               ///< of one held at its equator; made when asked for

 private:
  SphereLaws(const Atlas& atlas, const MaterialRatios& material, LawShape shape);
  double contact_time(double x, double residual, double restitution) const;

  MaterialRatios material_;
  AtlasErrors errors_;
  const Atlas* atlas_;
  double energy_unit_;
  LawShape shape_;
  Curve free_;
  ImpactsBySpeed impacts_;
  mutable std::optional<Curve> midplane_;
};

/// The laws of the last materials that were asked for: a fit also varies unknowns that are no property of the
/// material.
class SphereLawsCache
{
 public:
  explicit SphereLawsCache(const Atlas& atlas) : atlas_(atlas) {}
  std::shared_ptr<const SphereLaws> of(const CandidateMaterial& material);
  const Atlas& atlas() const { return atlas_; }
  /// The departure of all laws whose hardening is not linear, from now on.
  void set_departure(Departure departure);

 private:
  using Key = std::vector<double>;  // ratios: stresses over the yield stress
  static constexpr std::size_t most = 32;
  const Atlas& atlas_;
  std::optional<Departure> departure_;
  std::list<std::pair<Key, std::shared_ptr<const SphereLaws>>> kept_;
};

}  // namespace granulaw
