#pragma once

#include <string>

#include "calibrate/calibrate.hpp"

namespace granulaw {

/// [material.NAME] as `mpm table` reads it, after `comments`.
std::string material_toml(const CandidateMaterial& material, const std::string& comments);
/// A comment for each interval of a calibration, and its verdict.
std::string interval_comments(const CalibrationProblem& problem, const Calibration& calibration);

}  // namespace granulaw
