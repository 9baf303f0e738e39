#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calibrate/calibrate.hpp"

namespace granulaw {

/// The keys of mpm calibrate --json.
nlohmann::ordered_json calibration_json(const CalibrationProblem& problem, const Calibration& calibration);

/// The summary for a person.
void print_calibration(const CalibrationProblem& problem, const Calibration& calibration);

}  // namespace granulaw
