#pragma once

#include <algorithm>
#include <cmath>

#include "contact/pair.hpp"

namespace granulaw {

/// Thornton's elastic-perfectly-plastic contact in closed form: the baseline.
/// C. Thornton, "Coefficient of restitution for collinear collisions of elastic-perfectly plastic spheres",
/// J. Appl. Mech. 64 (1997) 383. State: the largest overlap since first touch, as for Curve.
///
///   loading below yield  F = 4/3 E* sqrt(R*) d^1.5
///   loading beyond       F = F_y + pi p_y R* (d - d_y)
///   unloading, reloading F = 4/3 E* sqrt(R_p) (d - d_p)^1.5,
///                        R_p = (4 E*/(3 F_m)) ((2 F_m + F_y)/(2 pi p_y))^1.5
struct ThorntonPair
{
  double e_star;  ///< Pa, of the pair: 1/E* = 1/E*_i + 1/E*_j (one body's own where the partner is rigid)
  double yield_pressure;  ///< Pa, p_y = 1.6 Y of the weaker body (eq. 9 with the customary factor); infinity:
                          ///< elastic

  /// d_y = (pi p_y/(2 E*))^2 R*, m.
  double yield_overlap(double r_eff) const
  {
    const double q = M_PI * yield_pressure / (2.0 * e_star);
    return q * q * r_eff;
  }

  /// Force and stiffness at overlap `delta` (m, > 0); see Answer for units. No allocation, no
  /// exceptions.
  Answer evaluate(double r_eff, double delta, double delta_max) const
  {
    const double hertz = 4.0 / 3.0 * e_star;
    const double root = std::sqrt(r_eff * delta);
    const double d_y = yield_overlap(r_eff);
    const double reached = std::max(delta_max, delta);  // no number in either: none in the force
    if (reached <= d_y) return {hertz * root * delta, 2.0 * e_star * root, root, reached};
    const double f_y = hertz * std::sqrt(r_eff * d_y) * d_y;
    const double k_p = M_PI * yield_pressure * r_eff;
    if (delta >= delta_max) {
      const double force = f_y + k_p * (delta - d_y);
      // a from F = F_y + pi p_y (a^2 - a_y^2): pressure capped at p_y over the yielded disc (eq. 14 to 16)
      return {force, k_p, root, delta};
    }
    const double f_m = f_y + k_p * (delta_max - d_y);
    // With A = (2 F_m + F_y)/(2 pi p_y): R_p = 4 E* A^1.5/(3 F_m), d_m - d_p = 3 F_m/(4 E* sqrt A)
    const double area = (2.0 * f_m + f_y) / (2.0 * M_PI * yield_pressure), edge = std::sqrt(area);
    const double elastic = f_m / (hertz * edge);  // d_m - d_p
    const double part = (delta - (delta_max - elastic)) / elastic;
    if (part <= 0.0) return {0.0, 0.0, 0.0, delta_max, Answer::Branch::apart};
    const double root_part = std::sqrt(part), a = edge * root_part;  // sqrt(R_p (d - d_p))
    return {f_m * part * root_part, 2.0 * e_star * a, a, delta_max, Answer::Branch::unloading};
  }

  /// J, elastic energy that a contact holds at overlap `delta` (m): what it gives back on complete unloading.
  double stored_energy(double r_eff, double delta, double delta_max) const
  {
    const double reached = std::max(delta, delta_max);
    if (reached <= yield_overlap(r_eff)) return 0.4 * evaluate(r_eff, delta, delta).force * delta;
    // unloading is Hertz of another radius: 1.5 F_m/(its slope at the top) is the elastic part of the overlap
    const double top = evaluate(r_eff, reached, reached).force;
    const double elastic = 1.5 * top / unloading_stiffness(r_eff, reached);
    const double part = (delta - (reached - elastic)) / elastic;
    return part > 0.0 ? 0.4 * top * elastic * part * part * std::sqrt(part) : 0.0;
  }

  /// J, spent on plastic strain until the largest overlap is `delta_max` (m): loading work minus what is
  /// stored.
  double dissipated(double r_eff, double delta_max) const
  {
    const double d_y = yield_overlap(r_eff);
    if (delta_max <= d_y) return 0.0;
    const double f_y = evaluate(r_eff, d_y, 0.0).force, plastic = delta_max - d_y;
    const double loading = 0.4 * f_y * d_y + plastic * (f_y + 0.5 * M_PI * yield_pressure * r_eff * plastic);
    return loading - stored_energy(r_eff, delta_max, delta_max);
  }

  /// N/m, slope of the unloading curve at its top, the largest overlap `delta_max` (m): 2 E* a of the
  /// flattened contact, in the elastic range Hertz's.
  double unloading_stiffness(double r_eff, double delta_max) const
  {
    const Answer top = evaluate(r_eff, delta_max, delta_max);
    if (delta_max <= yield_overlap(r_eff)) return top.stiffness;
    const double f_y = evaluate(r_eff, yield_overlap(r_eff), 0.0).force;
    const double area = (2.0 * top.force + f_y) / (2.0 * M_PI * yield_pressure);
    return 2.0 * e_star * std::sqrt(area);
  }
};

/// Thornton's closed form e(V/V_y) (his eq. 41, with x = V_y/V <= 1): 1 below the yield velocity.
inline double thornton_restitution(double v_over_vy)
{
  if (v_over_vy <= 1.0) return 1.0;
  const double x = 1.0 / v_over_vy, x2 = x * x;
  return std::sqrt(6.0 * std::sqrt(3.0) / 5.0) * std::sqrt(1.0 - x2 / 6.0) *
         std::pow(x / (x + 2.0 * std::sqrt(1.2 - 0.2 * x2)), 0.25);
}

}  // namespace granulaw
