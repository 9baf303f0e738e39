#pragma once

#include "law/law.hpp"

namespace granulaw {

/// Errors that a law states for one collision, relative.
struct Claim
{
  double force = 0;        ///< of F_max
  double restitution = 0;  ///< of e
};

/// What the certificate claims against fresh impacts of the solver, and the solver's own error, for a
/// collision whose coefficient of restitution is `e`.
inline Claim claim_of(const Certificate& c, double e)
{
  return {c.verification_error_force + c.atlas_error_force + c.solver_error_force,
          c.verification_error_restitution + c.atlas_error_restitution / e + c.solver_error_restitution};
}

}  // namespace granulaw
