#pragma once

#include "request.hpp"

namespace granulaw {

/// Fits the yield stress to drop tests: the object of `mpm calibrate --json --fit yield_stress`.
///   {"data": "velocity_m_per_s,restitution\n...", "relative_sd": of an e without a standard deviation,
///    "material", "radius", "partner": as in a Request; the yield stress is not looked at}
Json drops_json(const Atlas& atlas, const Json& json);

}  // namespace granulaw
