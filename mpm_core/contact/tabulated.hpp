#pragma once

#include <algorithm>
#include <array>
#include <cstring>

#include "contact/contact.hpp"
#include "contact/normal.hpp"

namespace granulaw {

/// SI values of the caller's units, and the factor S by which the caller stretches overlaps.
struct Scale
{
  double length = 1;   ///< m
  double mass = 1;     ///< kg
  double stretch = 1;  ///< S
  double time = 1;     ///< s

  double pressure() const { return mass / length / (time * time); }  ///< Pa
  double speed() const { return length / time; }                     ///< m/s
};

/// Stiffness of the steeper branch at x = delta/(lambda R*) of a contact that has just reached it, over
/// Hertz's force at x = 1 and the length lambda R*.
inline double reversal_stiffness(const Curve& curve, double x, double impact_overlap = 0)
{
  const double loading = curve.loading(x, impact_overlap).stiffness;
  if (x <= curve.onset()) return loading;
  return std::max(loading, curve.reversal(x, impact_overlap).stiffness(x));
}

/// The same before a run: of a contact pressed to x, or of an impact that reverses there, whichever is
/// stiffer.
inline double planned_stiffness(const Curve& curve, double x)
{
  const double pressed = reversal_stiffness(curve, x);
  const AxisTable* axis = curve.axis();
  if (!axis) return pressed;
  const double impact_overlap = std::clamp(x, curve.reach(axis->speed_begin), curve.reach(axis->speed_end));
  return std::max(pressed, reversal_stiffness(curve, x, impact_overlap));
}

/// One pair of bodies under a tabulated law, with everything that does not change worked out: in the caller's
/// units, stretched.
///
/// A stretched contact moves as the real one, S times as far in S times the time, so its forces are 1/S of
/// the real ones. The waves' C K^2 v must be, too: v is the real one and K is 1/S^2 of it, which leaves C
/// S^3. X stays the unstretched law's.
struct Tabulated
{
  const Curve* curve = nullptr;
  double per_lambda = 0;   // 1/(lambda S), lambda of PairMapping
  double lambda = 0;       // lambda S
  double force_scale = 0;  // Hertz force at x = 1 over R*^2 S
  double radiation = 0;    // C S^3 of the dashpot that stands for waves (law/radiation.hpp), s^3/kg; 0: none
  PairMapping mapping{};   // SI, unstretched
  ImpactMeasure measure;   // SI
  double per_stretch = 1;  // 1/S
  Scale scale;

  static constexpr std::array history_values{HistoryValue{.name = "reversal_overlap", .derived = true},
                                    HistoryValue{.name = "reversal", .values = 4, .derived = true}};
  static_assert(sizeof(Reversal) == values_of(history_values) * sizeof(double));

  Tabulated() = default;
  Tabulated(const PairContact& pair, const ImpactMeasure& impacts, const Scale& caller)
      : curve(pair.curve),
        per_lambda(1.0 / (pair.mapping.length(1.0) * caller.stretch)),
        lambda(pair.mapping.length(1.0) * caller.stretch),
        force_scale(pair.mapping.force(1.0) / (caller.pressure() * caller.stretch)),
        radiation(pair.radiation * caller.mass * caller.stretch * caller.stretch * caller.stretch /
                  (caller.time * caller.time * caller.time)),
        mapping(pair.mapping),
        measure(impacts),
        per_stretch(1.0 / caller.stretch),
        scale(caller)
  {
  }

  double force(double r_eff, double delta, double delta_max, double impact_overlap, double* history) const
  {
    const double per_length = per_lambda / r_eff;
    const double x = delta * per_length, x_max = delta_max * per_length;
    const double unit = force_scale * r_eff * r_eff;
    if (!curve->unloads(x, x_max)) return unit * curve->force(x, impact_overlap);
    return unit * reversal(x_max, impact_overlap, history).force(x);
  }
  Response response(double r_eff, double delta, double delta_max, double impact_overlap, double* history) const
  {
    const double per_length = per_lambda / r_eff;
    const double x = delta * per_length, x_max = delta_max * per_length;
    const double unit = force_scale * r_eff * r_eff;
    if (curve->unloads(x, x_max)) {
      const Reversal back = reversal(x_max, impact_overlap, history);
      const double u = back.part(x);
      if (u <= 0.0) return {};
      // what is known first is multiplied first: where waves act, the contact's force waits for the stiffness
      const double root = std::sqrt(u);
      return {unit * back.force_at(u, root), unit * per_length * back.per_span * root * back.slope_over_root(u, root)};
    }
    const Curve::Loading now = curve->loading(x, impact_overlap);
    return {unit * now.force, unit * per_length * now.stiffness};
  }
  double loading(double r_eff, double delta, double impact_overlap) const
  {
    return force_scale * r_eff * r_eff * curve->force(delta * (per_lambda / r_eff), impact_overlap);
  }
  double grow(double r_eff, double from, double to, double impact_overlap, double* history) const
  {
    const double per_length = per_lambda / r_eff;
    return spend(r_eff, from * per_length, to * per_length, impact_overlap, history);
  }
  void postpone(double* history) const { history[1] = -std::abs(history[1]); }
  bool owes(double r_eff, double delta_max, const double* history) const
  {
    return history[0] != delta_max * (per_lambda / r_eff) && !(history[1] > 0.0);
  }
  double booked(double r_eff, const double* history) const { return history[0] * (r_eff / per_lambda); }
  double settle(double r_eff, double delta_max, double impact_overlap, double* history) const
  {
    const double x_max = delta_max * (per_lambda / r_eff);
    history[1] = std::abs(history[1]);
    const double lost = spend(r_eff, history[0], x_max, impact_overlap, history);
    history[0] = x_max;  // also of a contact that never yielded
    return lost;
  }
  double contact_radius(double r_eff, double delta, double delta_max, double impact_overlap) const
  {
    return answer(*curve, mapping, r_eff, per_stretch * delta, per_stretch * delta_max, impact_overlap)
        .contact_radius;
  }
  double dissipated(double r_eff, double from, double to, double impact_overlap) const
  {
    const double length = r_eff / per_lambda;
    return force_scale * r_eff * r_eff * length *
           (curve->lost(to / length, impact_overlap) - curve->lost(from / length, impact_overlap));
  }
  double stored_energy(double r_eff, double delta, double delta_max, double impact_overlap) const
  {
    const double length = r_eff / per_lambda;
    const double unit = force_scale * r_eff * r_eff * length;
    const double x = delta / length, x_max = std::max(delta, delta_max) / length;
    if (!curve->unloads(x, x_max))
      return unit * (curve->work(x, impact_overlap) - curve->lost(x, impact_overlap));
    return unit * curve->reversal(x_max, impact_overlap).work(x);
  }
  double stiffness(double r_eff, double delta, double impact_overlap) const
  {
    const double length = r_eff / per_lambda;
    return force_scale * r_eff * r_eff / length * reversal_stiffness(*curve, delta / length, impact_overlap);
  }
  double planned_stiffness(double r_eff, double delta) const
  {
    const double length = r_eff / per_lambda;
    return force_scale * r_eff * r_eff / length * granulaw::planned_stiffness(*curve, delta / length);
  }

  /// Un- and reloading below a depth, of the real contact, in the caller's units.
  struct Dent
  {
    Reversal back;
    double per_length, unit;      // 1/(lambda R*), and the force at x = 1
    double depth, force, radius;  ///< m, F_m in N, a_m in m
    double steepness;             ///< a_m over the body's radius
    double span, per_span;        ///< m, depth less residual overlap

    static constexpr double growth = 0.6;  ///< d ln(span)/d ln(depth), nearly

    double residual() const { return depth - span; }
    /// u at an overlap; not positive: nothing touches. Force in N, its slope in N/m and the work that it gives back in J
    /// at u.
    double part(double delta) const { return back.part(delta * per_length); }
    double force_of(double u) const { return unit * back.force_at(u, std::sqrt(u)); }
    double slope_of(double u) const { return unit * per_span * back.slope_at(u, std::sqrt(u)); }
    double work_of(double u) const { return unit / per_length * back.work_at(u, std::sqrt(u)); }
    double work() const { return unit / per_length * back.work(); }
    double force_at(double delta) const { return unit * back.force(delta * per_length); }
  };
  Dent dent(double r_eff, double depth, double impact_overlap) const
  {
    return dent(r_eff, depth, curve->reversal(depth * (per_lambda * scale.stretch / r_eff), impact_overlap));
  }
  /// The same of a contact whose largest overlap it is; `history`: as in force().
  Dent dent(double r_eff, double depth, double impact_overlap, double* history) const
  {
    // the same product as force() has
    return dent(r_eff, depth, reversal(depth * scale.stretch * (per_lambda / r_eff), impact_overlap, history));
  }
  Dent dent(double r_eff, double depth, const Reversal& back) const
  {
    const double per_length = per_lambda / r_eff * scale.stretch, unit = force_scale * scale.stretch * r_eff * r_eff;
    const double steepness = curve->radius(depth * per_length), per_span = back.per_span * per_length;
    return {back, per_length, unit, depth, unit * back.top(), mapping.radius(r_eff) * steepness, steepness, 1.0 / per_span, per_span};
  }
  double stretch() const { return scale.stretch; }
  FlowStress flow_stress() const
  {
    const double unit = scale.pressure();
    return {measure.yield_stress / unit, measure.hardening_modulus / unit, measure.flow, unit};
  }

  double yield_overlap() const { return curve->onset() / per_lambda; }
  double pair_modulus() const { return mapping.e_star_pair() / scale.pressure(); }
  double largest_overlap() const { return curve->end() / per_lambda; }
  double stiffness_range() const { return largest_overlap(); }
  bool needs_mass() const { return curve->axis() != nullptr; }

  /// X of a contact that begins at this approach speed; 0: quasi-static.
  double impact_overlap(double r_eff, double m_eff, double speed) const
  {
    if (!curve->axis()) return 0.0;
    return curve->reach(per_speed(r_eff, m_eff) * (speed * scale.speed()));
  }
  /// Largest speed of the law's velocity axis; infinity without one.
  double max_speed(double r_eff, double m_eff) const
  {
    if (!curve->axis()) return std::numeric_limits<double>::infinity();
    return curve->axis()->speed_end / per_speed(r_eff, m_eff) / scale.speed();
  }
  /// Slowest impact that a rate law has; 0: any.
  double min_speed(double r_eff, double m_eff) const
  {
    if (!curve->axis()) return 0.0;
    return curve->axis()->speed_begin / per_speed(r_eff, m_eff) / scale.speed();
  }
  double damage_number_per_speed2() const { return measure.damage_number(mapping, scale.speed()); }

 private:
  /// grow() between two x.
  double spend(double r_eff, double before, double after, double impact_overlap, double* history) const
  {
    if (!curve->unloads(0.0, after)) return 0.0;
    const double spent = curve->unloads(0.0, before) && history[0] == before
                             ? curve->work(before, impact_overlap) - stored_reversal(history).work()
                             : curve->lost(before, impact_overlap);
    const Curve::Top top = curve->top(after, impact_overlap);
    store(Curve::reversal(after, top), history);
    return force_scale * r_eff * r_eff * (r_eff * lambda) * (top.work * (1.0 - top.kept) - spent);
  }
  /// s/m, of speeds in SI.
  double per_speed(double r_eff, double m_eff) const
  {
    return measure.per_speed(*curve->axis(), mapping, r_eff * scale.length, m_eff * scale.mass);
  }
  /// The reversal at x_max, out of `history` where that holds it, and stored there else.
  Reversal reversal(double x_max, double impact_overlap, double* history) const
  {
    if (history[0] != x_max) [[unlikely]]
      store(curve->reversal(x_max, impact_overlap), history);
    return stored_reversal(history);
  }
  static void store(const Reversal& reversal, double* history) { std::memcpy(history, &reversal, sizeof reversal); }
  static Reversal stored_reversal(const double* history)
  {
    return {history[0], history[1], {history[2], history[3], history[4]}};  // a copy of the whole would wait in memory for its parts
  }
};

static_assert(NormalLaw<Tabulated> && LatchesImpact<Tabulated> && BooksLater<Tabulated> && Radiates<Tabulated>);

}  // namespace granulaw
