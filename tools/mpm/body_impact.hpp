#pragma once

#include "run_report.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// Thrown at the wall. Where the body is eccentric e and the works of the summary are those of the contact:
/// the velocities of its centre do not give them.
RunResult body_impact(const Particle& particle, const Approach& thrown, const Partner& partner, const RunOptions& options, CentreMotion& centre);

}  // namespace granulaw
