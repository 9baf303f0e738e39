#pragma once

#include <fmt/format.h>

#include <string>

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

/// What the atlas claims: relative of force, absolute of e.
inline std::string atlas_errors_text(const Certificate& c)
{
  return fmt::format("force within {}, e within {:.2g}", percent(c.atlas_error_force),
                     c.atlas_error_restitution);
}

}  // namespace granulaw
