#pragma once

#include <limits>
#include <optional>

#include "contact/contact.hpp"
#include "contact/dent.hpp"
#include "contact/normal.hpp"
#include "contact/vector.hpp"

// One step of a dent that is pressed, sheared and turned: an elastic trial, and its return to the yield surface.
// docs/theory/oblique.md has the equations by their numbers.
namespace granulaw {

/// Numbers of two bodies whose contact yields in shear.
struct DentMaterial
{
  double shear_stiffness = 0;  ///< Pa, 8 G*: k_t over the contact radius
  double asymmetry = 1;        ///< of BodiesInShear
  double friction = 0;
  double e_star = 0;      ///< Pa, of the pair
  double per_radius = 1;  ///< unit of contact radii over R*
  FlowStress flow_stress;

  /// N, T_0 over the area that bears, in units of pi a^2, of a contact of radius `whole` at full load; (4).
  double strength(double whole, double r_eff, double sheared, double present) const
  {
    const double ratio = whole / (r_eff * per_radius);
    double stress = flow_stress.yield;
    if (flow_stress.hardens()) stress = flow_stress.at(std::hypot(tabor_strain * ratio, shear_strain * sheared / present));
    return widening * (1.0 - ratio * ratio) / std::sqrt(3.0) * M_PI * stress;
  }

 private:
  static constexpr double widening = 1.3;      // of T_0, measured at a small contact (docs/evidence/oblique.md)
  static constexpr double tabor_strain = 0.2;  // of the indentation, times a/R: Tabor, The Hardness of Metals (1951)
  static constexpr double shear_strain = 1.1;  // of the shear, times its sliding over a, measured
};

/// Motion of the real contact in a step: lengths in m, turning in rad.
struct DentMotion
{
  double radius, overlap, deepening;  // R*
  Vector slide, turn;

  /// One of `all` equal parts.
  DentMotion part(int which, int all) const
  {
    const double one = 1.0 / all;
    return {radius, overlap - deepening * (all - which) * one, deepening * one, times(slide, one), times(turn, one)};
  }
};

/// Spring and tilt of a contact between two steps, and its depth.
struct DentMemory
{
  Vector pull;       ///< N, of the spring
  double stiffness;  ///< N/m, of the spring in the last step; 0: apart
  Vector tilt;       ///< rad
  double sheared;    ///< m, sliding of the flow
  double depth;      ///< m

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

/// State of a dent, elastic or after flow.
struct DentState
{
  double force = 0, moment = 0, depth = 0;  ///< moment: per tilt
  double excess = 0;                        ///< of F beyond yield
  double pull = 0, slid = 0;                ///< T, and the sliding of the flow
  double energy = 0;                        ///< J, that the contact holds
  double rubbed = 0;                        ///< J, taken by friction
  Vector tilt{};
  bool flows = false;
};

/// Elastic answer of a tilted dent; (1) and (2).
struct DentAnswer
{
  double force, share, stiffness, radius;  ///< F, F/F_m, K against tilting, radius
  double energy;                           ///< J, that it holds

  template <class Dent>
  static DentAnswer of(const Dent& dent, double e_star, double r_eff, double overlap, double tilt2)
  {
    const double four_thirds = 4.0 / 3.0 * e_star, r = dent.radius * dent.radius / (dent.depth - dent.residual);
    const double excess = four_thirds * dent.radius * dent.radius * dent.radius / dent.force - r;
    const double base = overlap + 0.5 * (r - (r_eff - dent.residual)) * tilt2, per_share = excess * tilt2;
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

 private:
  static constexpr double nearly = 1e-4;  // of the depth, the last Newton step in the overlap: the error is its square
};

/// Return of a step to the yield surface (3). `DentAt`: the dent of a depth.
///
/// The flow has one unknown, its amount, on one of two paths: at the corner the whole contact moves in, upright;
/// else a segment of it does, as a plane (DentFlow). On either path the excess falls, and its root is sought.
template <class Dent, class DentAt>
class ShearReturn
{
 public:
  /// `held`: is taken along.
  ShearReturn(const DentMaterial& material, const DentAt& dent_at, const Dent& start, DentMemory& held,
              const DentMotion& step)
      : material_(material), dent_at_(dent_at), start_(start), held_(held), step_(step)
  {
  }

  /// State after the step; `tried`: the elastic one.
  DentState solve(DentState& tried)
  {
    held_.tilt = sum(held_.tilt, step_.turn);
    if (!(held_.stiffness > 0)) end_tilt();
    const DentAnswer first = answer(start_, held_.tilt);
    if (!(first.force > 0)) {
      held_.pull = {}, held_.stiffness = 0;
      return {.depth = start_.depth, .tilt = held_.tilt};
    }
    const double softened = held_.stretch(step_.slide, material_.shear_stiffness * first.radius);
    k_ = held_.stiffness, stretched_ = norm(held_.pull), along_ = unit(held_.pull);
    shift_ = material_.asymmetry * pressure_shift * first.radius / first.stiffness;
    const double cut = std::min(stretched_, material_.friction * first.force), a = start_.radius;
    const Vector lean = leaning(held_.tilt, cut);
    const double softest = material_.strength(a, step_.radius, held_.sheared, first.radius);
    if (surely_elastic(first, norm(lean), cut, softest)) {
      tried = {.force = first.force,
               .moment = first.stiffness - first.force * (step_.radius - start_.residual),
               .depth = start_.depth,
               .pull = cut,
               .rubbed = softened + cut * (stretched_ - cut) / k_,
               .tilt = held_.tilt};
      held_.pull = times(along_, cut);
      return tried;
    }
    const DiscSegment segment = segment_of(first, a, norm(lean));
    near_ = segment.h;
    strength_ = softest * std::min(first.radius * first.radius, segment.area * a * a);
    tried = state(first, start_, segment.area, cut, ShearYield::share(std::min(1.0, cut / strength_)));
    tried.tilt = held_.tilt;
    tried.rubbed = softened;
    if (cut <= strength_ && tried.excess <= tolerance * start_.force) {
      tried.rubbed += cut * (stretched_ - cut) / k_;
      held_.pull = times(along_, cut);
      return tried;
    }
    tried.pull = stretched_, tried.energy = first.energy + 0.5 * stretched_ * stretched_ / k_;

    within_ = std::max(tolerance * start_.force, step_tolerance * tried.excess);
    steep_ = cut > strength_;
    const DentState end = flow(first, lean, segment, cut);
    held_.sheared += end.slid;
    held_.pull = times(along_, end.pull), held_.tilt = end.tilt;
    return end;
  }

 private:
  static constexpr double pressure_shift = 0.25;  // zeta: T moves the pressure back by zeta a T/F, measured
  static constexpr double tolerance = 1e-4;       // of F_m, in the yield condition: e and spin change by 1e-4
  static constexpr double step_tolerance = 0.02;  // of what the step exceeds yield by, where that is more
  static constexpr double linear = 0.005;         // of the depth, over which a dent is linear: its force to 2e-5

  /// Parted: beyond this tilt the dent's rim would touch, around which the body is a sphere again.
  void end_tilt()
  {
    const double tilt = norm(held_.tilt), rim = (start_.depth - start_.residual) / start_.radius;
    if (tilt > rim) held_.tilt = times(held_.tilt, rim / tilt);
  }

  /// True of most contacts that do not flow, by bounds that cost no root.
  bool surely_elastic(const DentAnswer& e, double lean, double pull, double softest) const
  {
    const double a = start_.radius, area = DiscSegment::least_area(e.stiffness / (e.force * a) * lean);
    const double least = softest * std::min(e.radius * e.radius, area * a * a);
    return pull < least && e.force <= area * ShearYield::least_share(pull / least) * start_.force;
  }

  DentAnswer answer(const Dent& dent, const Vector& tilt) const
  {
    return DentAnswer::of(dent, material_.e_star, step_.radius, step_.overlap, dot(tilt, tilt));
  }
  /// phi' of (3).
  Vector leaning(const Vector& tilt, double pull) const { return sum(tilt, along_, shift_ * pull); }
  DiscSegment segment_of(const DentAnswer& e, double radius, double lean) const
  {
    return DiscSegment::with_centroid(e.force > 0 ? e.stiffness / (e.force * radius) * lean : 0.0, near_);
  }
  DentState state(const DentAnswer& e, const Dent& dent, double area, double pull, double share) const
  {
    return {.force = e.force,
            .moment = e.stiffness - e.force * (step_.radius - dent.residual),
            .depth = dent.depth,
            .excess = e.force - area * share * dent.force,
            .pull = pull,
            .energy = e.energy + 0.5 * pull * pull / k_};
  }

  /// A dent nearly as deep as the first is linear in its depth.
  Dent dent_of(double depth)
  {
    const double more = depth / start_.depth - 1.0;
    if (more == 0.0) return start_;
    if (std::abs(more) > 2.0 * linear) return dent_at_(depth);
    if (!deeper_) deeper_ = dent_at_((1.0 + linear) * start_.depth);
    return start_.toward(*deeper_, more / linear, depth);
  }

  /// After a flow. `moved`: its volume over the contact's area; its turning gives `back` to the spring; `area`: the
  /// part that bears, by answer, radius and pull.
  template <class Area>
  DentState flowed(const Dent& dent, const DentAnswer& e, const Vector& tilt, double moved, double back, const Area& area)
  {
    const double give = moved * start_.force / strength_, spring = std::max(0.0, stretched_ + k_ * back);
    tau_ = ShearYield::tau_of(spring, strength_, k_ * give, tau_);
    ShearYield::Point shear = ShearYield::at_tau(tau_);
    double pull = strength_ * shear.q, slid = (spring - pull) / k_;
    if (const double most = material_.friction * e.force; pull > most) {
      pull = most, shear = ShearYield::at_tau(ShearYield::tau(most / strength_));
      slid = give * shear.fall;
    }
    DentState now = state(e, dent, area(e, dent.radius, pull), pull, shear.share);
    now.slid = slid;
    now.rubbed = pull * std::max(0.0, (spring - pull) / k_ - slid);
    now.tilt = tilt;
    now.flows = true;
    return now;
  }
  template <class Area>
  DentState flowed_to(double depth, const Vector& tilt, double moved, double back, const Area& area)
  {
    const Dent dent = dent_of(std::max(depth, step_.overlap));
    return flowed(dent, answer(dent, tilt), tilt, moved, back, area);
  }

  /// Places on a path: from T_0 on the force falls as the root of the flow (s - 1 + c as its power m/(2 - 2 m) = 0.54).
  double amount(double place) const { return steep_ ? place * place : place; }
  double place(double amount) const { return steep_ ? std::sqrt(amount) : amount; }

  /// Path of a segment that moves in.
  struct Segment
  {
    Vector toward;
    DentFlow flow;
    double back;  // of the spring, per amount
  };
  auto area_of(const Segment& segment, const Vector& tilt)
  {
    return [&](const DentAnswer& e, double radius, double pull) {
      const DiscSegment now = segment_of(e, radius, std::max(0.0, dot(leaning(tilt, pull), segment.toward)));
      near_ = now.h;
      return now.area;
    };
  }
  DentState at(const Segment& segment, double amount)
  {
    const double a = start_.radius;
    const Vector tilt = sum(held_.tilt, segment.toward, -segment.flow.turning * amount);
    return flowed_to(held_.depth + segment.flow.deepening * a * amount, tilt, segment.flow.mean * a * amount,
                     segment.back * amount, area_of(segment, tilt));
  }
  /// Path of the whole contact, which moves in by `more` and stands upright.
  DentState at_corner(const Vector& upright, double more)
  {
    return flowed_to(held_.depth + more, upright, more, 0.0, [](const DentAnswer&, double, double) { return 1.0; });
  }

  DentState flow(const DentAnswer& first, const Vector& lean, const DiscSegment& bears, double cut)
  {
    const double a = start_.radius;
    const Vector upright = times(along_, -shift_ * std::min(cut, strength_));
    const double needed = a * norm(sum(held_.tilt, upright, -1.0));  // to stand upright
    DentState end;
    // where a segment alone moves in, the corner lies beyond: it is tried first where the turning is small
    if (needed > step_.deepening) {
      const Vector toward = unit(lean);
      const double rolled = dot(step_.turn, toward);
      const DentFlow plane = DentFlow::of(bears, rolled > 0 ? -step_.deepening / (a * rolled) : -1.0);
      const Segment segment{toward, plane, material_.asymmetry * pressure_shift * a * plane.turning * dot(along_, toward)};
      end = flowed(start_, first, held_.tilt, 0.0, 0.0, area_of(segment, held_.tilt));
      const double most = norm(lean) / plane.turning, steady = std::max(rolled, step_.deepening / a) / plane.turning;
      const auto path = [&](double place) { return at(segment, amount(place)); };
      if (!(end.excess > 0) || root(path, 0.0, end, place(std::max(steady, 1e-3 * most)), place(most), end)) return end;
    }
    const auto path = [&](double place) { return at_corner(upright, amount(place)); };
    const double least = place(needed);
    end = path(least);
    if (end.excess > within_) {
      const double steady = std::max({needed, std::abs(step_.deepening), 1e-6 * held_.depth});
      root(path, least, end, place(steady), std::numeric_limits<double>::infinity(), end);
    } else if (end.excess < -within_) {
      const DentState none = path(0.0);
      end = none.excess > 0 ? between(path, 0.0, none, least, end) : none;
    }
    return end;
  }

  /// `found`: the point of no excess on a path where it falls: from `low`, where it is positive, by steps from `width` on
  /// to `most`. False: there is none.
  template <class Path>
  bool root(const Path& path, double low, DentState at_low, double width, double most, DentState& found) const
  {
    for (int tripling = 0; tripling < 60 && low < most; ++tripling, width *= 3.0) {
      const double high = std::min(low + width, most);
      found = path(high);
      if (found.excess <= within_) {
        found = between(path, low, at_low, high, found);
        return true;
      }
      low = high, at_low = found;
    }
    return false;
  }
  /// The same between two points: through the last three by inverse interpolation of the second order where that is
  /// monotonic (Chandrupatla, Adv. Eng. Software 28, 1997), else by the rule of Illinois.
  template <class Path>
  DentState between(const Path& path, double low, const DentState& at_low, double high, const DentState& at_high) const
  {
    DentState at = at_high;
    double x = high, f = at_high.excess, other = low, across = at_low.excess, stale = 1.0, part = f / (f - across);
    for (int step = 0; step < 60 && std::abs(f) > within_ && part > 0.0 && part < 1.0; ++step) {
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

  const DentMaterial& material_;
  const DentAt& dent_at_;
  const Dent& start_;
  DentMemory& held_;
  const DentMotion& step_;
  std::optional<Dent> deeper_;
  double k_ = 0, stretched_ = 0;  // of the spring: N/m, and its force before the flow
  Vector along_{};
  double shift_ = 0;           // of the axis, per T
  double strength_ = 0;        // T_0
  double within_ = 0;          // excess at which the search ends
  bool steep_ = false;         // T before the flow is above T_0
  double near_ = 2.0, tau_ = -1.0;  // of the last state: the next search begins there
};

}  // namespace granulaw
