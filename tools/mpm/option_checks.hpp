#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "base/number_in.hpp"
#include "options.hpp"

namespace granulaw {

/// Checks of options that are numbers: what was found, what is allowed. CLI11's own let "nan" pass (it
/// compares false with both ends), and write every digit of the largest double.

inline Check number_check(const std::string& allowed, bool (*good)(double, double, double), double low, double high)
{
  return {allowed, [=](const std::string& word) { return good(number_in(word).value_or(std::nan("")), low, high); }};
}

/// From `low` to `high`, both included.
inline Check from_to(double low, double high)
{
  return number_check(
      fmt::format("a number from {:g} to {:g}", low, high), [](double value, double least, double most) { return value >= least && value <= most; }, low, high);
}
/// A whole number, from `low` to `high`.
inline Check whole_from_to(int low, int high)
{
  return number_check(
      fmt::format("a whole number from {} to {}", low, high),
      [](double value, double least, double most) { return value >= least && value <= most && value == std::floor(value); }, low, high);
}
/// Over 0, up to `high`.
inline Check above_zero_to(double high)
{
  return number_check(
      fmt::format("a number over 0, up to {:g}", high), [](double value, double, double most) { return value > 0 && value <= most; }, 0, high);
}
/// Over 0, finite.
inline Check above_zero()
{
  return number_check(
      "a number over 0", [](double value, double, double) { return value > 0 && std::isfinite(value); }, 0, 0);
}

/// Check beyond the validators, as Error "--depth: cannot be used: found FOUND, allowed is ALLOWED".
inline void require(bool good, const char* option, const std::string& found, const std::string& allowed)
{
  if (!good) fail(option, "cannot be used", found, allowed);
}

/// The same of a number with a unit, from `low` to `high`.
inline void require_within(const char* option, double value, const char* unit, double low, double high)
{
  require(value >= low && value <= high, option, fmt::format("{:g} {}", value, unit), fmt::format("{:g} to {:g} {}", low, high, unit));
}

}  // namespace granulaw
