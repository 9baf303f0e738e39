#pragma once

#include <string>

#include "calibrate/measurement.hpp"

namespace granulaw {

/// Reads a CSV of measured values: one header line whose names carry the units, then numbers. Lines that
/// begin with '#' and empty lines are skipped. The header tells the kind:
///
///     velocity_m_per_s,restitution                 velocity_m_per_s,contact_radius_m
///     velocity_m_per_s,residual_displacement_m     velocity_m_per_s,contact_time_s
///     displacement_m,force_N                       loading rows, then unloading rows; of the kind `curves`
///     hardness_Pa                                  onset_force_N
///
/// each with a further column NAME_sd for the standard deviation of the last one, if it is known. Every
/// problem is one sentence with file, line and column, as Error.
Measurement read_measurement(const std::string& path, MeasurementKind curves = MeasurementKind::platens);

/// The same of a text whose messages are led by `source`.
Measurement parse_measurement(const std::string& text, const std::string& source,
                              MeasurementKind curves = MeasurementKind::platens);

}  // namespace granulaw
