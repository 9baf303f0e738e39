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
    if (stiffness > 0) {  // its only branch: contacts load and unload at random
      const double less = std::min(k, stiffness), more = std::max(k, stiffness);
      taken = 0.5 * dot(pull, pull) / stiffness * (1.0 - less / more);
      pull = times(pull, less / stiffness);
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
  double pull = 0, slid = 0;                ///< T, and the sliding of the flow
  double energy = 0;                        ///< J, that the contact holds
  double rubbed = 0;                        ///< J, taken by friction
  double lost = 0;                          ///< J, that the normal law has lost at the depth, beyond the depth before
  Vector tilt{};
  bool flows = false;
};

/// A dent against tilting; (2).
template <class Dent>
struct TiltingDent : Dent
{
  double curvature;  ///< m, r
  double excess;     ///< m, K_m/F_m - r
  double lift;       ///< m, r - (R - delta_r)
  double per_force;  ///< 1/F_m

  TiltingDent(const Dent& dent, double e_star, double r_eff) : Dent(dent), per_force(1.0 / dent.force)
  {
    const double a2 = this->radius * this->radius;
    curvature = a2 / (this->depth - this->residual);
    excess = 4.0 / 3.0 * e_star * this->radius * a2 * per_force - curvature;
    lift = curvature - (r_eff - this->residual);
  }
  /// Dent::toward.
  TiltingDent toward(const TiltingDent& other, double part, double at) const
  {
    const auto mean = [part](double one, double two) { return one + part * (two - one); };
    TiltingDent now = *this;
    static_cast<Dent&>(now) = Dent::toward(other, part, at);
    now.curvature = mean(curvature, other.curvature), now.excess = mean(excess, other.excess);
    now.lift = mean(lift, other.lift), now.per_force = mean(per_force, other.per_force);
    return now;
  }

  /// Elastic answer; (1).
  struct Answer
  {
    double force, share, arm;  ///< F, F/F_m, K/F
    double at;                 ///< overlap in F_u
  };
  /// By Newton's method in F/F_m from `share`, until it moves the overlap by no more than `within` of the depth; the error
  /// is its square.
  Answer answer(double overlap, double tilt2, double share, double within) const
  {
    const double base = overlap + 0.5 * lift * tilt2, per_share = excess * tilt2;
    double at = base + per_share * share;
    for (int newton = 0; newton < 4; ++newton) {
      const Response there = this->response_at(at);
      share -= (share - there.force * per_force) / (1.0 - per_share * there.stiffness * per_force);
      share = std::max(0.0, share);
      const double before = at;
      at = base + per_share * share;
      if (!(std::abs(at - before) > within * this->depth)) break;
    }
    return {share * this->force, share, curvature + excess * share, at};
  }
  /// J, that it holds.
  double energy(const Answer& e, double tilt2) const
  {
    return this->work_at(e.at) - 0.5 * tilt2 * e.force * excess * e.share;
  }
  /// M per tilt.
  double moment(const Answer& e) const { return e.force * (lift + excess * e.share); }
};

/// Return of a step to the yield surface (3). `DentAt`: the dent of a depth.
///
/// The flow has one unknown, its amount, on one of two paths: at the corner the whole contact moves in, upright;
/// else a segment of it does, as a plane (DentFlow). On either path the excess falls, and its root is sought.
template <class Dent, class DentAt>
class ShearReturn
{
 public:
  /// `held`: is taken along. `force`: near that of the dent.
  ShearReturn(const DentMaterial& material, const DentAt& dent_at, const Dent& start, double force, DentMemory& held,
              const DentMotion& step)
      : material_(material), dent_at_(dent_at), start_(start, material.e_star, step.radius), held_(held), step_(step),
        force_(force)
  {
  }

  /// State after the step; `tried`: the elastic one.
  DentState solve(DentState& tried)
  {
    held_.tilt = sum(held_.tilt, step_.turn);
    if (!(held_.stiffness > 0)) end_tilt();
    const double tilt2 = dot(held_.tilt, held_.tilt);
    const Answer first = start_.answer(step_.overlap, tilt2, force_ * start_.per_force, exactly);
    if (!(first.force > 0)) {
      held_.pull = {}, held_.stiffness = 0;
      return {.depth = start_.depth, .tilt = held_.tilt};
    }
    const double a = start_.radius, last = held_.stiffness / material_.shear_stiffness;
    const double present = cube_root(first.force * first.arm / (4.0 / 3.0 * material_.e_star), last);
    const double softened = held_.stretch(step_.slide, material_.shear_stiffness * present);
    k_ = held_.stiffness, stretched_ = norm(held_.pull);
    along_ = stretched_ > 0.0 ? times(held_.pull, 1.0 / stretched_) : Vector{};
    shift_ = material_.asymmetry * pressure_shift * present / (first.force * first.arm);
    const double cut = std::min(stretched_, material_.friction * first.force);
    const double softest = material_.strength(a, step_.radius, held_.sheared, present);
    tried = {.force = first.force,
             .moment = start_.moment(first),
             .depth = start_.depth,
             .pull = cut,
             .rubbed = softened,
             .tilt = held_.tilt};
    const auto strength_of = [&](double area) { return softest * std::min(present * present, area * a * a); };
    const auto stays_elastic = [&] {
      tried.rubbed += cut * (stretched_ - cut) / k_;
      held_.pull = times(along_, cut);
      return tried;
    };
    {
      // most contacts, by bounds
      const double leans = std::sqrt(tilt2) + std::abs(shift_) * cut;
      const double area = DiscSegment::least_area(first.arm / a * leans), least = strength_of(area);
      if (cut < least && first.share - area * ShearYield::least_share(cut / least) <= tolerance) return stays_elastic();
    }
    const Vector lean = sum(held_.tilt, along_, shift_ * cut);  // phi' of (3)
    const double leans = norm(lean);
    const DiscSegment bears = DiscSegment::with_centroid(first.arm / a * leans);
    strength_ = strength_of(bears.area);
    const double beyond = first.share - bears.area * ShearYield::share(std::min(1.0, cut / strength_));
    if (cut <= strength_ && beyond <= tolerance) return stays_elastic();

    tried.pull = stretched_, tried.energy = start_.energy(first, tilt2) + 0.5 * stretched_ * stretched_ / k_;
    within_ = start_.force * std::max(tolerance, step_tolerance * beyond);
    steep_ = cut > strength_;
    answer_ = first, shear_ = ShearYield::Point(ShearYield::tau_of(cut / strength_));
    const DentState end = flow(lean, leans, bears, cut);
    held_.sheared += end.slid;
    held_.pull = times(along_, end.pull), held_.tilt = end.tilt;
    return end;
  }

 private:
  using Tilting = TiltingDent<Dent>;
  using Answer = typename Tilting::Answer;
  static constexpr double pressure_shift = 0.25;  // zeta: T moves the pressure back by zeta a T/F, measured
  static constexpr double tolerance = 1e-4;       // of F_m, in the yield condition: e and spin change by 1e-4
  static constexpr double step_tolerance = 0.02;  // of what the step exceeds yield by, where that is more
  static constexpr double linear = 0.005;         // of the depth, over which a dent is linear: its force to 2e-5
  static constexpr double exactly = 1e-4, nearly = 1e-3;  // of Tilting::answer, at first and in the search: errors are the squares
  static constexpr double roughly = 0.03;         // of ShearYield::Point::under, likewise

  /// By a step of Halley's from `near`, which is as good as 1e-6 where it changes by a hundredth; else anew.
  static double cube_root(double cube, double near)
  {
    const double of_near = near * near * near, root = near * (of_near + 2.0 * cube) / (2.0 * of_near + cube);
    return std::abs(root - near) < 0.01 * near ? root : std::cbrt(cube);
  }

  /// Parted: beyond this tilt the dent's rim would touch, around which the body is a sphere again.
  void end_tilt()
  {
    const double tilt = norm(held_.tilt), rim = (start_.depth - start_.residual) / start_.radius;
    if (tilt > rim) held_.tilt = times(held_.tilt, rim / tilt);
  }

  Tilting tilting(const Dent& dent) const { return {dent, material_.e_star, step_.radius}; }
  /// A dent nearly as deep as the first is linear in its depth.
  Tilting dent_of(double depth)
  {
    const double more = depth - start_.depth, most = linear * start_.depth;
    if (more == 0.0) return start_;
    if (std::abs(more) > 2.0 * most) return tilting(dent_at_(depth));
    if (!deeper_) deeper_ = tilting(dent_at_(start_.depth + std::copysign(most, more)));
    return start_.toward(*deeper_, more / (deeper_->depth - start_.depth), depth);
  }

  /// A way to flow, by its amount.
  struct Path
  {
    Vector tilt;                      // at its beginning
    Vector toward{};                  // which turns, a unit vector
    double deepening, turning, moved;  // per amount: of the depth, of the tilt, and volume over the contact's area
    double back = 0;                  // what the spring gets back of the turning, per amount
  };
  struct Point
  {
    double amount = 0, excess = 0;          // N, of F beyond yield
    double pull = 0, slid = 0, spring = 0;  // T, sliding of the flow, and T if nothing had slid
  };

  /// N, of F beyond yield; `lean`: phi' of (3).
  double excess(const Tilting& dent, const Answer& e, double lean, double share) const
  {
    return e.force - DiscSegment::area_of(e.arm / dent.radius * lean) * share * dent.force;
  }

  Point at(const Path& path, double amount)
  {
    const double turned = path.turning * amount, leant = dot(path.tilt, path.toward);
    const Tilting& dent = *(dent_ = dent_of(std::max(held_.depth + path.deepening * amount, step_.overlap)));
    const double tilt2 = dot(path.tilt, path.tilt) + turned * (turned - 2.0 * leant);
    const Answer& e = answer_ = dent.answer(step_.overlap, tilt2, answer_.share, nearly);
    const double per_strength = 1.0 / strength_, give = path.moved * amount * start_.force * per_strength;
    Point now{.amount = amount, .spring = std::max(0.0, stretched_ + k_ * path.back * amount)};
    ShearYield::Point shear = shear_ = shear_.under(now.spring * per_strength, k_ * give * per_strength, roughly);
    now.pull = strength_ * shear.q, now.slid = (now.spring - now.pull) / k_;
    if (const double most = material_.friction * e.force; now.pull > most) {
      now.pull = most, shear = ShearYield::Point(ShearYield::tau_of(most * per_strength));
      now.slid = give * shear.fall;
    }
    now.excess = excess(dent, e, leant - turned + shift_ * now.pull * dot(along_, path.toward), shear.share);
    return now;
  }
  /// State at the last point asked for.
  DentState state(const Path& path, const Point& point) const
  {
    const Vector tilt = sum(path.tilt, path.toward, -path.turning * point.amount);
    return {.force = answer_.force,
            .moment = dent_->moment(answer_),
            .depth = dent_->depth,
            .pull = point.pull,
            .slid = point.slid,
            .energy = dent_->energy(answer_, dot(tilt, tilt)) + 0.5 * point.pull * point.pull / k_,
            .rubbed = point.pull * std::max(0.0, (point.spring - point.pull) / k_ - point.slid),
            .lost = 0.5 * (start_.force + dent_->force) * (dent_->depth - start_.depth) - (dent_->work() - start_.work()),
            .tilt = tilt,
            .flows = true};
  }

  /// Places on a path: from T_0 on the force falls as the root of the flow (s - 1 + c as its power m/(2 - 2 m) = 0.54).
  double amount(double place) const { return steep_ ? place * place : place; }
  double place(double amount) const { return steep_ ? std::sqrt(amount) : amount; }

  /// `lean`: phi' before, of this length; `bears`: what bears there; `cut`: T. Not inlined: a loop over contacts that holds
  /// the search takes three times as long to compile, and is no faster.
  [[gnu::noinline]] DentState flow(const Vector& lean, double leans, const DiscSegment& bears, double cut)
  {
    const double a = start_.radius;
    const Vector upright = times(along_, -shift_ * std::min(cut, strength_));
    const double needed = a * norm(sum(held_.tilt, upright, -1.0));  // to stand upright
    Point end;
    // where a segment alone moves in, the corner lies beyond: it is tried first where the turning is small
    if (needed > step_.deepening) {
      const Vector toward = leans > 0.0 ? times(lean, 1.0 / leans) : Vector{};
      const double rolled = dot(step_.turn, toward);
      const DentFlow plane = DentFlow::of(bears, rolled > 0 ? -step_.deepening / (a * rolled) : -1.0);
      const Path segment{held_.tilt, toward, plane.deepening * a, plane.turning, plane.mean * a,
                         material_.asymmetry * pressure_shift * a * plane.turning * dot(along_, toward)};
      const double pull = std::min(cut, strength_);
      end = {.excess = excess(start_, answer_, leans + shift_ * (pull - cut) * dot(along_, toward), ShearYield::share(pull / strength_))};
      const double most = leans / plane.turning, steady = std::max(rolled, step_.deepening / a) / plane.turning;
      if (!(end.excess > 0)) return state(segment, at(segment, 0.0));
      if (root(segment, end, std::max(steady, 1e-3 * most), most, end)) return state(segment, end);
    }
    const Path corner{.tilt = upright, .deepening = 1.0, .turning = 0.0, .moved = 1.0};
    end = at(corner, needed);
    if (end.excess > within_) {
      const double steady = std::max({needed, std::abs(step_.deepening), 1e-6 * held_.depth});
      root(corner, end, steady, std::numeric_limits<double>::infinity(), end);
    } else if (end.excess < -within_) {
      const Point none = at(corner, 0.0);
      end = none.excess > 0 ? between(corner, none, end) : none;
    }
    return state(corner, end);
  }

  /// `found`: the point of no excess on a path where it falls: from `low`, where it is positive, by steps from `width` on
  /// to `most`. False: there is none.
  bool root(const Path& path, Point low, double width, double most, Point& found)
  {
    const double end = place(most);
    width = place(width);
    for (int tripling = 0; tripling < 60 && place(low.amount) < end; ++tripling, width *= 3.0) {
      found = at(path, amount(std::min(place(low.amount) + width, end)));
      if (found.excess <= within_) {
        found = between(path, low, found);
        return true;
      }
      low = found;
    }
    return false;
  }
  /// The same between two points: through the last three by inverse interpolation of the second order where that is
  /// monotonic (Chandrupatla, Adv. Eng. Software 28, 1997), else by the rule of Illinois.
  Point between(const Path& path, const Point& low, const Point& high)
  {
    Point now = high;
    double x = place(high.amount), f = high.excess, other = place(low.amount), across = low.excess, stale = 1.0;
    double third = x, at_third = f;
    for (int step = 0; step < 60 && std::abs(f) > within_; ++step) {
      const double place = (x - other) / (third - other), rise = (f - across) / (at_third - across);
      double part = f / (f - stale * across);
      if (step > 0 && rise * rise < place && (1.0 - rise) * (1.0 - rise) < 1.0 - place)
        part = f / (across - f) * at_third / (across - at_third) +
               (third - x) / (other - x) * f / (at_third - f) * across / (at_third - across);
      if (!(part > 0.0 && part < 1.0)) break;
      const double middle = x + part * (other - x);
      now = at(path, amount(middle));
      third = x, at_third = f;
      stale *= 0.5;
      if ((now.excess > 0) != (f > 0)) std::swap(third, other), std::swap(at_third, across), stale = 1.0;
      x = middle, f = now.excess;
    }
    return now;
  }

  const DentMaterial& material_;
  const DentAt& dent_at_;
  Tilting start_;
  DentMemory& held_;
  const DentMotion& step_;
  double force_;                          // near that of the dent
  std::optional<Tilting> deeper_, dent_;  // on the line of dent_of; of the last point
  Answer answer_{};                       // of the last point: the next one begins there
  ShearYield::Point shear_{std::numeric_limits<double>::infinity()};  // likewise
  double k_ = 0, stretched_ = 0;  // of the spring: N/m, and its force before the flow
  Vector along_{};
  double shift_ = 0;              // of the axis, per T
  double strength_ = 0;           // T_0
  double within_ = 0;             // excess at which the search ends
  bool steep_ = false;            // T before the flow is above T_0
};

}  // namespace granulaw
