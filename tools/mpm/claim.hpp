#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "law/law.hpp"

namespace granulaw {

/// Errors that a law states for one collision, relative: 95 % of impacts lie within.
struct Claim
{
  double force = 0;        ///< of F_max
  double restitution = 0;  ///< of e

  /// With an error of another cause: independent ones add as squares.
  Claim with(double other_force, double other_restitution) const
  {
    return {std::hypot(force, other_force), std::hypot(restitution, other_restitution)};
  }
};

/// What a certificate states for a collision whose coefficient of restitution is `e`.
/// - A yielding body of the atlas: the bound of its checks (docs/evidence/atlas.md). These are fresh impacts,
/// so it
///   holds whatever the solver's runs, the fit, the interpolation and the table leave.
/// - A pair's law composed of its bodies': the bound of two-body impacts that took no part
/// (docs/evidence/pairs.md);
///   corrected by impacts of the two bodies: as by runs, each impact left out in turn.
/// - A body by runs: what its verification found, impacts that took no part in the fit at the cells of those
///   that did; and what these cells cost (grid_convergence.hpp). Without impacts, what fit and table leave.
inline Claim claim_of(const Certificate& c, double e)
{
  const bool elastic = std::isinf(c.damage_number_max);
  const Claim atlas{c.atlas_error_force, c.atlas_error_restitution / e};
  const bool composed = c.origin == composed_origin && c.verification_impacts == 0;
  if ((c.origin == "atlas" && !elastic) || composed) return atlas;
  const Claim fitted = c.verification_impacts > 0
                           ? Claim{c.verification_error_force, c.verification_error_restitution}
                           : atlas.with(c.interpolation_error, c.held_out_error);
  return fitted.with(c.solver_error_force, c.solver_error_restitution);
}

/// A relative error in per cent.
inline std::string percent(double error)
{
  return fmt::format("{:.2g} %", 100 * error);
}

/// Two relative errors, for a sentence.
inline std::string errors_text(double force, double restitution)
{
  return fmt::format("force within {}, e within {}", percent(force), percent(restitution));
}

/// What the atlas, or a composed law, claims: relative of force, absolute of e.
inline std::string atlas_errors_text(const Certificate& c)
{
  return fmt::format("force within {}, e within {:.2g}", percent(c.atlas_error_force),
                     c.atlas_error_restitution);
}

/// What a composed law claims, corrected by impacts or not.
inline std::string composed_errors_text(const Certificate& c)
{
  if (c.verification_impacts == 0) return atlas_errors_text(c);
  const Claim claim = claim_of(c, 1.0);
  return errors_text(claim.force, claim.restitution);
}

}  // namespace granulaw
