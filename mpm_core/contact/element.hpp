#pragma once

#include <algorithm>

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
  double normal = 0;          ///< N, along the normal
  double stiffness = 0;       ///< N/m, of the normal law on its branch
  double contact_radius = 0;  ///< m, of the real, unstretched contact
  Vector shear{};             ///< N
  Vector couple{};            ///< N m, beside the torque of `shear`
};

/// A contact of two bodies: a normal law and a tangential law, with one state. No allocation, no exception.
template <NormalLaw Normal, TangentialLaw<Normal> Tangential = Frictionless>
struct ContactElement
{
  using State = NormalState<Normal>;
  /// All zero in a contact that begins.
  static constexpr auto keeps = State::keeps + Tangential::keeps;
  static constexpr std::size_t values = values_of(keeps);

  Normal normal;
  Tangential tangential{};

  /// `kept`: `values` numbers of this contact; an overlap of 0 or less ends it. Adds to `books`.
  ContactForce advance(const ContactMotion& m, double* kept, Ledger& books) const
  {
    if (!(m.overlap > 0)) {
      if (m.advances) std::fill_n(kept, values, 0.0);
      return {};
    }
    const double before = State::largest(kept);
    const NormalForces now = advance_normal(normal, m, true, kept, Books{*this, m, books});
    ContactForce answer{
        .stiffness = now.stiffness,
        .contact_radius = normal.contact_radius(m.r_eff, m.overlap, before, now.impact_overlap)};
    // below the residual overlap of a dent nothing touches, and nothing is braked
    answer.normal = now.law <= 0.0 ? 0.0 : std::max(now.law + now.waves, 0.0);
    if (m.advances && answer.normal > 0)
      books[Mechanism::waves] += work_of_waves(now.waves, m.approach, answer.normal, m.m_eff, m.dt);
    const Grip grip = tangential.advance(normal, m, answer.normal, kept, kept + State::values, books);
    answer.shear = grip.force, answer.couple = grip.couple;
    return answer;
  }

 private:
  struct Books
  {
    const ContactElement& element;
    const ContactMotion& m;
    Ledger& books;

    double impact_overlap() const
    {
      if constexpr (LatchesImpact<Normal>) return element.normal.impact_overlap(m.r_eff, m.m_eff, m.approach);
      return 0.0;
    }
    void deepen(double from, double latched, double* own) const
    {
      books[Mechanism::plastic] += dissipation_of(element.normal, m.r_eff, from, m.overlap, latched, own);
    }
  };
};

}  // namespace granulaw
