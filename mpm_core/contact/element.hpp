#pragma once

#include <algorithm>
#include <cmath>

#include "contact/tangential.hpp"

namespace granulaw {

/// J that waves take in a step: their force times the approach in the middle of it. The approach given is
/// half a step behind; `force`, all that acts along the normal, takes it there, exactly where nothing else
/// touches the two bodies.
inline double work_of_waves(double waves, double approach, double force, double m_eff, double dt)
{
  return waves * dt * (approach - 0.5 * dt / m_eff * force);  // the division need not wait for the force
}

/// Force of a contact on body i; j gets the opposite.
struct ContactForce
{
  double normal = 0;     ///< N, along the normal: all of it
  double law = 0;        ///< N, the normal law's part, >= 0
  double stiffness = 0;  ///< N/m, of the normal law on its branch
  Vector shear{};        ///< N
  Vector couple{};       ///< N m, beside the torque of `shear`
};

// clang-format off

/// A piece that stands beside the two laws: adhesion, a bond, a charge. `history`: its own values. Values that each particle
/// has, in ContactMotion: `static constexpr const char* particle_values`, their name, and `particle_count`. With `outside_friction`
/// true friction grows with the normal law's force and the dashpots' alone. With `begins_touching` true it acts across a gap only
/// while it holds the two bodies, so that neighbours that never touched are not looked at.
template <class Piece, class Normal>
concept StandsBeside = std::copyable<Piece> &&
    requires(const Piece piece, const Normal normal, const ContactMotion& motion, double r_eff, double push, double* normal_history,
             double* history, Ledger& ledger) {
  { std::span<const HistoryValue>(Piece::history_values) };
  /// m, >= 0: gap between the surfaces up to which it acts.
  { piece.reach(r_eff) } -> std::same_as<double>;
  /// True if it holds the two bodies, so that the contact keeps its state although the surfaces have parted.
  { piece.holds(history) } -> std::same_as<bool>;
  /// N, negative: it pulls. Added to `push`, the force of the normal law and the dashpots: only the sum may be negative. Across a
  /// gap the overlap is not positive and `push` is 0.
  { piece.advance(normal, motion, push, normal_history, history, ledger) } -> std::same_as<double>;
};

// clang-format on

/// Nothing beside the two laws.
struct NothingBeside
{
  static constexpr std::array<HistoryValue, 0> history_values{};
};

/// The particle code's part in a step of the element. This one has none.
struct NoCaller
{
  /// True: the stiffness is asked for, also where no waves act.
  static constexpr bool with_stiffness() { return true; }
  /// X of a contact that begins.
  template <LatchesImpact Normal>
  static double impact_overlap(const Normal& law, const ContactMotion& m)
  {
    return law.impact_overlap(m.r_eff, m.m_eff, m.approach);
  }
  /// True: a contact that goes deeper is booked by settle(), in the step in which it turns, not in each step (BooksLater).
  static constexpr bool books_later() { return false; }
  static void settle() {}
  static void deepens(double) {}  ///< in each step that is not booked now, under X
  /// In the first step of a contact, and in each that is not booked later: the largest overlap grows from the first, under X.
  /// False: no motion paid for it, and nothing is booked.
  static constexpr bool grows(double, double) { return true; }
  /// N, what acts along the normal, and what friction grows with: the second and third. It may lower the one, and change the
  /// other by forces of its own.
  static void press(const NormalForces&, double&, double&) {}
};

/// A contact of two bodies, with one state: a normal law, a dashpot for contacts that are elastic, a tangential law, and
/// what stands beside them. No allocation, no exception.
template <NormalLaw Normal, TangentialLaw<Normal> Tangential = Frictionless, class Beside = NothingBeside>
  requires(std::same_as<Beside, NothingBeside> || StandsBeside<Beside, Normal>)
struct ContactElement
{
  using State = NormalState<Normal>;
  /// All zero in a contact that begins.
  static constexpr auto history_values = State::history_values + Tangential::history_values + Beside::history_values;
  static constexpr std::size_t values = values_of(history_values), beside_at = values - values_of(Beside::history_values);
  /// True if the tangential law takes the depth along: the largest overlap that the normal law keeps is then not the motion's.
  static constexpr bool deepens = requires { requires Tangential::deepens; };

  Normal normal;
  Tangential tangential{};
  double damping = 0;        ///< of contacts that are elastic: dashpot over sqrt(sqrt(R* d) m*)
  double yield_overlap = 0;  ///< over R*: the normal law's; asked for with damping alone
  [[no_unique_address]] Beside beside{};

  static constexpr bool has_beside = !std::same_as<Beside, NothingBeside>;
  static constexpr bool begins_apart = has_beside && !requires { requires Beside::begins_touching; };
  static constexpr bool loads_friction = has_beside && !requires { requires Beside::outside_friction; };

  /// `history`: `values` numbers of this contact. An overlap of 0 or less ends it, unless the piece beside holds it. Adds to `books`.
  ContactForce advance(const ContactMotion& m, double* history, Ledger& ledger) const
  {
    return m.overlap > 0 ? touch(m, history, ledger, NoCaller{}) : part(m, history, ledger);
  }

  /// The same of surfaces that touch.
  template <class Caller>
  [[gnu::always_inline]] ContactForce touch(const ContactMotion& m, double* history, Ledger& ledger, Caller&& caller) const
  {
    const double before = State::largest(history), root = std::sqrt(m.r_eff * m.overlap);
    const NormalForces now = press(m, history, ledger, caller);
    const double braking = dashpot(m, before, std::sqrt(root * m.m_eff)) * m.approach;
    // below the residual overlap of a dent nothing touches, and nothing is braked; of an undamped contact the law's force
    // itself, to the bit (std::max gives its first argument where that is no number, for the particle code to find)
    double push = now.law <= 0.0 ? 0.0 : std::max((now.law + now.waves) + braking, 0.0), pull = 0.0;
    if constexpr (has_beside) pull = beside.advance(normal, m, push, history, history + beside_at, ledger);
    double pressing = loads_friction ? push + pull : push;
    caller.press(now, push, pressing);
    if (Radiates<Normal> && m.advances && caller.with_stiffness())
      ledger[Mechanism::waves] += work_of_waves(now.waves, m.approach, push, m.m_eff, m.dt);
    const double depth = State::largest(history);
    const auto along = tangential.advance(normal, m, push, pressing, history, history + State::values, ledger);
    if constexpr (deepens)  // a contact that goes deeper is not elastic, though its overlap is less than its depth
      if (State::largest(history) > depth && m.approach > 0.0) push = std::max(push - braking, 0.0);
    ContactForce answer{.normal = has_beside ? push + pull : push, .law = now.law, .stiffness = now.stiffness};
    // component by component: a copy of the whole would wait in memory for its parts
    const auto set = [](Vector& to, const Vector& v) { to[0] = v[0], to[1] = v[1], to[2] = v[2]; };
    if constexpr (std::same_as<decltype(along), const Vector>)
      set(answer.shear, along);
    else
      set(answer.shear, along.force), set(answer.couple, along.couple);
    return answer;
  }

  /// m, of the circle of contact, of the real, unstretched contact.
  double contact_radius(const NormalMotion& m, const double* history) const
  {
    if (!(m.overlap > 0)) return 0.0;
    return normal.contact_radius(m.r_eff, m.overlap, State::largest(history), State::impact_overlap(history));
  }

 private:
  /// Surfaces that do not touch. A contact that nothing holds ends; what acts at a distance acts without a contact, too.
  ContactForce part(const ContactMotion& m, double* history, Ledger& ledger) const
  {
    ContactForce answer;
    if constexpr (has_beside)
      if ((begins_apart || beside.holds(history + beside_at)) && -m.overlap <= beside.reach(m.r_eff)) {
        answer.normal = beside.advance(normal, m, 0.0, history, history + beside_at, ledger);
        if (beside.holds(history + beside_at)) return answer;
      }
    if (m.advances) std::fill_n(history, values, 0.0);
    return answer;
  }

  /// The step of the normal law.
  template <class Caller>
  [[gnu::always_inline]] NormalForces press(const ContactMotion& m, double* history, Ledger& ledger, Caller&& caller) const
  {
    double* const own = history + State::own;
    const double delta_max = State::largest(history);
    double impact_overlap = State::impact_overlap(history);
    const auto with_slope = [&] {
      const auto [force, k] = normal.response(m.r_eff, m.overlap, delta_max, impact_overlap, own);
      NormalForces now{.law = force, .stiffness = k};
      if constexpr (Radiates<Normal>) now.waves = std::max(normal.radiation * m.approach * (k * k), -force);
      return now;
    };
    // one branch for force and books: in a bed that is pressed no processor can foresee which contacts grow
    if (!(m.overlap > delta_max)) {
      if constexpr (BooksLater<Normal>)
        if (caller.books_later() && normal.owes(m.r_eff, delta_max, own)) [[unlikely]]
          caller.settle();
      return caller.with_stiffness() ? with_slope() : NormalForces{normal.force(m.r_eff, m.overlap, delta_max, impact_overlap, own)};
    }
    if constexpr (LatchesImpact<Normal>)
      if (delta_max == 0.0) impact_overlap = caller.impact_overlap(normal, m);
    const NormalForces now =
        caller.with_stiffness() ? with_slope() : NormalForces{loading_of(normal, m.r_eff, m.overlap, delta_max, impact_overlap, own)};
    if (m.advances) {
      if constexpr (LatchesImpact<Normal>) history[1] = impact_overlap;
      history[0] = m.overlap;
      const bool later = caller.books_later();
      if constexpr (BooksLater<Normal>)
        if (later && delta_max > 0.0) {
          normal.postpone(own);
          caller.deepens(impact_overlap);
          return now;
        }
      const double lost = dissipation_of(normal, m.r_eff, delta_max, m.overlap, impact_overlap, own, later);
      if (caller.grows(delta_max, impact_overlap)) ledger[Mechanism::plastic] += lost;
    }
    return now;
  }

  /// kg/s; `impedance`: what both dashpots of a contact are proportional to. Elastic is a contact that never yielded, both ways,
  /// and a yielded one on its way back to its largest overlap, but not when it parts, so that the rebound of a plastic impact is
  /// the law's own. Without a branch: in a bed contacts approach and part at random.
  double dashpot(const ContactMotion& m, double delta_max, double impedance) const
  {
    const bool returns = (m.overlap < delta_max) & (m.approach > 0.0);
    const bool elastic = std::max(m.overlap, delta_max) <= yield_overlap * m.r_eff;
    return damping * static_cast<double>(returns | elastic) * impedance;
  }
};

}  // namespace granulaw
