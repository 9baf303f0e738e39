#pragma once

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace granulaw {

/// Number as JSON, null where it is not finite.
inline nlohmann::ordered_json json_number(double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr); }

/// Output of --json: one object, its keys in the order in which they were put in.
inline void print_json(const nlohmann::ordered_json& object) { fmt::print("{}\n", object.dump(2)); }

}  // namespace granulaw
