#pragma once

#include <algorithm>
#include <cmath>

#include "contact/normal.hpp"
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
  double yield_pressure;  ///< Pa, p_y of the weaker body (eq. 9); infinity: elastic

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
    if (part <= 0.0) return {0.0, 0.0, 0.0, delta_max};
    const double root_part = std::sqrt(part), a = edge * root_part;  // sqrt(R_p (d - d_p))
    return {f_m * part * root_part, 2.0 * e_star * a, a, delta_max};
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

/// N/m: of the steeper branch of a contact that has just reached `delta` (m).
inline double planned_stiffness(const ThorntonPair& law, double r_eff, double delta)
{
  return std::max(law.evaluate(r_eff, delta, delta).stiffness, law.unloading_stiffness(r_eff, delta));
}

/// One pair of bodies under ThorntonPair, in the caller's units, stretched. F(d/S)/S does the same work to S
/// times the overlap, and is softer by S^2.
///
/// The force is ThorntonPair's but for rounding, with all that does not change worked out. At the largest
/// overlap d_m beyond d_y it is F_m; below, F_m p^1.5 with p = 1 - (d_m - d)/(d_m - d_p). A contact keeps
/// 1/(d_m - d_p), the one number of this that takes a root and a division.
struct Thornton : FormulaContact
{
  static constexpr std::array history_values{HistoryValue{.name = "reversal_overlap", .derived = true},  // R* d_m
                                    HistoryValue{.name = "reversal", .derived = true}};         // 1/(d_m - d_p)

  ThorntonPair law{};  // unstretched
  double per_stretch = 1.0;
  // Stretched. Over powers of R*: F = hertz sqrt(R* d) d, d_y, F_y, dF/dd beyond.
  double hertz = 0.0, onset = 0.0, onset_force = 0.0, plastic_slope = 0.0;
  double per_area = 0.0;  // (2 F_m + F_y) per_area: A of ThorntonPair, times (4/3 E* S^-2)^2

  Thornton() = default;
  Thornton(const ThorntonPair& pair, double stretch)
      : law(pair),
        per_stretch(1.0 / stretch),
        hertz(4.0 / 3.0 * pair.e_star * std::pow(per_stretch, 2.5)),
        onset(pair.yield_overlap(1.0) * stretch),
        onset_force(hertz * std::sqrt(onset) * onset),
        plastic_slope(M_PI * pair.yield_pressure * per_stretch * per_stretch)
  {
    const double softened = 4.0 / 3.0 * pair.e_star * per_stretch * per_stretch;
    per_area = softened * softened / (2.0 * M_PI * pair.yield_pressure * per_stretch);
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
    return law.evaluate(r_eff, per_stretch * delta, per_stretch * delta_max).contact_radius;
  }
  double yield_overlap() const { return law.yield_overlap(1.0) / per_stretch; }
  double pair_modulus() const { return law.e_star; }
  double dissipated(double r_eff, double from, double to, double) const
  {
    return law.dissipated(r_eff, per_stretch * to) - law.dissipated(r_eff, per_stretch * from);
  }
  double stored_energy(double r_eff, double delta, double delta_max, double) const
  {
    return law.stored_energy(r_eff, per_stretch * delta, per_stretch * delta_max);
  }
  double stiffness(double r_eff, double delta, double) const
  {
    return per_stretch * per_stretch * planned_stiffness(law, r_eff, per_stretch * delta);
  }
  double stiffness_range() const { return FormulaContact::stiffness_range() / per_stretch; }

 private:
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
