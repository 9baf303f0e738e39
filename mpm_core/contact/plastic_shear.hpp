#pragma once

#include <limits>
#include <optional>

#include "contact/contact.hpp"
#include "contact/dent.hpp"
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
  double stiffness = 0;      ///< Pa, 8 G*: k_t over the contact radius
  double damping_ratio = 0;  ///< part of critical, of a contact that never yielded
  /// Weight of what shear does to the place of the pressure on body i: 1 on a rigid partner, 0 between like bodies,
  /// where the contact is the same to both and the pressure has no side to go to.
  double asymmetry = 1;

  static BodiesInShear of(const ElasticBody& i, const ElasticBody& j, double damping_ratio)
  {
    const double shear = shear_compliance(i.youngs_modulus, i.poisson_ratio) +
                         shear_compliance(j.youngs_modulus, j.poisson_ratio);
    return {8.0 / shear, damping_ratio,
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
        bodies_(bodies),
        flow_stress_(law.flow_stress()),
        e_star_(law.pair_modulus()),
        per_radius_(law.radius_unit()),
        stretch_(law.stretch())
  {
  }

  /// False: the body is elastic, and nothing but LIGGGHTS's spring acts.
  bool turns() const { return std::isfinite(flow_stress_.yield); }

  template <class Normal>
  Grip advance(const Normal& law, const ContactMotion& m, double& force, double* normal_kept, double* kept,
               Ledger& books) const
  {
    if (!turns()) return elastic_.advance(law, m, force, normal_kept, kept, books);
    const double per_stretch = 1.0 / stretch_, time = m.advances ? m.dt * per_stretch : 0.0;
    const Step step{.radius = m.r_eff,
                    .overlap = m.overlap * per_stretch,
                    .deepening = m.approach * time,
                    .slide = times(m.slide, time),
                    .turn = times(m.turn, time)};
    Memory held(kept, m.normal);
    Grip answer;
    const double depth = normal_kept[0] * per_stretch, latched = NormalState<Normal>::impact_overlap(normal_kept);
    if (normal_kept[0] <= law.yield_overlap() * m.r_eff) {
      held.depth = depth;
      const double a = std::sqrt(m.r_eff * step.overlap);  // Hertz's
      answer.force = hold(held, bodies_.stiffness * a, force * stretch_, step, m, books);
    } else {
      const auto dent_at = [&](double d) { return law.dent(m.r_eff, d, latched); };
      const auto dent = law.dent(m.r_eff, depth, latched, normal_kept + NormalState<Normal>::own);
      const double before = dent.force_at(step.overlap);
      Memory whole = held;
      State tried, now = yield(dent_at, dent, whole, step, tried);
      double lost = 0;
      if (const int parts = now.flows ? parts_of(step, dent) : 1; parts == 1) {
        held = whole;
        if (m.advances) lost = book(law, m, latched, held, step, depth, tried, now, books);
      } else {
        for (int part = 1; part <= parts; ++part) {
          const Step some = step.part(part, parts);
          const double begins = std::max(held.depth, some.overlap);
          now = yield(dent_at, dent_at(begins), held, some, tried);
          held.depth = now.depth;
          book(law, m, latched, held, some, begins, tried, now, books);
        }
        lost = law.dissipated(m.r_eff, normal_kept[0], now.depth * stretch_, latched);
      }
      held.depth = now.depth;
      force = std::max(force + (now.force - before) * per_stretch, 0.0);  // keeps what is no number
      answer.force = times(held.pull, -1.0);
      answer.couple = times(cross(m.normal, held.tilt), -now.moment);
      if (m.advances && now.depth != depth) {
        books[Mechanism::plastic] += lost;
        normal_kept[0] = now.depth * stretch_;
      }
    }
    if (m.advances) held.write(kept);
    answer.force = times(answer.force, per_stretch), answer.couple = times(answer.couple, per_stretch);
    return answer;
  }

 private:
  static constexpr double widening = 1.3;         // of T_0, measured at a small contact (docs/evidence/oblique.md)
  static constexpr double pressure_shift = 0.25;  // zeta: T moves the pressure back by zeta a T/F, measured
  static constexpr double tabor_strain = 0.2;     // of the indentation, times a/R: Tabor, The Hardness of Metals (1951)
  static constexpr double shear_strain = 1.1;     // of the shear, times its sliding over a, measured
  static constexpr double tolerance = 1e-4;       // of F_m, in the yield condition: e and spin change by 1e-4
  static constexpr double step_tolerance = 0.02;  // of what the step exceeds yield by, where that is more
  static constexpr double linear = 0.005;         // of the depth, over which a dent is linear: its force to 2e-5
  static constexpr double nearly = 1e-4;          // of the depth, the last Newton step in the elastic overlap: the error is its square

  static Vector times(const Vector& v, double factor) { return {v[0] * factor, v[1] * factor, v[2] * factor}; }
  static Vector sum(const Vector& v, const Vector& w, double factor = 1.0)
  {
    return {v[0] + w[0] * factor, v[1] + w[1] * factor, v[2] + w[2] * factor};
  }
  static double dot(const Vector& v, const Vector& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }
  static double size(const Vector& v) { return std::sqrt(dot(v, v)); }
  static Vector unit(const Vector& v)
  {
    const double length = size(v);
    return length > 0 ? times(v, 1.0 / length) : Vector{};
  }

  /// Motion of the real contact in a step: lengths in m, turning in rad.
  struct Step
  {
    double radius, overlap, deepening;  // R*
    Vector slide, turn;

    /// One of `all` equal parts.
    Step part(int which, int all) const
    {
      const double one = 1.0 / all;
      return {radius, overlap - deepening * (all - which) * one, deepening * one, times(slide, one), times(turn, one)};
    }
  };
  /// A flow is explicit in its direction and in the sheared area. In dents of a tenth of R, parts of a two hundredth of
  /// the depth are as good as small steps, and whole steps as good as them in shallow dents (docs/evidence/oblique.md).
  template <class Dent>
  static int parts_of(const Step& step, const Dent& dent)
  {
    constexpr double finest = 0.005, most = 16, deep = 0.1;
    const double moves = std::max(std::abs(step.deepening), dent.radius * size(step.turn)) / (finest * dent.depth);
    return static_cast<int>(std::max(1.0, std::ceil(std::min(most, moves) * std::min(1.0, dent.depth / (deep * step.radius)))));
  }

  /// `keeps`.
  struct Memory
  {
    Vector pull;
    double stiffness;
    Vector tilt;
    double sheared, depth;

    Memory(const double* kept, const Vector& normal)
        : pull{kept[0], kept[1], kept[2]}, stiffness(kept[3]), tilt{kept[4], kept[5], kept[6]}, sheared(kept[7]), depth(kept[8])
    {
      pull = sum(pull, normal, -dot(pull, normal));
      tilt = sum(tilt, normal, -dot(tilt, normal));
    }
    void write(double* kept) const
    {
      std::copy_n(pull.begin(), 3, kept);
      kept[3] = stiffness;
      std::copy_n(tilt.begin(), 3, kept + 4);
      kept[7] = sheared, kept[8] = depth;
    }
    /// Moves the spring, N/m. One that stiffens keeps its force, one that softens its stretch: either loses
    /// energy, J.
    double stretch(const Vector& slide, double k)
    {
      double taken = 0;
      if (stiffness > 0) {
        const double half = 0.5 * dot(pull, pull) / stiffness, ratio = k / stiffness;
        taken = half * (ratio < 1.0 ? 1.0 - ratio : 1.0 - 1.0 / ratio);
        if (ratio < 1.0) pull = times(pull, ratio);
      }
      stiffness = k;
      pull = sum(pull, slide, k);
      return taken;
    }
  };

  /// A contact below yield: LIGGGHTS's spring with the law's contact radius.
  Vector hold(Memory& held, double k, double normal, const Step& step, const ContactMotion& m, Ledger& books) const
  {
    double taken = held.stretch(step.slide, k);
    held.tilt = {};
    const double pull = size(held.pull), most = elastic_.pair.friction * normal;
    Vector braking{};
    if (pull > most) {
      held.pull = times(held.pull, most / pull);
      taken += most * (pull - most) / k;
    } else {
      braking = times(m.slide, 2.0 * bodies_.damping_ratio * std::sqrt(k * m.m_eff));
      taken += dot(braking, step.slide);
    }
    if (m.advances) books[Mechanism::friction] += taken;
    return sum(times(held.pull, -1.0), braking, -1.0);
  }

  /// Elastic answer of a tilted dent: F, F/F_m, K against tilting, radius.
  struct Elastic
  {
    double force, share, stiffness, radius;
    double energy;  // J, that it holds
  };
  /// F = F_u(delta + (K'(F) - (R - delta_r)) phi^2/2), K = F (r + (K_m/F_m - r) F/F_m).
  template <class Dent>
  Elastic elastic(const Dent& dent, const Step& step, double tilt2) const
  {
    const double four_thirds = 4.0 / 3.0 * e_star_, r = dent.radius * dent.radius / (dent.depth - dent.residual);
    const double excess = four_thirds * dent.radius * dent.radius * dent.radius / dent.force - r;
    const double base = step.overlap + 0.5 * (r - (step.radius - dent.residual)) * tilt2, per_share = excess * tilt2;
    const double per_force = 1.0 / dent.force;
    double at = base, share = dent.force_at(at) * per_force;
    for (int newton = 0; newton < 3 && std::abs(base + per_share * share - at) > nearly * dent.depth; ++newton) {
      at = base + per_share * share;
      const Response there = dent.response_at(at);
      share -= (share - there.force * per_force) / (1.0 - per_share * there.stiffness * per_force);
      share = std::max(0.0, share);
    }
    const double force = share * dent.force, stiffness = force * (r + excess * share);
    at = base + per_share * share;
    return {force, share, stiffness, std::cbrt(stiffness / four_thirds),
            dent.work_at(at) - 0.5 * tilt2 * force * excess * share};
  }

  /// State of the contact, elastic or after flow.
  struct State
  {
    double force = 0, moment = 0, depth = 0;    // moment: per tilt
    double excess = 0;                          // of F beyond yield
    double pull = 0, slid = 0;                  // T, and the sliding of the flow
    double energy = 0;                          // J, that the contact holds
    double rubbed = 0;                          // J, taken by friction
    Vector tilt{};
    bool flows = false;
  };

  /// A contact beyond yield's onset: its state after the step, and `tried`, the elastic one.
  template <class DentAt, class Dent>
  State yield(const DentAt& dent_at, const Dent& start, Memory& held, const Step& step, State& tried) const
  {
    held.tilt = sum(held.tilt, step.turn);
    if (!(held.stiffness > 0)) {
      // parted: beyond this tilt the dent's rim would touch, around which the body is a sphere again
      const double tilt = size(held.tilt), rim = (start.depth - start.residual) / start.radius;
      if (tilt > rim) held.tilt = times(held.tilt, rim / tilt);
    }
    const Elastic first = elastic(start, step, dot(held.tilt, held.tilt));
    if (!(first.force > 0)) {
      held.pull = {}, held.stiffness = 0;
      return {.depth = start.depth, .tilt = held.tilt};
    }
    const double softened = held.stretch(step.slide, bodies_.stiffness * first.radius);
    const double k = held.stiffness, stretched = size(held.pull), a = start.radius, friction = elastic_.pair.friction;
    const Vector along = unit(held.pull);
    const double shift = bodies_.asymmetry * pressure_shift * first.radius / first.stiffness;  // of the axis, per T
    const auto leaning = [&](const Vector& tilt, double pull) { return sum(tilt, along, shift * pull); };
    double near = 2.0;  // h of the last segment: the next one begins there
    const auto segment_of = [&](const Elastic& e, double radius, double lean) {
      return DiscSegment::with_centroid(e.force > 0 ? e.stiffness / (e.force * radius) * lean : 0.0, near);
    };
    const double cut = std::min(stretched, friction * first.force);
    const Vector lean = leaning(held.tilt, cut);
    const double softest = wide_strength(held, step, first.radius, a);
    {
      // most contacts, by bounds that cost no root
      const double area = DiscSegment::least_area(first.stiffness / (first.force * a) * size(lean));
      const double least = softest * std::min(first.radius * first.radius, area * a * a);
      if (cut < least && first.force <= area * ShearYield::least_share(cut / least) * start.force) {
        tried = {.force = first.force,
                 .moment = first.stiffness - first.force * (step.radius - start.residual),
                 .depth = start.depth,
                 .pull = cut,
                 .rubbed = softened + cut * (stretched - cut) / k,
                 .tilt = held.tilt};
        held.pull = times(along, cut);
        return tried;
      }
    }
    const DiscSegment segment = segment_of(first, a, size(lean));
    near = segment.h;
    const double strength = softest * std::min(first.radius * first.radius, segment.area * a * a);
    const auto state_of = [&](const Elastic& e, const Dent& dent, double area, double pull, double share) {
      return State{.force = e.force,
                   .moment = e.stiffness - e.force * (step.radius - dent.residual),
                   .depth = dent.depth,
                   .excess = e.force - area * share * dent.force,
                   .pull = pull,
                   .energy = e.energy + 0.5 * pull * pull / k};
    };
    tried = state_of(first, start, segment.area, cut, ShearYield::share(std::min(1.0, cut / strength)));
    tried.tilt = held.tilt;
    tried.rubbed = softened;
    if (cut <= strength && tried.excess <= tolerance * start.force) {
      tried.rubbed += cut * (stretched - cut) / k;
      held.pull = times(along, cut);
      return tried;
    }
    tried.pull = stretched, tried.energy = first.energy + 0.5 * stretched * stretched / k;

    // a dent nearly as deep is linear in its depth
    std::optional<Dent> deeper;
    const auto dent_of = [&](double depth) {
      const double more = depth / start.depth - 1.0;
      if (more == 0.0) return start;
      if (std::abs(more) > 2.0 * linear) return dent_at(depth);
      if (!deeper) deeper = dent_at((1.0 + linear) * start.depth);
      return start.toward(*deeper, more / linear, depth);
    };
    // `moved`: volume of the flow over the contact's area; turning gives `back` to the spring
    double tau = -1.0;  // of the last state: the next one begins there
    const auto flowed = [&](const Dent& dent, const Elastic& e, const Vector& tilt, double moved, double back,
                            const auto& area_of) {
      const double give = moved * start.force / strength, spring = std::max(0.0, stretched + k * back);
      tau = ShearYield::tau_of(spring, strength, k * give, tau);
      ShearYield::Point shear = ShearYield::at_tau(tau);
      double pull = strength * shear.q, slid = (spring - pull) / k;
      if (const double most = friction * e.force; pull > most) {
        pull = most, shear = ShearYield::at_tau(ShearYield::tau(most / strength));
        slid = give * shear.fall;
      }
      State now = state_of(e, dent, area_of(e, dent.radius, pull), pull, shear.share);
      now.slid = slid;
      now.rubbed = pull * std::max(0.0, (spring - pull) / k - slid);
      now.tilt = tilt;
      now.flows = true;
      return now;
    };
    const auto flowed_to = [&](double depth, const Vector& tilt, double moved, double back, const auto& area_of) {
      const Dent dent = dent_of(std::max(depth, step.overlap));
      return flowed(dent, elastic(dent, step, dot(tilt, tilt)), tilt, moved, back, area_of);
    };
    // from T_0 on the force falls as the root of the flow (s - 1 + c as its power m/(2 - 2 m) = 0.54)
    const bool steep = cut > strength;
    const auto amount_at = [&](double place) { return steep ? place * place : place; };
    const auto place_of = [&](double amount) { return steep ? std::sqrt(amount) : amount; };
    const double within = std::max(tolerance * start.force, step_tolerance * tried.excess);
    // the whole contact moves in
    const double from = held.depth;
    const Vector upright = times(along, -shift * std::min(cut, strength));
    const auto corner = [&](double place) {
      const double more = amount_at(place);
      return flowed_to(from + more, upright, more, 0.0, [](const Elastic&, double, double) { return 1.0; });
    };
    const double needed = a * size(sum(held.tilt, upright, -1.0));
    // a segment moves in
    const Vector toward = unit(lean);
    const double rolled = dot(step.turn, toward);
    const DentFlow flow = DentFlow::of(segment, rolled > 0 ? -step.deepening / (a * rolled) : -1.0);
    const double back = bodies_.asymmetry * pressure_shift * a * flow.turning * dot(along, toward);
    const auto area_at = [&](const Vector& tilt) {
      return [&](const Elastic& e, double radius, double pull) {
        const DiscSegment now = segment_of(e, radius, std::max(0.0, dot(leaning(tilt, pull), toward)));
        near = now.h;
        return now.area;
      };
    };
    const auto slice = [&](double place) {
      const double amount = amount_at(place);
      const Vector tilt = sum(held.tilt, toward, -flow.turning * amount);
      return flowed_to(from + flow.deepening * a * amount, tilt, flow.mean * a * amount, back * amount, area_at(tilt));
    };
    // where a segment alone moves in, the corner lies beyond: it is tried first where the turning is small
    const double most = size(lean) / flow.turning;
    State end;
    bool found = false;
    if (needed > step.deepening) {
      end = flowed(start, first, held.tilt, 0.0, 0.0, area_at(held.tilt));
      const double steady = std::max(rolled, step.deepening / a) / flow.turning;
      found = !(end.excess > 0) ||
              root(slice, 0.0, end, place_of(std::max(steady, 1e-3 * most)), place_of(most), within, end);
    }
    if (!found) {
      constexpr double endless = std::numeric_limits<double>::infinity();
      const double least = place_of(needed);
      end = corner(least);
      if (end.excess > within) {
        const double steady = std::max({needed, std::abs(step.deepening), 1e-6 * from});
        root(corner, least, end, place_of(steady), endless, within, end);
      } else if (end.excess < -within) {
        const State none = corner(0.0);
        end = none.excess > 0 ? between(corner, 0.0, none, least, end, within) : none;
      }
    }
    held.sheared += end.slid;
    held.pull = times(along, end.pull), held.tilt = end.tilt;
    return end;
  }

  /// Books a part of a step that began at `depth`, and gives what the normal law has lost at the new depth, J. The
  /// flow's loss is what the contact held before it and does not hold after it, less what it was not given: motion works
  /// against the mean of the forces before and after; and less the normal law's.
  template <class Normal>
  double book(const Normal& law, const ContactMotion& m, double latched, const Memory& held, const Step& step,
              double depth, const State& tried, const State& now, Ledger& books) const
  {
    books[Mechanism::friction] += tried.rubbed + now.rubbed * now.flows;
    if (!now.flows) return 0.0;
    const Vector along = unit(held.pull);
    const auto energy = [&](const State& state) {
      const double given = state.force * step.deepening + state.pull * dot(along, step.slide) +
                           state.moment * dot(state.tilt, step.turn);
      return state.energy - 0.5 * given;
    };
    const double lost =
        now.depth != depth ? law.dissipated(m.r_eff, stretch_ * depth, stretch_ * now.depth, latched) : 0.0;
    books[Mechanism::shear] += energy(tried) - energy(now) - now.rubbed - lost;
    return lost;
  }

  /// Pa, T_0 over the area that bears of a contact of radius `whole` at full load.
  double wide_strength(const Memory& held, const Step& step, double present, double whole) const
  {
    const double ratio = whole / (step.radius * per_radius_);
    double stress = flow_stress_.yield;
    if (flow_stress_.hardens())
      stress = flow_stress_.at(std::hypot(tabor_strain * ratio, shear_strain * held.sheared / present));
    return widening * (1.0 - ratio * ratio) / std::sqrt(3.0) * M_PI * stress;
  }

  /// `found`: the point of no excess on a path where it falls: from `low`, where it is positive, by steps from `width` on
  /// to `most`. False: there is none.
  template <class Path>
  static bool root(const Path& path, double low, State at_low, double width, double most, double within, State& found)
  {
    for (int tripling = 0; tripling < 60 && low < most; ++tripling, width *= 3.0) {
      const double high = std::min(low + width, most);
      found = path(high);
      if (found.excess <= within) {
        found = between(path, low, at_low, high, found, within);
        return true;
      }
      low = high, at_low = found;
    }
    return false;
  }
  /// The same between two points: through the last three by inverse interpolation of the second order where that is
  /// monotonic (Chandrupatla, Adv. Eng. Software 28, 1997), else by the rule of Illinois.
  template <class Path>
  static State between(const Path& path, double low, const State& at_low, double high, const State& at_high,
                       double within)
  {
    State at = at_high;
    double x = high, f = at_high.excess, other = low, across = at_low.excess, stale = 1.0, part = f / (f - across);
    for (int step = 0; step < 60 && std::abs(f) > within && part > 0.0 && part < 1.0; ++step) {
      const double middle = x + part * (other - x);
      at = path(middle);
      double third = x, at_third = f;
      stale *= 0.5;
      if ((at.excess > 0) != (f > 0)) std::swap(third, other), std::swap(at_third, across), stale = 1.0;
      x = middle, f = at.excess;
      const double place = (x - other) / (third - other), rise = (f - across) / (at_third - across);
      if (rise * rise < place && (1.0 - rise) * (1.0 - rise) < 1.0 - place)
        part = f / (across - f) * at_third / (across - at_third) +
               (third - x) / (other - x) * f / (at_third - f) * across / (at_third - across);
      else
        part = f / (f - stale * across);
    }
    return at;
  }

  Spring elastic_;      // of a body that does not yield
  BodiesInShear bodies_;
  FlowStress flow_stress_;
  double e_star_ = 0, per_radius_ = 1, stretch_ = 1;
};

}  // namespace granulaw
