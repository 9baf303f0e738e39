#pragma once

#include <algorithm>
#include <cmath>

#include "contact/normal.hpp"
#include "contact/pair.hpp"

namespace granulaw {

/// Thornton's elastic-perfectly-plastic contact in closed form: the baseline.
/// C. Thornton, "Coefficient of restitution for collinear collisions of elastic-perfectly plastic spheres",
/// J. Appl. Mech. 64 (1997) 383. State: the largest overlap d_m since first touch.
///
///   loading below yield  F = 4/3 E* sqrt(R*) d^1.5
///   loading beyond       F = F_y + pi p_y R* (d - d_y),  d_y = (pi p_y/(2 E*))^2 R*  (eq. 9)
///   unloading, reloading F = 4/3 E* sqrt(R_p) (d - d_p)^1.5 = F_m p^1.5,  p = 1 - (d_m - d)/(d_m - d_p),
///                        R_p = 4 E* A^1.5/(3 F_m),  A = (2 F_m + F_y)/(2 pi p_y),  d_m - d_p = 3 F_m/(4 E* sqrt A)
///
/// In the caller's units, stretched: F(d/S)/S does the same work to S times the overlap, and is softer by S^2. A
/// contact keeps 1/(d_m - d_p), the one number of this that takes a root and a division.
struct Thornton : FormulaContact
{
  static constexpr std::array history_values{HistoryValue{.name = "reversal_overlap", .derived = true},  // R* d_m
                                    HistoryValue{.name = "reversal", .derived = true}};         // 1/(d_m - d_p)

  double e_star = 0.0;          ///< Pa, of the pair: 1/E* = 1/E*_i + 1/E*_j (one body's own where the partner is rigid)
  double yield_pressure = 0.0;  ///< Pa, p_y of the weaker body; infinity: elastic (Hertz)
  double per_stretch = 1.0;
  // Stretched. Over powers of R*: F = hertz sqrt(R* d) d, d_y, F_y, dF/dd beyond.
  double hertz = 0.0, onset = 0.0, onset_force = 0.0, plastic_slope = 0.0;
  double softened = 0.0, per_area = 0.0;  // 4/3 E* S^-2; (2 F_m + F_y) per_area = A softened^2

  Thornton() = default;
  Thornton(double pair_e_star, double p_y, double stretch = 1.0)
      : e_star(pair_e_star),
        yield_pressure(p_y),
        per_stretch(1.0 / stretch),
        hertz(4.0 / 3.0 * e_star * std::pow(per_stretch, 2.5)),
        onset(stretch * std::pow(M_PI * yield_pressure / (2.0 * e_star), 2)),
        onset_force(hertz * std::sqrt(onset) * onset),
        plastic_slope(M_PI * yield_pressure * per_stretch * per_stretch),
        softened(4.0 / 3.0 * e_star * per_stretch * per_stretch),
        per_area(softened * softened / (2.0 * M_PI * yield_pressure * per_stretch))
  {
  }

  /// For a caller that keeps the largest overlap alone.
  Answer evaluate(double r_eff, double delta, double delta_max) const
  {
    double history[values_of(history_values)] = {};
    const auto [f, k] = response(r_eff, delta, delta_max, 0.0, history);
    return {f, k, contact_radius(r_eff, delta, delta_max, 0.0), std::max(delta_max, delta)};
  }

  double force(double r_eff, double delta, double delta_max, double, double* history) const
  {
    if (loads(r_eff, delta, delta_max)) return loading(r_eff, delta, 0.0);
    const double top = force_at_top(r_eff, delta_max);
    const double part = std::max(1.0 - (delta_max - delta) * reversal(r_eff, delta_max, top, history), 0.0);
    return top * part * std::sqrt(part);
  }
  Response response(double r_eff, double delta, double delta_max, double, double* history) const
  {
    if (loads(r_eff, delta, delta_max))
      return {loading(r_eff, delta, 0.0),
              delta <= onset * r_eff ? 1.5 * hertz * std::sqrt(r_eff * delta) : plastic_slope * r_eff};
    const double top = force_at_top(r_eff, delta_max), per_elastic = reversal(r_eff, delta_max, top, history);
    const double part = std::max(1.0 - (delta_max - delta) * per_elastic, 0.0), root = std::sqrt(part);
    return {top * part * root, 1.5 * top * root * per_elastic};
  }
  double loading(double r_eff, double delta, double) const
  {
    return delta <= onset * r_eff ? hertz * std::sqrt(r_eff * delta) * delta : force_at_top(r_eff, delta);
  }
  double grow(double r_eff, double from, double to, double impact_overlap, double* history) const
  {
    if (to <= onset * r_eff) return 0.0;
    const double after = force_at_top(r_eff, to), per_after = per_elastic(r_eff, after);
    double spent = 0.0;
    if (from <= onset * r_eff) [[unlikely]]
      spent = dissipated(r_eff, from, to, impact_overlap);
    else {
      const double before = force_at_top(r_eff, from);
      const double per_before = history[0] == r_eff * from && history[1] > 0.0 ? history[1] : per_elastic(r_eff, before);
      // what loads a contact beyond its yield is linear, what it gives back is 2/5 F_m (d_m - d_p)
      spent = 0.5 * (before + after) * (to - from) - 0.4 * (after / per_after - before / per_before);
    }
    history[0] = r_eff * to;
    history[1] = per_after;
    return spent;
  }
  void postpone(double* history) const { history[1] = -std::abs(history[1]); }
  bool owes(double r_eff, double delta_max, const double* history) const
  {
    return history[0] != r_eff * delta_max && !(history[1] > 0.0);
  }
  double booked(double r_eff, const double* history) const { return history[0] / r_eff; }
  double settle(double r_eff, double delta_max, double impact_overlap, double* history) const
  {
    history[1] = std::abs(history[1]);
    const double lost = grow(r_eff, booked(r_eff, history), delta_max, impact_overlap, history);
    history[0] = r_eff * delta_max;
    return lost;
  }
  double contact_radius(double r_eff, double delta, double delta_max, double) const
  {
    if (loads(r_eff, delta, delta_max)) return std::sqrt(r_eff * delta * per_stretch);  // eq. 14 to 16
    const double top = force_at_top(r_eff, delta_max), per_top = per_elastic(r_eff, top);
    const double part = std::max(1.0 - (delta_max - delta) * per_top, 0.0);
    return top * per_top / softened * std::sqrt(part);  // sqrt(A p)
  }
  double yield_overlap() const { return onset; }
  double pair_modulus() const { return e_star; }
  double dissipated(double r_eff, double from, double to, double) const
  {
    return dissipated(r_eff, to) - dissipated(r_eff, from);
  }
  double stored_energy(double r_eff, double delta, double delta_max, double) const
  {
    if (std::max(delta, delta_max) <= onset * r_eff) return 0.4 * loading(r_eff, delta, 0.0) * delta;
    const double reached = std::max(delta, delta_max), top = force_at_top(r_eff, reached);
    const double per_top = per_elastic(r_eff, top), part = std::max(1.0 - (reached - delta) * per_top, 0.0);
    return 0.4 * top / per_top * part * part * std::sqrt(part);
  }
  double stiffness(double r_eff, double delta, double) const
  {
    if (delta <= onset * r_eff) return 1.5 * hertz * std::sqrt(r_eff * delta);
    const double top = force_at_top(r_eff, delta);
    return std::max(plastic_slope * r_eff, 1.5 * top * per_elastic(r_eff, top));
  }
  double stiffness_range() const { return FormulaContact::stiffness_range() / per_stretch; }

 private:
  /// J, until the largest overlap is `delta_max`: the work of loading less what unloading gives back.
  double dissipated(double r_eff, double delta_max) const
  {
    const double plastic = delta_max - onset * r_eff;
    if (plastic <= 0.0) return 0.0;
    const double yield = onset_force * (r_eff * r_eff), top = force_at_top(r_eff, delta_max);
    return 0.4 * yield * onset * r_eff + 0.5 * plastic * (yield + top) - 0.4 * top / per_elastic(r_eff, top);
  }
  bool loads(double r_eff, double delta, double delta_max) const
  {
    return delta_max <= onset * r_eff || delta >= delta_max;
  }
  /// 1/(d_m - d_p), out of `history` where that holds it, and stored there else.
  double reversal(double r_eff, double delta_max, double top, double* history) const
  {
    const double key = r_eff * delta_max;
    if (history[0] != key) [[unlikely]] {
      history[0] = key;
      history[1] = per_elastic(r_eff, top);
    }
    return history[1];
  }
  /// N, at a largest overlap beyond first yield.
  double force_at_top(double r_eff, double delta_max) const
  {
    return onset_force * (r_eff * r_eff) + plastic_slope * r_eff * (delta_max - onset * r_eff);
  }
  /// 1/m: 1/(d_m - d_p) of a contact whose force at the largest overlap is `top`.
  double per_elastic(double r_eff, double top) const
  {
    return std::sqrt((2.0 * top + onset_force * (r_eff * r_eff)) * per_area) / top;
  }
};

static_assert(NormalLaw<Thornton> && BooksLater<Thornton>);

/// Thornton's closed form e(V/V_y) (his eq. 41, with x = V_y/V <= 1): 1 below the yield velocity.
inline double thornton_restitution(double v_over_vy)
{
  if (v_over_vy <= 1.0) return 1.0;
  const double x = 1.0 / v_over_vy, x2 = x * x;
  return std::sqrt(6.0 * std::sqrt(3.0) / 5.0) * std::sqrt(1.0 - x2 / 6.0) *
         std::pow(x / (x + 2.0 * std::sqrt(1.2 - 0.2 * x2)), 0.25);
}

}  // namespace granulaw
