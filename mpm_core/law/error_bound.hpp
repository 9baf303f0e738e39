#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "law/law.hpp"

namespace granulaw {

/// Error bound of a law against the exact result of the same impact: 95 % of impacts lie within. 0 0 0:
/// not stated.
struct ErrorBound
{
  double force = 0;                 ///< of F_max, relative
  double restitution = 0;           ///< of e, absolute
  double relative_restitution = 0;  ///< of e, relative: laws by runs state it so
  /// Cost of a velocity axis that the law lacks, by speed: at() adds it.
  std::vector<AxisCost> omitted_axis{};
  double axis_restitution = 0;  ///< of e, relative: that cost at one speed

  bool stated() const { return force > 0 || restitution > 0 || relative_restitution > 0; }
  /// The same of an impact at the speed `v` of the velocity axis (PairLaw::axis_speed). The cost is a known difference,
  /// no chance: it adds in full.
  ErrorBound at(double v) const;
  /// Absolute error bound of e for an impact whose coefficient of restitution is `e`.
  double restitution_at(double e) const
  {
    return axis_restitution * e + std::hypot(restitution, relative_restitution * e);
  }
  /// With an error of another cause: independent ones add as squares.
  ErrorBound with(const ErrorBound& other) const;
  /// The larger of each; none where one is not stated.
  ErrorBound worst(const ErrorBound& other) const;
  /// "F_max 0.72 %, e 0.0028"; a relative error of e has its per cent sign. "not stated". Without its axis:
  /// "F_max 0.72 %, e 0.0028, rising with speed to F_max 8 %, e 0.0028 and 7.3 %".
  std::string text() const;
};

/// Part of the error of an elastic sphere's law, by its swinging in an impact, over V/c*: V its part of the approach,
/// c* = sqrt(E*/rho). The largest of 21 impacts (docs/evidence/atlas.md).
struct ElasticSwing
{
  double force, restitution;
};
inline constexpr ElasticSwing elastic_swing{2.7, 0.35};

/// Bound of a law used for what it was made for: the law's error, and that of the solver's cells
/// (solver_error_* of the certificate). The law's error is
/// - from the atlas, that of its checks near this E*/Y (docs/evidence/atlas.md). These are fresh impacts, so it
///   includes the atlas's own runs, fit, interpolation and table;
/// - composed of the two bodies' laws, that of two-body impacts that took no part in the rule
///   (docs/evidence/pairs.md). The solver's error is the larger one of the two bodies' laws;
/// - by runs, or corrected by impacts, the largest error of its verification, impacts that took no part in the
///   fit. Without impacts, the errors of fit and table.
/// Without a velocity axis that the law lacks (ErrorBound::omitted_axis).
ErrorBound bound_of(const Certificate& certificate);
/// The same of a body's law. Of a particle with a shape: that of its orientations, each compared with a fresh
/// impact.
ErrorBound bound_of(const BodyLaw& body);

/// Largest distance in R_s/(R_s + R_h) between a contact and its law for which bound_of() holds: half a step
/// of the laws that are made (characterise/law_file_plan.cpp).
inline constexpr double size_share_step = 0.025;
/// Further error of a law used at a distance `off` in R_s/(R_s + R_h). Within size_share_step none; that far
/// F changes by 0.4 % and e by 0.002 at most, and beyond in proportion.
ErrorBound size_error(double off);

/// Origin of a pair's law.
enum class LawKind {
  single,     ///< of one body: a rigid wall, like bodies of like size
  two_body,   ///< from runs of the two bodies
  composed,   ///< of the two bodies' laws
  corrected,  ///< composed, then corrected by impacts of the two bodies
  reduced     ///< of the yielding body, by the pair rule (contact/pair.hpp)
};
/// "single", "two-body", "composed", "corrected", "reduced".
const char* name_of(LawKind kind);

/// The statement of a law file about one pair: one function for `mpm table`, `mpm law`, `mpm info` and the
/// plug-in.
struct PairStatement
{
  LawKind kind = LawKind::single;
  ErrorBound bound;     ///< none is stated of unlike bodies by the pair rule
  double covered = 1;   ///< of a particle with a shape: part of the orientations that the bound is of
  double size_off = 0;  ///< distance of the contact from its law in R_s/(R_s + R_h)
  /// Largest damage number (damage_number.hpp) for which the bound holds.
  double damage_number_max = std::numeric_limits<double>::infinity();

  bool covers_size() const { return size_off <= size_share_step * (1 + 1e-9); }
  /// The same law at a distance in R_s/(R_s + R_h). None is measured of a two-body law.
  PairStatement at_distance(double off) const;
};

/// Statement of a law that resolve_pair() gave for `a` and `b`, at its ratio of radii.
PairStatement statement_of(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b);
/// Distance in R_s/(R_s + R_h) of bodies of these radii (m, or both in another unit; infinity: a thick
/// deformable wall) from that law; 0 at a rigid wall.
double distance_in_size(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b,
                        double radius_a, double radius_b);

}  // namespace granulaw
