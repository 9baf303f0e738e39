#pragma once

#include <fmt/format.h>

#include <string>

namespace granulaw {

/// A relative error in per cent.
inline std::string percent(double error)
{
  return fmt::format("{:.2g} %", 100 * error);
}

/// Two relative errors, for a sentence.
inline std::string errors_text(double force, double restitution)
{
  return fmt::format("force within {}, e within {}", percent(force), percent(restitution));
}

}  // namespace granulaw
