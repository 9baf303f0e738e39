#pragma once

#include <algorithm>
#include <vector>

#include "atlas/law_range.hpp"
#include "atlas/body_numbers.hpp"
#include "law/law_shape.hpp"
#include "atlas/pair_body.hpp"
#include "atlas/unlike_pair.hpp"
#include "law/law.hpp"

namespace granulaw {

/// A pair of spheres at one radius of their contact. Units of the bodies: Pa, and their radii's.
struct ComposedState
{
  double contact_radius = 0;
  double force = 0;
  double overlap = 0, recovered = 0;  ///< recovered: on complete unloading
  double unloading_work = 0.4;        ///< given back, over force times recovered overlap
  PairBody::Unloading unloading{1};
  double flatness = 0;                ///< of the pressure (PressureShape)
  double log_yield_overlap = 0;       ///< of the body that is further beyond its first yield
  bool known = true;
};

/// The law of two unlike spheres, or of a sphere and a deformable wall, from what the atlas holds of each
/// alone: no run.
///
/// At a contact radius a the two bodies share the interface's curvature, kappa_s + kappa_h = a/R*, the mean
/// pressure and the pressure's shape. Each is an equivalent sphere (PairBody) whose own pressure has another
/// shape: under the common one
///     p       = p_twin strength(common)/strength(own)                       it yields as much as the
///     equivalent sphere kappa   = kappa_twin + 2 pi/E* [sag(common) p - sag(own) p_twin]       its elastic
///     surface curves otherwise overlap = that of the equivalent sphere + pi a/E* [displacement(common) p -
///     displacement(own) p_twin]
///               - k pi a^2 (p - p_twin)/(E* R)                               the finite sphere's
/// The work that each gives back changes as the overlap does, with PressureShape::work.
/// The common shape follows from the residual over the recovered overlaps of both. An elastic body yields
/// nothing: the second line then says what curvature a flatter pressure gives it. Measured against two-body
/// impacts: docs/theory/pairs.md.
class ComposedPair
{
 public:
  /// Radii in one unit; infinity: a deformable wall. The bodies outlive this.
  ComposedPair(const PairBody& yielding, double radius, const PairBody& partner, double partner_radius);

  ComposedState at(double contact_radius) const;
  /// Contact radius at which the first of the two begins to yield; infinity: neither does.
  double yield_radius() const { return yield_radius_; }
  double r_eff() const { return r_eff_; }
  double smaller_radius() const { return std::min(radius_, partner_radius_); }

 private:
  double find_yield_radius() const;

  const PairBody &first_, &second_;
  double radius_, partner_radius_, r_eff_, yield_radius_;
};

/// Errors that 95 % of collisions by a composed law lie within.
struct ComposedError
{
  double force = 0, restitution = 0;  ///< of composing, against impacts of the two bodies: of F_max relative, of e absolute
  double solver = 0;                  ///< of the bodies' laws, of F and e, relative: the larger of the two
};
/// Fitted to the 95th percentiles of two-body impacts against stiffer, like and softer partners
/// (docs/theory/pairs.md). `e_star_ratio`: the partner's E* over the yielding body's.
ComposedError composed_error(double e_star_ratio);

/// Damage number up to which impacts of two bodies have shown that a composed law keeps its error. Of spheres
/// v^2 = 0.003, v of the velocity axis. The inertia of the partner is not modelled, nor the waves that leave into a
/// wall while the force rises: its own damage number, by its fraction of the approach, measures both: 0.003, too. A
/// stiff partner's stays small at any speed.
double composed_damage_number(const UnlikePair& pair);

/// sqrt(I) up to which speed changes nothing: an impact shows the rate-independent law.
inline constexpr double slow_speed = 0.02;

/// Input of the tabulation of a yielding pair's law.
struct ComposedShape
{
  LawMaterial material;    ///< the yielding body's
  double radius_ratio;     ///< as in TwoBodyLaw
  LawShape shape;          ///< in the pair rule's coordinates (contact/pair.hpp)
  BodyNumbers body;  ///< the yielding one, with the pair's onset
  double end;              ///< overlap where the shape ends
  ComposedError stated;
  double damage_number_max;  ///< up to which impacts have shown that error to hold
  double speed_ratio;        ///< UnlikePair::axis_speed_ratio()
};

/// The shape of a pair that yields at this ratio of the partner's radius to the yielding body's; infinity:
/// the partner is a deformable wall; 0: the yielding body is. Velocity effects are those of the yielding
/// body. range: depth, fastest. Throws Error where it begins to yield too near to where the atlas ends.
ComposedShape compose_shape(const Atlas& atlas, const PairBody& yielding, const PairBody& partner,
                            double radius_ratio, const LawRange& range);

/// Its law, with its velocity axis. range: fastest. Throws Error where it would not be admissible.
TwoBodyLaw law_of(const ComposedShape& composed, const LawRange& range);

/// Leaves the axis out where it changes no collision of the two bodies by more than the tolerance (finish_curve.hpp).
void leave_out_axis(TwoBodyLaw& law, const LawMaterial& partner, double tolerance);

/// The law of any pair. As the three above.
TwoBodyLaw compose_law(const Atlas& atlas, const PairBody& yielding, const PairBody& partner,
                       double radius_ratio, const LawRange& range);

}  // namespace granulaw
