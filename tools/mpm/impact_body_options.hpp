#pragma once

#include "base/impact_body.hpp"
#include "option_checks.hpp"
#include "options.hpp"

namespace granulaw {

/// --impact-body-mass and --impact-body-compliance; `sphere`: "the particle".
inline void define_impact_body(Options& command, ImpactBody& body, const std::string& sphere)
{
  command
      .add_option("--impact-body-mass", body.mass,
                  "kg, of " + sphere + " with what it is fixed to: a holder, a pendulum, a tester's body (default: it is free)")
      .check(above_zero());
  command
      .add_option("--impact-body-compliance", body.compliance,
                  "m/N, of what " + sphere + " is fixed to: it stores compliance F^2/2 and gives it back (default 0)")
      .check(above_zero());
}

}  // namespace granulaw
