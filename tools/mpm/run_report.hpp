#pragma once

#include "run_request.hpp"
#include "solver/output/trace.hpp"

namespace granulaw {

/// Before the run, for people: body, grid, yield velocity. `velocity`: m/s of an impact; 0: a press.
void print_setting(const RunRequest& request, const Particle& particle, double velocity);

/// After it: writes the trace if one is asked for, and prints the summary or its JSON.
void report(const RunRequest& request, const Particle& particle, const RunResult& result);

}  // namespace granulaw
