#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace granulaw {

/// Cost, at one speed, of the velocity axis that a law was made without; of F_max and of e, without the axis
/// over with it, less 1 (signed).
struct AxisCost
{
  double speed = 0;  ///< v of the axis (AxisTable)
  double force = 0, restitution = 0;
};

/// Largest distance in R_s/(R_s + R_h) between a contact and its law for which the law's bound holds: half a
/// step of the laws that are made (characterise/file/law_file_plan.cpp). That far F changes by 0.4 % and e by
/// 0.002 at most.
inline constexpr double size_share_step = 0.025;

/// Error bound of a law against the exact result of the same impact: 95 % of impacts lie within. 0 0 0: not
/// stated. Whoever makes a law states it, whoever changes the law widens it; a law file holds it.
struct ErrorBound
{
  double force = 0;                 ///< of F_max, relative
  double restitution = 0;           ///< of e, absolute
  double relative_restitution = 0;  ///< of e, relative: laws by runs state it so
  /// Cost of a velocity axis that the law lacks, by speed: at() adds it.
  std::vector<AxisCost> omitted_axis{};
  double axis_restitution = 0;  ///< of e, relative: that cost at one speed
  /// Further error of an elastic sphere, which swings in an impact, over V/c*: V its part of the approach, c*
  /// = sqrt(E*/rho).
  double swing_force = 0, swing_restitution = 0;
  /// Further error at another size, over the distance in R_s/(R_s + R_h); infinity: none is known.
  double size_force = 0.004 / size_share_step, size_restitution = 0.002 / size_share_step;
  /// Further error of F, relative, where other contacts press the particle as well; infinity: none is stated.
  double confined_force = std::numeric_limits<double>::infinity();

  bool stated() const { return force > 0 || restitution > 0 || relative_restitution > 0; }
  /// The same of an impact at the speed `v` of the velocity axis (PairLaw::axis_speed). The cost is a known
  /// difference, no chance: it adds in full.
  ErrorBound at(double v) const;
  /// The same at a distance in R_s/(R_s + R_h) from the law's size.
  ErrorBound at_size(double off) const;
  /// The same of an impact in which an elastic sphere has this V/c*.
  ErrorBound at_swing(double v) const { return with({swing_force * v, swing_restitution * v}); }
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

}  // namespace granulaw
