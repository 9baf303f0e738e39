#pragma once

#include <limits>

#include "contact/shear_return.hpp"
#include "contact/tangential.hpp"

namespace granulaw {

/// Moduli of a body; as made: rigid.
struct ElasticBody
{
  double youngs_modulus = std::numeric_limits<double>::infinity(), poisson_ratio = 0;  // Pa
  double compliance() const { return (1.0 - poisson_ratio * poisson_ratio) / youngs_modulus; }  ///< 1/E*
};

/// Two bodies under shear.
struct BodiesInShear
{
  double stiffness = 0;      ///< 8 G*: k_t over the contact radius
  double damping_ratio = 0;  ///< part of critical, of a contact that never yielded
  /// Weight of what shear does to the place of the pressure on body i: 1 on a rigid partner, 0 between like bodies,
  /// where the contact is the same to both and the pressure has no side to go to.
  double asymmetry = 1;

  /// `pressure`: Pa, the caller's unit.
  static BodiesInShear of(const ElasticBody& i, const ElasticBody& j, double damping_ratio, double pressure = 1)
  {
    const double shear = shear_compliance(i.youngs_modulus, i.poisson_ratio) +
                         shear_compliance(j.youngs_modulus, j.poisson_ratio);
    return {8.0 / shear / pressure, damping_ratio,
            (i.compliance() - j.compliance()) / (i.compliance() + j.compliance())};
  }
};

/// `tangential plastic`: a contact that yields under its normal force, its shear and the turning of its dent.
///
/// The dent is a facet of the body: a depth, which is the normal law's largest overlap, and a direction, which
/// differs from the contact's normal by the tilt. The contact is elastic in overlap, slip and tilt, and flows where
///     F > alpha(h) s(q) F_m                                                              (ShearYield, DiscSegment)
/// with the law's loading force F_m at the depth; friction is the outer limit of T. Elastic forces have a
/// potential, and flow dissipates, so that no closed path gives work. Head-on it is the normal law; of a material
/// that does not yield it is `history`, to the bit. Two bodies turn as one does on a wall at their relative turning.
/// Source: docs/theory/oblique.md.
class PlasticShear
{
 public:
  static constexpr std::array keeps{
      Kept{.name = "shear", .values = 3, .turns_with_exchange = true},  // N, on j, of the real contact; elastic: m
      Kept{.name = "shear_stiffness"},                                  // N/m, of the last step
      Kept{.name = "tilt", .values = 3},  // rad, in the direction that i rolls: the same for j
      Kept{.name = "sheared"},  // m, sliding of the flow
      Kept{.name = "depth"}};   // m, of the last step: the normal law has taken it along since where it loads

  PlasticShear() = default;
  /// `spring`: LIGGGHTS's, stretched as the law is; of it the friction, and all for a body that does not yield.
  template <class Normal>
  PlasticShear(const Normal& law, const ShearPair& spring, const BodiesInShear& bodies)
      : elastic_(spring),
        damping_ratio_(bodies.damping_ratio),
        material_{bodies.stiffness, bodies.asymmetry, spring.friction, law.pair_modulus(), law.radius_unit(), law.flow_stress()},
        stretch_(law.stretch()),
        per_stretch_(1.0 / law.stretch())
  {
  }

  /// False: the body is elastic, and nothing but LIGGGHTS's spring acts.
  bool turns() const { return std::isfinite(material_.flow_stress.yield); }

  /// True of a contact that never yielded: it is held, by a spring.
  template <class Normal>
  bool holds(const Normal& law, double r_eff, double deepest) const
  {
    return !turns() || deepest <= law.yield_overlap() * r_eff;
  }
  /// N, shear on body i of a contact that holds.
  Vector hold(const ContactMotion& m, double force, double deepest, double* kept, Ledger& books) const
  {
    if (!turns()) return elastic_.advance(m, force, kept, books);
    const DentMotion step = motion(m);
    DentMemory held = read(kept, m.normal);
    const double k = material_.shear_stiffness * std::sqrt(m.r_eff * step.overlap);  // Hertz's radius
    double taken = held.stretch(step.slide, k);
    const double pull = norm(held.pull), most = material_.friction * (force * stretch_);
    Vector braking{};
    if (pull > most) {
      held.pull = times(held.pull, most / pull);
      taken += most * (pull - most) / k;
    } else {
      braking = times(m.slide, 2.0 * damping_ratio_ * std::sqrt(k * m.m_eff));
      taken += dot(braking, step.slide);
    }
    held.tilt = {}, held.depth = deepest * per_stretch_;
    if (m.advances) {
      write(held, kept);
      books[Mechanism::friction] += taken;
    }
    return times(sum(held.pull, braking), -per_stretch_);
  }

  template <class Normal>
  Grip advance(const Normal& law, const ContactMotion& m, double& force, double* normal_kept, double* kept,
               Ledger& books) const
  {
    if (holds(law, m.r_eff, normal_kept[0])) return hold(m, force, normal_kept[0], kept, books);
    const DentMotion step = motion(m);
    DentMemory held = read(kept, m.normal);
    Grip answer;
    const double depth = normal_kept[0] * per_stretch_, latched = NormalState<Normal>::impact_overlap(normal_kept);
    const auto dent_at = [&](double d) { return law.dent(m.r_eff, d, latched); };
    const auto dent = law.dent(m.r_eff, depth, latched, normal_kept + NormalState<Normal>::own);
    const double before = dent.force_at(step.overlap);
    DentMemory whole = held;
    DentState tried, now = ShearReturn(material_, dent_at, dent, before, whole, step).solve(tried);
    double lost = now.lost;
    if (const int parts = now.flows ? parts_of(step, dent) : 1; parts == 1) {
      held = whole;
      if (m.advances) book(held, step, tried, now, books);
    } else {
      for (int part = 1; part <= parts; ++part) {
        const DentMotion some = step.part(part, parts);
        const double begins = std::max(held.depth, some.overlap);
        now = ShearReturn(material_, dent_at, dent_at(begins), before, held, some).solve(tried);
        held.depth = now.depth;
        book(held, some, tried, now, books);
      }
      lost = law.dissipated(m.r_eff, normal_kept[0], now.depth * stretch_, latched);
    }
    held.depth = now.depth;
    force = std::max(force + (now.force - before) * per_stretch_, 0.0);  // keeps what is no number
    answer.force = times(held.pull, -per_stretch_);
    answer.couple = times(cross(m.normal, held.tilt), -now.moment * per_stretch_);
    if (m.advances) {
      write(held, kept);
      if (now.depth != depth) {
        books[Mechanism::plastic] += lost;
        normal_kept[0] = now.depth * stretch_;
      }
    }
    return answer;
  }

 private:
  /// A step of the real contact.
  DentMotion motion(const ContactMotion& m) const
  {
    const double time = m.advances ? m.dt * per_stretch_ : 0.0;
    return {.radius = m.r_eff,
            .overlap = m.overlap * per_stretch_,
            .deepening = m.approach * time,
            .slide = times(m.slide, time),
            .turn = times(m.turn, time)};
  }

  /// A flow is explicit in its direction and in the sheared area. In dents of a tenth of R, parts of a two hundredth of
  /// the depth are as good as small steps, and whole steps as good as them in shallow dents (docs/evidence/oblique.md).
  template <class Dent>
  static int parts_of(const DentMotion& step, const Dent& dent)
  {
    constexpr double finest = 0.005, most = 16, deep = 0.1;
    const double moves = std::max(std::abs(step.deepening), dent.radius * norm(step.turn)) / (finest * dent.depth);
    return static_cast<int>(std::max(1.0, std::ceil(std::min(most, moves) * std::min(1.0, dent.depth / (deep * step.radius)))));
  }

  /// `keeps`, turned with the contact.
  static DentMemory read(const double* kept, const Vector& normal)
  {
    DentMemory held{{kept[0], kept[1], kept[2]}, kept[3], {kept[4], kept[5], kept[6]}, kept[7], kept[8]};
    held.pull = sum(held.pull, normal, -dot(held.pull, normal));
    held.tilt = sum(held.tilt, normal, -dot(held.tilt, normal));
    return held;
  }
  static void write(const DentMemory& held, double* kept)
  {
    std::copy_n(held.pull.begin(), 3, kept);
    kept[3] = held.stiffness;
    std::copy_n(held.tilt.begin(), 3, kept + 4);
    kept[7] = held.sheared, kept[8] = held.depth;
  }

  /// Books a part of a step. The flow's loss is what the contact held before it and does not hold after it, less what it
  /// was not given: motion works against the mean of the forces before and after; and less the normal law's.
  static void book(const DentMemory& held, const DentMotion& step, const DentState& tried, const DentState& now, Ledger& books)
  {
    books[Mechanism::friction] += tried.rubbed + now.rubbed * now.flows;
    if (!now.flows) return;
    const Vector along = unit(held.pull);
    const auto energy = [&](const DentState& state) {
      const double given = state.force * step.deepening + state.pull * dot(along, step.slide) +
                           state.moment * dot(state.tilt, step.turn);
      return state.energy - 0.5 * given;
    };
    books[Mechanism::shear] += energy(tried) - energy(now) - now.rubbed - now.lost;
  }

  Spring elastic_;  // of a body that does not yield
  double damping_ratio_ = 0;
  DentMaterial material_;
  double stretch_ = 1, per_stretch_ = 1;
};

}  // namespace granulaw
