#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/ledger.hpp"
#include "contact/normal.hpp"
#include "contact/vector.hpp"

// The tangential law of a contact. It has the normal law and its memory, so that a law whose dent grows under
// shear can deepen the contact.
namespace granulaw {

/// A contact's motion in a step, in the caller's units.
struct ContactMotion : NormalMotion
{
  double m_eff = 0;  ///< kg
  double dt = 0;     ///< s
  Vector normal{};   ///< unit, from j to i
  Vector slide{};    ///< m/s, velocity of i's surface against j's at the contact, along the surface
  Vector rolling{};  ///< rad/s, (omega_i - omega_j) x normal: rolling of i, in the direction that it rolls
  /// The particles' own values, of a piece that has some (StandsBeside); of a wall null.
  const double *of_i = nullptr, *of_j = nullptr;
};

/// Force and couple of a tangential law on body i; j gets the opposite of both.
struct TangentialForce
{
  Vector force{};   ///< N, along the surface
  Vector couple{};  ///< N m, beside the force's own torque

  TangentialForce() = default;
  TangentialForce(const Vector& shear) : force(shear) {}  // NOLINT(google-explicit-constructor): most laws have no couple
};

// clang-format off

/// `normal_history`: the normal law's values (NormalState), `history`: this law's own. `push`: N, >= 0, what acts along the normal
/// without what stands beside the laws; `pressing`: N, with it, whose size friction grows with. A law with `deepens = true` may
/// lower `push` and raise the largest overlap, and books what either takes.
template <class Law, class Normal>
concept TangentialLaw = std::copyable<Law> &&
    requires(const Law law, const Normal normal, const ContactMotion& motion, double& push, double pressing, double* normal_history,
             double* history, Ledger& ledger) {
  { std::span<const HistoryValue>(Law::history_values) };
  { law.advance(normal, motion, push, pressing, normal_history, history, ledger) } -> std::convertible_to<TangentialForce>;
};

// clang-format on

/// No tangential force.
struct Frictionless
{
  static constexpr std::array<HistoryValue, 0> history_values{};
  template <class Normal>
  Vector advance(const Normal&, const ContactMotion&, double, double, double*, double*, Ledger&) const
  {
    return {};
  }
};

/// 1/Pa, of one body: 8 G* of a pair is 8 over the sum of both (Mindlin).
inline double shear_compliance(double youngs_modulus, double poisson_ratio)
{
  return 2.0 * (2.0 - poisson_ratio) * (1.0 + poisson_ratio) / youngs_modulus;
}

/// Numbers of a pair that tangential laws are made of.
struct ShearPair
{
  double stiffness = 0;  ///< Pa, k_t over the contact radius sqrt(R* d): 8 G*
  double friction = 0;   ///< coefficient
  double damping = 0;    ///< dashpot over sqrt(sqrt(R* d) m*); of_law: over sqrt(k_t m*)
  bool of_law = false;   ///< k_t is over the law's own contact radius

  struct OfContact
  {
    double stiffness, dashpot;  ///< N/m, kg/s
  };
  template <class Normal>
  OfContact contact(const Normal& law, const ContactMotion& m, const double* normal_history) const
  {
    using State = NormalState<Normal>;
    if (of_law) [[unlikely]] {
      const double k =
          stiffness * law.contact_radius(m.r_eff, m.overlap, State::largest(normal_history), State::impact_overlap(normal_history));
      return {k, damping * std::sqrt(k * m.m_eff)};
    }
    const double root = std::sqrt(m.r_eff * m.overlap);
    return {stiffness * root, damping * std::sqrt(root * m.m_eff)};
  }

  /// `damping_ratio`: Z, part of critical. Stretched by S, k_t,s(d) = k_t(d/S)/S^2, and Mindlin's radius is
  /// of the stretched overlap: another 1/sqrt(S).
  static ShearPair of(double eight_shear_moduli, double friction, double damping_ratio, double stretch = 1, bool of_law = false)
  {
    const double stiffness = eight_shear_moduli * std::pow(stretch, of_law ? -2.0 : -2.5);
    return {stiffness, friction, of_law ? 2.0 * damping_ratio : 2.0 * damping_ratio * std::sqrt(stiffness), of_law};
  }
};

/// Mindlin's spring with Coulomb's limit, as LIGGGHTS's `tangential history` has it, to the bit:
/// k_t = 8 G* sqrt(R* d), a dashpot while it sticks.
struct Spring
{
  static constexpr std::array history_values{HistoryValue{.name = "shear", .values = 3, .changes_sign = true}};

  ShearPair pair;

  Spring() = default;
  explicit Spring(const ShearPair& numbers) : pair(numbers) {}

  template <class Normal>
  Vector advance(const Normal& law, const ContactMotion& m, double, double pressing, double* normal_history, double* shear,
                 Ledger& ledger) const
  {
    const auto [k, dashpot] = pair.contact(law, m, normal_history);
    return advance(m, pressing, k, dashpot, shear, ledger);
  }
  /// With k_t (N/m) and the dashpot (kg/s) given.
  Vector advance(const ContactMotion& m, double pressing, double k, double dashpot, double* shear, Ledger& ledger) const
  {
    // no loops over components: where their places are variables, arrays stay in memory, and a copy waits for its parts
    Vector u{shear[0], shear[1], shear[2]};
    if (m.advances) {
      u = sum(u, m.slide, m.dt);
      u = sum(u, m.normal, -dot(u, m.normal));
    }
    const double pull = k * norm(u), most = pair.friction * std::abs(pressing);
    Vector force = times(u, -k);
    double taken = 0.0;
    if (pull > most) {
      force = times(force, most / pull);
      if (m.advances) u = {-force[0] / k, -force[1] / k, -force[2] / k};
      taken = most * (pull - most) / k;
    } else {
      force = sum(force, m.slide, -dashpot);
      taken = dashpot * m.dt * dot(m.slide, m.slide);
    }
    if (m.advances) {
      shear[0] = u[0], shear[1] = u[1], shear[2] = u[2];
      ledger[Mechanism::friction] += taken;
    }
    return force;
  }
};

/// A dashpot with Coulomb's limit, as LIGGGHTS's `tangential no_history` has it, to the bit.
struct ViscousFriction
{
  static constexpr std::array<HistoryValue, 0> history_values{};

  ShearPair pair;

  ViscousFriction() = default;
  explicit ViscousFriction(const ShearPair& numbers) : pair(numbers) {}

  template <class Normal>
  Vector advance(const Normal& law, const ContactMotion& m, double, double pressing, double* normal_history, double*, Ledger& ledger) const
  {
    const double dashpot = pair.contact(law, m, normal_history).dashpot, speed = norm(m.slide), most = pair.friction * std::abs(pressing);
    const double gamma = most < dashpot * speed ? most / speed : dashpot;
    if (m.advances) ledger[Mechanism::friction] += gamma * m.dt * speed * speed;
    return {-gamma * m.slide[0], -gamma * m.slide[1], -gamma * m.slide[2]};
  }
};

}  // namespace granulaw
