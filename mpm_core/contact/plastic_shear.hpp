#pragma once

#include <limits>

#include "contact/facet.hpp"
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
///     F > alpha(phi') s(q) F_m                                                                (Facet, ShearYield)
/// with the law's loading force F_m at the depth; friction is the outer limit of T. Elastic forces have a
/// potential, and flow dissipates, so that no closed path gives work. Head-on it is the normal law; of a material
/// that does not yield it is `history`, to the bit. Two bodies turn as one does on a wall at their relative turning.
/// Source: docs/theory/oblique.md.
class PlasticShear
{
 public:
  static constexpr bool deepens = true;
  static constexpr std::array history_values{
      HistoryValue{.name = "shear", .values = 3, .changes_sign = true},  // N, on j, of the real contact; elastic: m
      HistoryValue{.name = "shear_stiffness"},                                  // N/m, of the last step
      HistoryValue{.name = "tilt", .values = 3},  // rad, in the direction that i rolls: the same for j
      HistoryValue{.name = "sheared"},            // m, sliding of the flow
      HistoryValue{.name = "depth"}};             // m, of the last step: the normal law has taken it along since where it loads

  PlasticShear() = default;
  /// `spring`: LIGGGHTS's, stretched as the law is; of it the friction, and all for a body that does not yield.
  template <class Normal>
  PlasticShear(const Normal& law, const ShearPair& spring, const BodiesInShear& bodies)
      : elastic_(spring),
        damping_ratio_(bodies.damping_ratio),
        material_{bodies.stiffness, bodies.asymmetry, spring.friction, law.flow_stress()},
        stretch_(law.stretch()),
        per_stretch_(1.0 / law.stretch())
  {
  }

  /// False: the body is elastic, and nothing but LIGGGHTS's spring acts.
  bool yields() const { return std::isfinite(material_.flow_stress.yield); }

  /// True of a contact that never yielded: a spring.
  template <class Normal>
  bool is_elastic(const Normal& law, double r_eff, double deepest) const
  {
    return !yields() || deepest <= law.yield_overlap() * r_eff;
  }
  /// N, shear on body i of such a contact.
  Vector elastic_step(const ContactMotion& m, double pressing, double deepest, double* history, Ledger& ledger) const
  {
    const FacetMotion step = motion(m);
    const FacetMemory last = read(history, m.normal);
    const double k = material_.shear_stiffness * std::sqrt(m.r_eff * step.overlap);  // Hertz's radius
    Vector pulls = last.stretched(step.slide, k), braking{};
    const double pull = norm(pulls), most = material_.friction * (std::abs(pressing) * stretch_);
    if (pull > most)
      pulls = times(pulls, most / pull);
    else
      braking = times(m.slide, 2.0 * damping_ratio_ * std::sqrt(k * m.m_eff));
    if (m.advances) {
      write({pulls, k, {}, last.sheared, deepest * per_stretch_}, history);
      ledger[Mechanism::friction] += last.taken(step.slide, pulls, k) + dot(braking, step.slide);
    }
    return times(sum(pulls, braking), -per_stretch_);
  }

  template <class Normal>
  TangentialForce advance(const Normal& law, const ContactMotion& m, double& force, double pressing, double* normal_history, double* history,
               Ledger& ledger) const
  {
    if (!yields()) return elastic_.advance(law, m, force, pressing, normal_history, history, ledger);
    if (is_elastic(law, m.r_eff, normal_history[0])) return elastic_step(m, pressing, normal_history[0], history, ledger);
    const FacetMotion step = motion(m);
    const FacetMemory last = read(history, m.normal);
    const double latched = NormalState<Normal>::impact_overlap(normal_history);
    const auto dent = law.dent(m.r_eff, normal_history[0] * per_stretch_, latched, normal_history + NormalState<Normal>::own);
    const FacetTrial trial(dent, material_, last, step);
    if (trial.yields) return flow(law, trial, m, step, last, force, normal_history, history, ledger);
    if (m.advances) {
      write(trial.memory(last.sheared), history);
      ledger[Mechanism::friction] += trial.touches() ? last.taken(step.slide, trial.pull, trial.stiffness) : last.spring_energy();
    }
    return force_of(trial, m, dent.force_at(step.overlap), force);
  }

 private:
  /// TangentialForce of a facet; `force` changes by what tilt and flow take from the law's `before`.
  template <class Dent>
  TangentialForce force_of(const Facet<Dent>& now, const ContactMotion& m, double before, double& force) const
  {
    force = std::max(force + (now.force - before) * per_stretch_, 0.0);  // keeps what is no number
    TangentialForce answer;
    answer.force = times(now.pull, -per_stretch_);
    answer.couple = times(cross(m.normal, now.moment()), -per_stretch_);
    return answer;
  }

  /// A step in which the contact yields. Not inlined, and by value: most contacts of a loop are elastic, in registers.
  template <class Normal, class Dent>
  [[gnu::noinline]] TangentialForce flow(const Normal& law, FacetTrial<Dent> trial, ContactMotion m, FacetMotion step, FacetMemory last,
                              double& force, double* normal_history, double* history, Ledger& ledger) const
  {
    double* const own = normal_history + NormalState<Normal>::own;
    const double latched = NormalState<Normal>::impact_overlap(normal_history), before = trial.dent.force_at(step.overlap);
    const Dent pressed = trial.dent;  // by the normal law, which has booked its loss
    double taken = 0, rubbed = 0;
    FacetLoads loads = loads_before(law, pressed, latched, step, last, taken);
    Facet<Dent> now = trial;
    const int parts = parts_of(step, pressed);
    for (int part = 1; part <= parts; ++part) {
      const FacetMotion some = parts > 1 ? step.part(part, parts) : step;
      if (parts > 1)
        trial = FacetTrial(law.dent(m.r_eff, std::max(last.depth, some.overlap), latched, own), material_, last, some);
      now = trial;
      double slid = 0;
      if (trial.yields) {
        const FacetFlow flow(trial, material_, last, some);
        slid = flow.slid;
        now = Facet<Dent>(law.dent(m.r_eff, std::max(trial.dent.depth + flow.deeper, some.overlap), latched, own), m.r_eff,
                          sum(trial.tilt, flow.turned));
        now.press(some.overlap, material_.shear_stiffness);
        // softened by the flow, the spring keeps its stretch
        const double pull = std::min(flow.pull * std::min(1.0, now.stiffness / trial.stiffness), material_.friction * now.force);
        now.pull = trial.pulls > 0 ? times(trial.pull, pull / trial.pulls) : Vector{};
        rubbed += pull * std::max(0.0, (trial.spring - pull) / trial.stiffness - slid);
      }
      const FacetLoads then(now);
      taken += then.taken(loads, some);
      loads = then, last = now.memory(last.sheared + slid);
    }
    if (m.advances) {
      write(last, history);
      normal_history[0] = last.depth * stretch_;
      const double lost = lost_between(pressed, now.dent);
      ledger[Mechanism::plastic] += lost;
      ledger[Mechanism::friction] += rubbed;
      ledger[Mechanism::shear] += taken - rubbed - lost;
    }
    return force_of(now, m, before, force);
  }

  /// Loads before the step: the spring's stiffness says how much of the dent bore. `taken`: less what the normal law has lost
  /// since.
  template <class Normal, class Dent>
  FacetLoads loads_before(const Normal& law, const Dent& pressed, double latched, const FacetMotion& step, const FacetMemory& last,
                          double& taken) const
  {
    if (!(last.stiffness > 0)) return {};
    const bool elastic = last.depth * stretch_ <= law.yield_overlap() * step.radius;  // it had no dent
    const double depth = elastic ? std::clamp(step.overlap - step.deepening, 0.01 * last.depth, last.depth) : last.depth;
    Facet<Dent> state(depth == pressed.depth ? pressed : law.dent(step.radius, depth, latched), step.radius, last.tilt);
    const double root = last.stiffness / (material_.shear_stiffness * state.dent.radius);
    state.press_to(elastic ? 1.0 : root * root, material_.shear_stiffness);
    state.pull = last.pull;
    if (depth != pressed.depth) taken -= lost_between(state.dent, pressed);
    return FacetLoads(state);
  }
  /// J, that a head-on contact loses between two depths that lie near.
  template <class Dent>
  static double lost_between(const Dent& from, const Dent& to)
  {
    return 0.5 * (from.force + to.force) * (to.depth - from.depth) - (to.work() - from.work());
  }

  /// A flow is explicit in its direction: in dents of a tenth of R, parts of a two hundredth of the depth are as good as small
  /// steps, and whole steps as good as them in shallow dents (docs/evidence/oblique.md).
  template <class Dent>
  static int parts_of(const FacetMotion& step, const Dent& dent)
  {
    constexpr double finest = 0.005, most = 16, deep = 0.1;
    const double moves = std::max(std::abs(step.deepening), dent.radius * norm(step.rolling)) / (finest * dent.depth);
    return static_cast<int>(std::max(1.0, std::ceil(std::min(most, moves) * std::min(1.0, dent.depth / (deep * step.radius)))));
  }

  /// A step of the real contact.
  FacetMotion motion(const ContactMotion& m) const
  {
    const double time = m.advances ? m.dt * per_stretch_ : 0.0;
    return {.radius = m.r_eff,
            .overlap = m.overlap * per_stretch_,
            .deepening = m.approach * time,
            .slide = times(m.slide, time),
            .rolling = times(m.rolling, time)};
  }

  /// The history, turned with the contact.
  static FacetMemory read(const double* history, const Vector& normal)
  {
    FacetMemory last{{history[0], history[1], history[2]}, history[3], {history[4], history[5], history[6]}, history[7], history[8]};
    last.pull = sum(last.pull, normal, -dot(last.pull, normal));
    last.tilt = sum(last.tilt, normal, -dot(last.tilt, normal));
    return last;
  }
  static void write(const FacetMemory& last, double* history)
  {
    std::copy_n(last.pull.begin(), 3, history);
    history[3] = last.stiffness;
    std::copy_n(last.tilt.begin(), 3, history + 4);
    history[7] = last.sheared, history[8] = last.depth;
  }

  Spring elastic_;  // of a body that does not yield
  double damping_ratio_ = 0;
  FacetMaterial material_;
  double stretch_ = 1, per_stretch_ = 1;
};

}  // namespace granulaw
