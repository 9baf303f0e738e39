#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>

#include "contact/history.hpp"

// The normal law of a contact.
namespace granulaw {

/// Force of a contact along its normal, and dF/d(overlap) of the branch that it follows.
struct Response
{
  double force = 0, stiffness = 0;  ///< N, N/m
};

// It would break each requirement into three lines.
// clang-format off

/// The law of one pair of bodies: a small value that the contact loop calls in each step.
///
/// All quantities are in the caller's units (Scale), and stretched where the caller stretches: the force at overlap
/// d is F(d/S)/S of the real contact's F. Arguments:
///
///   r_eff           m, > 0: R* = R_i R_j/(R_i + R_j); at a wall the sphere's R
///   m_eff           kg, > 0: m* = m_i m_j/(m_i + m_j); at a wall the sphere's m
///   delta           m, > 0: overlap now, R_i + R_j less the distance of the centres
///   delta_max       m, >= 0: largest overlap since first touch, before this step; 0 in the first step
///   speed           m/s, of approach along the normal; positive: the surfaces come nearer
///   impact_overlap  X: what impact_overlap() gave at first touch; 0 where the law latches nothing
///   history            values of `history_values`
template <class Law>
concept NormalLaw =
    std::default_initializable<Law> && std::copyable<Law> &&
    requires(const Law law, double r_eff, double m_eff, double delta, double delta_max, double speed,
             double impact_overlap, double* history) {
  /// The law's own values of a contact, beside its largest overlap and X. They are 0 in a new contact, and the first
  /// may be set to 0 at any time: the law then finds what it wrote there again from the other arguments.
  { std::span<const HistoryValue>(Law::history_values) };
  /// N, >= 0, pushes the bodies apart.
  { law.force(r_eff, delta, delta_max, impact_overlap, history) } -> std::same_as<double>;
  /// force(), to the bit, and its slope.
  { law.response(r_eff, delta, delta_max, impact_overlap, history) } -> std::same_as<Response>;
  /// m, >= 0: radius of the circle of contact, of the real, unstretched contact.
  { law.contact_radius(r_eff, delta, delta_max, impact_overlap) } -> std::same_as<double>;
  /// Overlap/R* of first yield; infinity: never. Contacts that came no deeper are damped (`elasticDamping`).
  { law.yield_overlap() } -> std::same_as<double>;
  /// Overlap/R* up to which the law holds; the largest double: everywhere.
  { law.largest_overlap() } -> std::same_as<double>;
  /// Pa, E* of the pair: 1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j.
  { law.pair_modulus() } -> std::same_as<double>;

  /// J, >= 0, spent on plastic strain while the largest overlap grew from `delta` to `delta_max`.
  { law.dissipated(r_eff, delta, delta_max, impact_overlap) } -> std::same_as<double>;
  /// J, >= 0, what the contact gives back on complete unloading.
  { law.stored_energy(r_eff, delta, delta_max, impact_overlap) } -> std::same_as<double>;
  /// N/m, > 0: the stiffest that a contact is which has just reached `delta`, on the way in or back out.
  { law.stiffness(r_eff, delta, impact_overlap) } -> std::same_as<double>;
  /// Overlap/R*, finite: up to there the start-up table says what the time step is short enough for.
  { law.stiffness_range() } -> std::same_as<double>;

  /// m/s, largest and least approach speed that the law has; infinity and 0 without limits.
  { law.max_speed(r_eff, m_eff) } -> std::same_as<double>;
  { law.min_speed(r_eff, m_eff) } -> std::same_as<double>;
  /// s^2/m^2: rho V^2/Y of the yielding body over the square of the approach speed; 0: not stated.
  { law.damage_number_per_speed2() } -> std::same_as<double>;
  /// True if the law depends on the mass of the bodies.
  { law.needs_mass() } -> std::same_as<bool>;
};

/// A law whose contacts keep a number X that follows from the approach speed at first touch.
template <class Law>
concept LatchesImpact = requires(const Law law, double r_eff, double m_eff, double speed) {
  /// X, >= 0, in a unit of the law's own.
  { law.impact_overlap(r_eff, m_eff, speed) } -> std::same_as<double>;
};

/// A law with a shorter way for a contact that goes deeper than it ever was (delta >= delta_max).
template <class Law>
concept HasLoading = requires(const Law law, double r_eff, double delta, double from, double impact_overlap, double* history) {
  /// force(), to the bit.
  { law.loading(r_eff, delta, impact_overlap) } -> std::same_as<double>;
  /// dissipated() but for rounding. `history` is as after force() at `from`, and may be left as it helps force() below `delta`.
  { law.grow(r_eff, from, delta, impact_overlap, history) } -> std::same_as<double>;
};

/// A law whose contacts may be booked when they turn, not in each step that takes them deeper. Their history is as `grow` left
/// it, at the overlap up to which they are booked.
template <class Law>
concept BooksLater = HasLoading<Law> && requires(const Law law, double r_eff, double delta_max, double impact_overlap, double* history) {
  /// Notes that the contact went deeper unbooked.
  { law.postpone(history) };
  /// True if a contact of this largest overlap is not booked up to there.
  { law.owes(r_eff, delta_max, history) } -> std::same_as<bool>;
  /// m, overlap up to which it is booked.
  { law.booked(r_eff, history) } -> std::same_as<double>;
  /// grow() from there.
  { law.settle(r_eff, delta_max, impact_overlap, history) } -> std::same_as<double>;
};

/// A law that lets waves take a part: they act as a dashpot F_waves = C K^2 v, v the approach speed, K the law's own
/// stiffness (law/radiation.hpp).
template <class Law>
concept Radiates = requires(const Law law) {
  /// C, s^3/kg, stretched; 0: none. Where no pair of types has one, K is not asked for.
  { law.radiation } -> std::convertible_to<double>;
};

// clang-format on

/// Force and dissipation of a contact that goes deeper than it ever was, by the law's shorter way if it has
/// one.
template <class Law>
double loading_of(const Law& law, double r_eff, double delta, double delta_max, double impact_overlap,
                  double* history)
{
  if constexpr (HasLoading<Law>) return law.loading(r_eff, delta, impact_overlap);
  return law.force(r_eff, delta, delta_max, impact_overlap, history);
}
/// `later`: of a contact that is booked later from here on.
template <class Law>
double dissipation_of(const Law& law, double r_eff, double from, double to, double impact_overlap,
                      double* history, bool later)
{
  if constexpr (BooksLater<Law>)
    if (later) return law.settle(r_eff, to, impact_overlap, history);
  if constexpr (HasLoading<Law>) return law.grow(r_eff, from, to, impact_overlap, history);
  return law.dissipated(r_eff, from, to, impact_overlap);
}

/// Positions of a normal law's values among those of a contact: first the largest overlap, then X if the law
/// latches it, then the law's other values.
template <NormalLaw Law>
struct NormalState
{
  static constexpr auto history_values = [] {
    if constexpr (LatchesImpact<Law>)
      return std::array{HistoryValue{"delta_max"}, HistoryValue{"impact_overlap"}} + Law::history_values;
    else
      return std::array{HistoryValue{"delta_max"}} + Law::history_values;
  }();
  static constexpr std::size_t own = LatchesImpact<Law> ? 2 : 1, values = values_of(history_values);

  static double largest(const double* history) { return history[0]; }
  static double impact_overlap(const double* history) { return LatchesImpact<Law> ? history[1] : 0.0; }
  /// Resets the values that follow from the others and from the law, for a law that may have changed.
  static void forget_derived(double* history)
  {
    for (const HistoryValue& one : history_values) {
      if (one.derived) std::fill_n(history, one.values, 0.0);
      history += one.values;
    }
  }
};

/// A contact's normal motion in a step, in the caller's units.
struct NormalMotion
{
  double r_eff;     ///< m
  double overlap;   ///< m, > 0
  double approach;  ///< m/s, positive: the surfaces come nearer
  bool advances;    ///< false: the force is asked for again, and nothing is stored or booked
};

/// Answer of a normal law to a step.
struct NormalForces
{
  double law = 0, waves = 0;  ///< N; waves only brake, and never make a contact pull
  double stiffness = 0;       ///< N/m, of the law, where it was asked for
};

/// For a law that is a closed formula, to derive from: it has neither a limit of speed nor of overlap, and
/// its contacts keep their largest overlap alone.
struct FormulaContact
{
  static constexpr std::array<HistoryValue, 0> history_values{};
  static double max_speed(double, double) { return std::numeric_limits<double>::infinity(); }
  static double min_speed(double, double) { return 0.0; }
  static double damage_number_per_speed2() { return 0.0; }
  static bool needs_mass() { return false; }
  /// Everywhere; times R* it stays finite or becomes infinity.
  static double largest_overlap() { return std::numeric_limits<double>::max(); }
  /// Grains hardly collide deeper.
  static double stiffness_range() { return 0.1; }
};

}  // namespace granulaw
