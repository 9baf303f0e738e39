#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace granulaw {

/// The number that a whole word is ("1e-3", "+2", "inf"); empty: it is none.
inline std::optional<double> number_in(std::string_view word)
{
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

}  // namespace granulaw
