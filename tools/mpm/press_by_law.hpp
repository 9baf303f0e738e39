#pragma once

#include "law/law.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// The press of a sphere by planes as granulaw::press() has it, by the law of its contact with the rigid wall. `radius`: m. Throws
/// Error where a plane has friction, or the body is elastic or of unknown flow stress.
RunResult press_by_law(const PairLaw& wall, double radius, const PressPlan& plan);

}  // namespace granulaw
