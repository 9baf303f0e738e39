#pragma once

#include <string>

#include "solver/output/trace.hpp"

namespace granulaw {

/// Writes the trace as CSV ("time_s,delta_m,force_N,contact_radius_m,branch") or HDF5 (the same names, each
/// with its unit as attribute), by the ending of `path`; whole or not at all.
void write_trace(const RunResult& result, const std::string& path);

}  // namespace granulaw
