#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/curve.hpp"
#include "contact/pair.hpp"

namespace granulaw {

/// Flow stress over equivalent plastic strain, of hardening that is not linear: straight between the nodes, the
/// first at no strain, and constant beyond the last. Pa.
struct FlowNodes
{
  std::vector<double> strain, stress;

  double at(double strain_now) const
  {
    const auto after = std::upper_bound(strain.begin(), strain.end(), strain_now);
    if (after == strain.end()) return stress.back();
    const auto k = static_cast<std::size_t>(after - strain.begin());
    return stress[k - 1] +
           (stress[k] - stress[k - 1]) * (strain_now - strain[k - 1]) / (strain[k] - strain[k - 1]);
  }
};

/// Flow stress of a material in the caller's unit; infinite: elastic.
struct FlowStress
{
  double yield = std::numeric_limits<double>::infinity(), hardening = 0;
  const FlowNodes* nodes = nullptr;  ///< null: it hardens linearly
  double unit = 1;                   ///< Pa, of the nodes

  bool hardens() const { return nodes || hardening > 0; }
  double at(double strain) const { return nodes ? nodes->at(strain) / unit : yield + hardening * strain; }
};

/// Numbers of the yielding body: how fast an impact is, and what shear it bears.
struct ImpactMeasure
{
  double density = 0;                                             ///< kg/m^3
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Pa
  double mass_ratio = 1;                                          ///< mass over rho 4/3 pi R^3
  double hardening_modulus = 0;                                   ///< Pa
  const FlowNodes* flow = nullptr;                                ///< null: it hardens linearly

  /// v = sqrt(I) of a collision at this relative normal speed, m/s: see AxisTable.
  double axis_speed(const PairMapping& mapping, double r_eff, double m_eff, double speed) const
  {
    // A pair moves like one body of radius lambda R* and mass lambda m* against the rigid wall.
    const double length = mapping.length(r_eff), volume = 4.0 / 3.0 * M_PI * length * length * length;
    return speed * std::sqrt(mapping.sqrt_lambda * mapping.sqrt_lambda * m_eff /
                             (mass_ratio * volume * yield_stress));
  }
  /// v of the velocity axis over the relative normal speed, s/m (AxisTable).
  double per_speed(const AxisTable& axis, const PairMapping& mapping, double r_eff, double m_eff) const
  {
    if (axis.by == AxisTable::By::inertia) return axis_speed(mapping, r_eff, m_eff, 1.0);
    return std::sqrt(density / yield_stress) * axis.reference_radius / mapping.length(r_eff);
  }
  /// Damage number I = rho V^2/Y, V = speed/sqrt(lambda) the yielding body's share of the approach (all on a
  /// rigid wall, half between like bodies). 0: the body is elastic.
  double damage_number(const PairMapping& mapping, double speed) const
  {
    const double share = speed / mapping.sqrt_lambda;
    return density * share * share / yield_stress;
  }
};

/// A pair of bodies under one law.
struct PairContact
{
  const Curve* curve = nullptr;  ///< of the yielding body, or the pair's own
  PairMapping mapping;
  double radiation = 0;  ///< C of the dashpot that stands for waves, s^3/kg; 0: the curve has what waves take
};

/// Units that carry a contact to its curve: of overlap 1/per_length, of force and of contact radius.
struct PairUnits
{
  double per_length, force, radius;

  static PairUnits of(const PairMapping& mapping, double r_eff)
  {
    return {1.0 / mapping.length(r_eff), mapping.force(r_eff), mapping.radius(r_eff)};
  }
};

/// The law: force, stiffness and contact radius of a pair at overlap `delta` (m, > 0) whose largest overlap
/// so far is `delta_max` (m) and which latched X. No allocation, no exception.
inline Answer answer(const Curve& curve, const PairUnits& units, double delta, double delta_max,
                     double latched = 0)
{
  const auto [per_length, force, radius] = units;
  const double x = delta * per_length, x_max = delta_max * per_length;
  if (!curve.unloads(x, x_max)) {
    const Curve::Loading now = curve.loading(x, latched);
    return {force * now.force, force * per_length * now.stiffness, radius * now.radius,
            std::max(delta, delta_max)};
  }
  const Reversal reversal = curve.reversal(x_max, latched);
  const double u = reversal.part(x);
  if (u <= 0.0) return {0.0, 0.0, 0.0, delta_max};
  const double root = std::sqrt(u);
  return {force * reversal.force_at(u, root), force * per_length * reversal.slope_at(u, root) * reversal.per_span,
          radius * curve.radius(x_max) * curve.unloading_radius(x_max).share(root), delta_max};
}

inline Answer answer(const Curve& curve, const PairMapping& mapping, double r_eff, double delta,
                     double delta_max, double latched = 0)
{
  return answer(curve, PairUnits::of(mapping, r_eff), delta, delta_max, latched);
}

}  // namespace granulaw
