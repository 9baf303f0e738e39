#pragma once

#include <algorithm>
#include <cmath>

#include "contact/contact.hpp"
#include "contact/normal.hpp"
#include "contact/vector.hpp"

// A dent as a facet of its body that is pressed, sheared and turned: its elastic state, its yield, and one step of its
// flow. docs/theory/oblique.md has the equations by their numbers.
namespace granulaw {

/// Numbers of two bodies whose contact yields in shear.
struct FacetMaterial
{
  double shear_stiffness = 0;  ///< Pa, 8 G*: k_t over the contact radius
  double asymmetry = 1;        ///< of BodiesInShear
  double friction = 0;
  FlowStress flow_stress;

  /// Pa, T_0 over the area that bears; (4). `steepness`: a_m/R; `area`: a^2.
  double strength(double steepness, double area, double sheared) const
  {
    const double ratio2 = steepness * steepness;
    double stress = flow_stress.yield;
    if (flow_stress.hardens())
      stress = flow_stress.at(std::sqrt(tabor_strain * tabor_strain * ratio2 +
                                        shear_strain * shear_strain * sheared * sheared / area));
    return widening * (1.0 - ratio2) * stress;
  }

 private:
  static constexpr double widening = 1.47 * M_PI / 1.7320508075688772;  // of T_0 over Y pi a^2/sqrt(3), fitted
  static constexpr double tabor_strain = 0.2;  // of the indentation, times a/R: Tabor, The Hardness of Metals (1951)
  static constexpr double shear_strain = 1.0;  // of the shear, times its sliding over a, fitted
};

/// Yield of a contact under a shear of q = T/T_0: F = s(q) F_m. Half of F_m is left at T_0, as by slip lines under a flat
/// punch that slides. The slope stays finite there, so that a step of the flow has a tangent.
struct ShearYield
{
  double share, fall, curve;  ///< s, -ds/dq, -d2s/dq2

  static double share_at(double q2) { return 1.0 - q2 * (early + late * (q2 * q2 * q2)); }
  static ShearYield at(double q)
  {
    const double q2 = q * q, q6 = q2 * q2 * q2;
    return {1.0 - q2 * (early + late * q6), q * (2.0 * early + 8.0 * late * q6), 2.0 * early + 56.0 * late * q6};
  }

 private:
  static constexpr double early = 0.23, late = 0.27;  // fitted; their sum is 1/2
};

/// Motion of the real contact in a step: lengths in m, turning in rad.
struct FacetMotion
{
  double radius, overlap, deepening;  // R*
  Vector slide, rolling;

  /// One of `all` equal parts.
  FacetMotion part(int which, int all) const
  {
    const double one = 1.0 / all;
    return {radius, overlap - deepening * (all - which) * one, deepening * one, times(slide, one), times(rolling, one)};
  }
};

/// Spring and tilt of a contact between two steps, and its depth.
struct FacetMemory
{
  Vector pull;       ///< N, of the spring
  double stiffness;  ///< N/m, of the spring in the last step; 0: apart
  Vector tilt;       ///< rad
  double sheared;    ///< m, sliding of the flow
  double depth;      ///< m

  double spring_energy() const { return stiffness > 0 ? 0.5 * dot(pull, pull) / stiffness : 0.0; }
  /// The spring, N, moved at this stiffness. One that stiffens keeps its force, one that softens its stretch: neither
  /// gives energy.
  Vector stretched(const Vector& slide, double k) const
  {
    return sum(times(pull, k < stiffness ? k / stiffness : 1.0), slide, k);
  }
  /// J, that a spring and its friction took in a step after which it pulls by this force.
  double taken(const Vector& slide, const Vector& pulls, double k) const
  {
    return spring_energy() + 0.5 * (dot(pull, slide) + dot(pulls, slide)) - 0.5 * dot(pulls, pulls) / k;
  }
};

/// A dent as a facet of its body, at a tilt and an overlap, pulled by its spring; (1), (2).
template <class Dent>
struct Facet
{
  Dent dent;
  Vector tilt{};         ///< rad, phi
  double curvature;      ///< m, r: of the unloaded dent
  double lift;           ///< m, l: of the body's centre over phi^2/2
  double part = 0;       ///< u; not positive: the surfaces have parted
  double force = 0;      ///< N, F
  double stiffness = 0;  ///< N/m, k_t; 0: parted
  Vector pull{};         ///< N, T

  Facet(const Dent& below, double r_eff, const Vector& tilted)
      : dent(below), tilt(tilted), curvature(below.radius * below.radius * below.per_span), lift(curvature - (r_eff - below.residual()))
  {
  }
  void press(double overlap, double shear_stiffness)
  {
    press_to(dent.part(overlap + 0.5 * lift * dot(tilt, tilt)), shear_stiffness);
  }
  void press_to(double u, double shear_stiffness)
  {
    part = u;
    if (!(part > 0)) return;
    force = dent.force_of(part), stiffness = shear_stiffness * dent.radius * std::sqrt(part);
  }
  bool touches() const { return part > 0; }
  Vector moment() const { return times(tilt, force * lift); }  ///< N m, M, in the direction of the tilt
  /// J, that the contact holds.
  double energy() const { return touches() ? dent.work_of(part) + 0.5 * dot(pull, pull) / stiffness : 0.0; }
  FacetMemory memory(double sheared) const { return {pull, stiffness, tilt, sheared, dent.depth}; }
};

/// Forces of a facet and the energy that it holds: what the books ask of a state.
struct FacetLoads
{
  double force = 0;         ///< N
  Vector moment{}, pull{};  ///< N m, N
  double energy = 0;        ///< J

  FacetLoads() = default;
  template <class Dent>
  explicit FacetLoads(const Facet<Dent>& of) : force(of.force), moment(of.moment()), pull(of.pull), energy(of.energy())
  {
  }
  /// J, that a step which ended here took of a contact with these loads before.
  double taken(const FacetLoads& before, const FacetMotion& step) const
  {
    return before.energy - energy + 0.5 * ((before.force + force) * step.deepening + dot(sum(before.pull, pull), step.slide) +
                                           dot(sum(before.moment, moment), step.rolling));
  }
};

/// A facet after the motion of a step, its depth as before: the state unless it yields; (3), (4).
template <class Dent>
struct FacetTrial : Facet<Dent>
{
  double spring = 0;    ///< N, T if nothing slid
  double pulls = 0;     ///< N, T
  double shift = 0;     ///< rad/N, of phi' by T
  Vector lean{};        ///< rad, phi'
  double leans = 0;     ///< its length
  double bears = 1;     ///< alpha
  double strength = 0;  ///< N, T_0
  bool yields = false;

  FacetTrial(const Dent& below, const FacetMaterial& material, const FacetMemory& last, const FacetMotion& step)
      : Facet<Dent>(below, step.radius, sum(last.tilt, step.rolling))
  {
    if (!(last.stiffness > 0)) end_tilt();
    this->press(step.overlap, material.shear_stiffness);
    if (!this->touches()) return;
    this->pull = last.stretched(step.slide, this->stiffness);
    spring = pulls = norm(this->pull);
    if (const double most = material.friction * this->force; spring > most)
      this->pull = times(this->pull, most / spring), pulls = most;
    shift = material.asymmetry * pressure_shift * this->stiffness / (material.shear_stiffness * this->force * this->curvature);
    lean = sum(this->tilt, this->pull, shift), leans = norm(lean);
    bears = bearing(leans);
    const double area = this->dent.radius * this->dent.radius;
    strength = material.strength(this->dent.steepness, area * this->part, last.sheared) * area *
               std::min(this->part, std::max(bears, least_bearing));
    const double q = pulls / strength;
    yields = q > 1.0 + tolerance || this->force > (bears * ShearYield::share_at(q * q) + tolerance) * this->dent.force;
  }

  /// Part of the area that bears at a |phi'|: half of a half disc. Linear, and left to become negative.
  double bearing(double lean_now) const { return 1.0 - bearing_slope() * lean_now; }
  double bearing_slope() const { return 3.0 * M_PI / 8.0 * this->dent.radius * this->dent.per_span; }

 private:
  static constexpr double pressure_shift = 0.22;  // zeta, fitted: T moves the pressure back by zeta a T/F
  static constexpr double tolerance = 1e-3;       // of F_m and T_0, in the yield condition: e and spin change by less than 1e-3
  static constexpr double least_bearing = 0.05;   // of T_0, which is a divisor

  /// Parted: beyond this tilt the dent's rim would touch, around which the body is a sphere again.
  void end_tilt()
  {
    const double rim = this->dent.span / this->dent.radius, tilted = norm(this->tilt);
    if (tilted > rim) this->tilt = times(this->tilt, rim / tilted);
  }
};

/// Flow of a facet in one step. Its amount follows from one linear equation, from the shear before the step on (6).
template <class Dent>
class FacetFlow
{
 public:
  double deeper = 0;  ///< m, of the depth
  Vector turned{};    ///< rad, of the tilt
  double pull = 0;    ///< N, T
  double slid = 0;    ///< m, sliding of the flow

  FacetFlow(const FacetTrial<Dent>& facet, const FacetMaterial& material, const FacetMemory& last, const FacetMotion& step)
      : facet_(facet), friction_(material.friction), per_strength_(1.0 / facet.strength)
  {
    const Dent& dent = facet.dent;
    const double a_m = dent.radius, a = a_m * std::sqrt(facet.part);
    const double give = facet.stiffness * dent.force * per_strength_ * per_strength_;
    before_ = std::min(1.0, norm(last.stretched({}, facet.stiffness)) * per_strength_);
    tried_ = facet.spring * per_strength_;
    give_ = give, begun_ = give * std::max(0.0, dent.depth - last.depth);
    // the tilt at which phi' is 0
    const Vector upright = times(facet.pull, -facet.shift * std::min(1.0, facet.strength / facet.pulls));
    const Vector away = sum(facet.tilt, upright, -1.0);
    if (!(step.deepening >= a * norm(away))) {
      const Vector toward = facet.leans > 0.0 ? times(facet.lean, 1.0 / facet.leans) : Vector{};
      const double rolled = dot(step.rolling, toward);
      const Path segment = segment_of(a_m, std::max(0.0, facet.leans - std::max(0.0, rolled)), rolled > 0 ? -step.deepening / (a * rolled) : -1.0);
      const double amount = move(segment, facet.force, facet.bears);
      if (amount < facet.leans) {
        turned = times(toward, -amount);
        return;
      }
    }
    const double less = 0.5 * facet.lift * (dot(facet.tilt, facet.tilt) - dot(upright, upright));
    const double standing = facet.force - dent.slope_of(facet.part) * less;
    double part = 1.0;
    if (!(move({1.0, 0.0, 1.0}, standing, 1.0) > 0)) {  // upright it would bear more: it turns until it flows no longer
      const double most = dent.force * ShearYield::share_at(pull * pull * per_strength_ * per_strength_);
      part = standing < facet.force ? std::clamp((facet.force - most) / (facet.force - standing), 0.0, 1.0) : 0.0;
    }
    turned = times(away, -part);
  }

 private:
  /// A way to flow, by its amount.
  struct Path
  {
    double deepening, turning, volume;  ///< of the depth, back of the tilt, and over the contact's area
  };
  /// A segment of the disc moves in, as a plane (5); `onset`: eta.
  Path segment_of(double a_m, double lean, double onset) const
  {
    const double bears = std::max(facet_.bearing(lean), least_bearing), edge = 1.0 - 2.0 * bears;
    const double beyond = std::max(0.0, std::min(onset, latest_onset) - edge), moves = bears / (bears + 1.15 * beyond);
    return {(-edge - beyond * moves) * a_m, 1.0, 0.87 * bears * moves * a_m};
  }

  /// Flows along the path from a force at the trial's shear; its amount.
  double move(const Path& path, double start, double bears)
  {
    const Dent& dent = facet_.dent;
    const double u = facet_.part, full = bears * dent.force;
    const double falls = dent.slope_of(u) * ((1.0 - dent.growth * (1.0 - u) * dent.span / dent.depth) * path.deepening +
                                             facet_.lift * facet_.leans * path.turning);
    const ShearYield yield = ShearYield::at(before_);
    const double rate = falls + facet_.bearing_slope() * path.turning * yield.share * dent.force;
    const double over = start - full * yield.share, give = give_ * path.volume;
    const double within = 1.0 / (1.0 + (begun_ + give * std::max(0.0, over / rate)) * yield.curve);
    const double steep = full * yield.fall * within;
    double amount = std::max(0.0, (over + steep * (tried_ - before_ - begun_ * yield.fall)) / (rate + steep * yield.fall * give));
    const double gives = begun_ + give * amount;
    double q = before_ + (tried_ - before_ - gives * yield.fall) / (1.0 + gives * yield.curve);
    q = std::clamp(q, 0.0, std::min(tried_, 1.0));
    amount = std::max(0.0, (start - full * ShearYield::share_at(q * q)) / rate);
    slid = (tried_ - q) / (per_strength_ * facet_.stiffness);
    if (q > friction_ * per_strength_ * (start - falls * amount)) {
      const double rub = friction_ * per_strength_, slope = full * yield.fall;
      amount = std::max(0.0, (over + slope * (rub * start - before_)) / (rate + slope * rub * falls));
      q = std::clamp(rub * (start - falls * amount), 0.0, 1.0);
      slid = std::min(slid, gives * yield.fall / (per_strength_ * facet_.stiffness));
    }
    pull = q / per_strength_, deeper = path.deepening * amount;
    return amount;
  }

  static constexpr double least_bearing = 0.02;  // where less bears, the direction of the flow hardly changes
  static constexpr double latest_onset = 0.95;   // likewise

  const FacetTrial<Dent>& facet_;
  double friction_, per_strength_;
  double before_ = 0, tried_ = 0;  // q before the step, and of the spring after it
  double give_ = 0, begun_ = 0;    // spring's fall over T_0 and |ds/dq|: per depth, and by what the normal law has flowed
};

}  // namespace granulaw
