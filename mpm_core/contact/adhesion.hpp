#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "contact/element.hpp"
#include "contact/tabulated.hpp"

// Adhesion of short range on a tabulated law: a work of adhesion shifts the unloading of a dent as Johnson, Kendall and Roberts
// (1971) shift Hertz's law, and Mesarovic and Johnson (J. Mech. Phys. Solids 48, 2000) a dent's (docs/theory/adhesion.md).
// Units of Curve: overlaps over lambda R*, forces over Hertz's at x = 1, contact radii over sqrt(lambda) R*; the work of adhesion
// is W = w/(E*_s lambda R*), w in J/m2 of the pair of surfaces.
namespace granulaw {

/// Cubic by powers.
struct PowerCubic
{
  std::array<double, 4> c{};

  double at(double v) const { return (c[0] + v * c[1]) + v * v * (c[2] + v * c[3]); }
  double slope(double v) const { return c[1] + v * (2.0 * c[2] + v * (3.0 * c[3])); }
  /// Through these values at v = 0, 1/3, 2/3, 1.
  static PowerCubic through(const std::array<double, 4>& y);
};

/// A dent that was pressed slowly to x_max, while it un- and reloads, and its attraction. v = sqrt(u), q = sqrt(v), u = (x - x_r)/span
/// as the law has it. Without adhesion the stiffness is v h(v), and the force is its integral. With adhesion the state moves along
/// its tangent by d(q) = q s(v) = sqrt(2 w dA/dS), A the area of contact and S the stiffness:
///     overlap  x_r + span q^4 - d          force  F_free - S d
/// so that an unloading gives back w A less, exactly. Between x_max - shift and x_max the edge stays where it is: a straight line.
/// A range of attraction raises w by range_rise() (1 - u).
struct AdhesiveDent
{
  double x_max = 0;  ///< 0: none yet
  double x_r = 0, span = 1, per_span = 1, shift = 0;
  PowerCubic h, s;
  double q_snap = 1, x_snap = 0;   ///< the surfaces part there, at a given overlap

  /// What is kept of it from step to step; the rest follows.
  using Kept = std::array<double, 12>;
  Kept kept() const { return {x_max, per_span, q_snap, x_snap, h.c[0], h.c[1], h.c[2], h.c[3], s.c[0], s.c[1], s.c[2], s.c[3]}; }
  static AdhesiveDent of(const double* kept)
  {
    AdhesiveDent dent{.x_max = kept[0], .per_span = kept[1], .h = {{kept[4], kept[5], kept[6], kept[7]}},
                      .s = {{kept[8], kept[9], kept[10], kept[11]}}, .q_snap = kept[2], .x_snap = kept[3]};
    dent.complete();
    return dent;
  }

  /// Of the reversal of a slow press at `depth`; below the onset of yield and of elastic bodies the law's own unloading. `zone`: length
  /// over which the edge parts, in the unit of contact radii.
  static AdhesiveDent of(const Curve& curve, double depth, double W, double zone);
  /// Rise of a pull-off force by the range of attraction, relative. `zone`: length over which the edge parts over the contact radius.
  /// Of elastic spheres under linear traction, exact to 0.002 (docs/theory/adhesion.md).
  static double range_rise(double zone) { return 0.137 * zone / (1.0 + 0.65 * zone); }

  /// Force without adhesion.
  double free_force(double x) const
  {
    const double u = (x - x_r) * per_span;
    return u <= 0.0 ? 0.0 : free_at(std::sqrt(u));
  }
  /// Force of attached surfaces, x_snap <= x <= x_max. Newton's third step leaves 1e-8 of the pull-off force, 5e-4 of a
  /// deep dent at W = 1e-9. Nothing is taken from the step before, so that no closed path gains work.
  double force(double x) const
  {
    if (x >= x_max - shift) return free_at(1.0) - stiffness() * (x_max - x);
    double q = first_q(x);
    if (beyond_snap(x))
      for (int step = 0; step < 3; ++step) q -= (overlap_at(q) - x) / slope_at(q);
    return force_at(q);
  }
  /// Of the dent at full load.
  double stiffness() const { return h.c[0] + h.c[1] + h.c[2] + h.c[3]; }
  /// Integral of force() - free_force() from the snap to x: the energy of the attraction, <= 0 where w A is larger than the snap.
  double energy(double x) const;

 private:
  friend struct DentMaker;
  void complete()
  {
    span = 1.0 / per_span, x_r = x_max - span;
    shift = (s.c[0] + s.c[1]) + (s.c[2] + s.c[3]);
  }
  double free_at(double v) const
  {
    return 2.0 * span * v * v * v * ((h.c[0] * (1.0 / 3.0) + v * (h.c[1] * 0.25)) + v * v * (h.c[2] * 0.2 + v * (h.c[3] * (1.0 / 6.0))));
  }
  double overlap_at(double q) const
  {
    const double v = q * q;
    return x_r + span * (v * v) - q * s.at(v);
  }
  double slope_at(double q) const
  {
    const double v = q * q;
    return 4.0 * span * q * v - (s.at(v) + 2.0 * v * s.slope(v));
  }
  double force_at(double q) const
  {
    const double v = q * q;
    return free_at(v) - v * h.at(v) * (q * s.at(v));
  }
  double way() const { return (x_max - shift) - x_snap; }
  /// False: a start is right to rounding, and the slope is none.
  bool beyond_snap(double x) const { return x - x_snap > 1e-14 * way(); }
  /// A start: right at both ends, and in the way in which q leaves the snap.
  double first_q(double x) const
  {
    const double y = std::sqrt(std::max(x - x_snap, 0.0) / way()), least = q_snap * q_snap;
    const double start = std::sqrt(way() * per_span * (2.0 / 3.0));  // q^2 - q_snap^2 over y at the snap
    return std::sqrt(least + y * (start + y * (1.0 - least - start)));
  }
};

/// Range of attraction that is taken where none is stated, m: of smooth, clean surfaces.
inline constexpr double usual_adhesion_range = 0.4e-9;

/// Numbers that say whether the shift describes the adhesion of a dent (docs/theory/adhesion.md). The attraction falls linearly from
/// sigma_0 = 2 w/h_0 to nothing over its range h_0. p_m: mean pressure in the dent at full load, a its radius.
struct AdhesionNumbers
{
  double W = 0;      ///< w/(E*_s lambda R*)
  double range = 0;  ///< h_0, m
  double tabor = 0;  ///< (w^2 R*/(E*^2 h_0^3))^(1/3)
  double S = 0;      ///< sigma_0/p_m; 0: it does not yield
  double chi = 0;    ///< w E*/(p_m^2 a); 0: it does not yield
  double pressure = 0;  ///< p_m, Pa

  /// 95 % of the pull-off force, relative. Of a dent 0.12 where chi is over 0.01, more as sqrt(1/chi) below, and at most the quarter
  /// by which the solver's own forces scatter there; of elastic contacts 0.03 (docs/evidence/adhesion.md).
  double pull_off_bound() const { return chi > 0.0 ? std::clamp(0.12 * std::sqrt(0.01 / chi), 0.12, 0.25) : 0.03; }

  static constexpr double largest_S = 0.8, largest_chi = 0.2, least_tabor = 1.0;
};

/// Adhesion as the piece beside a tabulated law: F = F_law + (F' - F_free) of the slow dent. Loading beyond the onset of yield is the
/// law's own. Surfaces attach when they touch, those of a dent at its residual overlap, and part where the dent's edge is unstable;
/// until then the contact holds, also across a gap.
struct DentAdhesion
{
  static constexpr std::array history_values{HistoryValue{.name = "attached"}, HistoryValue{.name = "adhesive_energy"},
                                             HistoryValue{.name = "adhesive_dent", .values = AdhesiveDent::Kept{}.size(), .derived = true}};
  static constexpr const char *property = "workOfAdhesion", *range_property = "adhesionRange";
  static constexpr double usual_range = usual_adhesion_range;
  /// Friction grows with the law's force alone, with what presses the surfaces, as beside LIGGGHTS's sjkr.
  static constexpr bool outside_friction = true;
  static constexpr bool begins_touching = true;

  double length_of_w = 0;  ///< w/(E*_s lambda), W R*, in the caller's unit of length
  double length_of_range = 0;  ///< h_0/lambda, in the caller's unit of length; lambda without the stretch
  double lambda = 0;       ///< with the stretch
  double first = 0;        ///< depth of the dent of a contact that never yielded

  DentAdhesion() = default;
  /// `work`: w of the pair of surfaces, not stretched, in the caller's unit of energy over that of area; 0: no adhesion. `range`: h_0,
  /// not stretched, in the caller's unit of length.
  DentAdhesion(const Tabulated& law, double work, double range)
      : length_of_w(work * law.scale.mass / (law.scale.time * law.scale.time) / (law.mapping.e_star * law.mapping.length(law.scale.length))),
        length_of_range(range / law.mapping.length(1.0)),
        lambda(law.lambda),
        first(std::min(law.curve->onset(), law.curve->end()))
  {
  }

  double relative_work(double r_eff) const { return length_of_w / r_eff; }  ///< W
  AdhesiveDent dent_of(const Tabulated& law, double r_eff, double depth) const
  {
    return AdhesiveDent::of(*law.curve, depth, relative_work(r_eff), zone_per_range * length_of_range * length_of_range / (length_of_w * r_eff));
  }
  /// A quarter beyond that of Johnson, Kendall and Roberts: dents hold up to 1.15 of theirs.
  double reach(double r_eff) const { return 1.25 * 0.75 * std::cbrt(M_PI * M_PI * length_of_w * length_of_w * r_eff) * lambda; }
  static bool holds(const double* history) { return history[0] > 0.0; }
  /// For a law or a work that may have changed.
  static void forget_derived(double* history) { history[2] = 0.0; }

  double advance(const Tabulated& law, const ContactMotion& m, double, const double* normal_history, double* history, Ledger& ledger) const
  {
    if (!(length_of_w > 0.0)) return 0.0;
    const double per_length = law.per_lambda / m.r_eff, x = m.overlap * per_length;
    const double depth = std::max(normal_history[0] * per_length, first);
    const bool attached = holds(history);
    if (x >= depth) {  // its edge advances against no attraction
      if (m.advances && (!attached || x > first)) deepen(law, m.r_eff, history, ledger);
      return 0.0;
    }
    if (!attached && !(x > 0.0)) return 0.0;
    if (history[2] != depth || history[0] == owing) [[unlikely]]
      turn(law, m, depth, history, ledger);
    const AdhesiveDent dent = AdhesiveDent::of(history + 2);
    if (attached) {
      if (x < dent.x_snap) [[unlikely]] {
        if (m.advances) history[0] = history[1] = 0.0;
        return 0.0;
      }
    } else {
      if (!(x > (depth > first ? dent.x_r : 0.0))) return 0.0;
      if (m.advances) attach(law, m.r_eff, history, ledger);
    }
    return law.force_scale * m.r_eff * m.r_eff * (dent.force(x) - dent.free_force(x));
  }
  /// J, <= 0, of the attraction; what parting costs beyond the law's own energy.
  double stored_energy(const Tabulated& law, double r_eff, double overlap, const double* normal_history, const double* history) const;
  /// N: of a smooth elastic contact, 3/2 pi w R*.
  double smooth_pull_off(const Tabulated& law, double r_eff) const { return 1.125 * M_PI * law.force_scale * r_eff * length_of_w; }
  /// N, > 0: the largest pull of a contact that was slowly pressed to `depth` and is slowly drawn apart.
  double pull_off(const Tabulated& law, double r_eff, double depth) const;

  AdhesionNumbers numbers(const Tabulated& law, double r_eff, double depth) const;  ///< of a dent of this depth
  /// A sentence about why these surfaces are refused; empty: they are not. Without a `depth` of all dents that the law has: refused
  /// where the law holds for none.
  std::string fault(const Tabulated& law, double r_eff, double depth) const;
  std::string fault(const Tabulated& law, double r_eff) const;

 private:
  static constexpr double zone_per_range = 0.25 * 1.46;  ///< 1.46 w E*/sigma_0^2 over h_0^2 E*/w
  static constexpr double booked = 1.0, owing = 2.0;  ///< of `attached`: it went deeper, and the loss of its attraction is not booked

  void deepen(const Tabulated& law, double r_eff, double* history, Ledger& ledger) const
  {
    if (!holds(history)) attach(law, r_eff, history, ledger);
    history[0] = owing;
  }
  void turn(const Tabulated& law, const ContactMotion& m, double depth, double* history, Ledger& ledger) const;
  void attach(const Tabulated& law, double r_eff, double* history, Ledger& ledger) const;
};
static_assert(StandsBeside<DentAdhesion, Tabulated>);

}  // namespace granulaw
