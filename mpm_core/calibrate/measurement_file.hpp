#pragma once

#include <string>
#include <vector>

#include "calibrate/measurement.hpp"

namespace granulaw {

/// Reads a CSV of measured values: one header line, then numbers. Lines that begin with '#' and empty lines
/// are skipped. The header is one of measurement_headers(), whose names carry the units, with a further
/// column NAME_sd for the standard deviation of the last one, if it is known; it names the kind, but for
/// `curves`, which is the kind of a file with its columns. Every problem is one sentence with file, line and
/// column, as Error.
Measurement read_measurement(const std::string& path, const Kind& curves = kind_named("platens", "curves"));

/// The same of a text whose messages are led by `source`.
Measurement parse_measurement(const std::string& text, const std::string& source,
                              const Kind& curves = kind_named("platens", "curves"));

/// "velocity_m_per_s,restitution", ...: of all kinds, each once.
std::vector<std::string> measurement_headers();

}  // namespace granulaw
