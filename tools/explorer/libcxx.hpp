// For the libc++ of Debian 12's emscripten: std::bit_cast, std::ranges::all_of and none_of, which it lacks. Included before every file of the module.
#pragma once

#include <functional>
#include <type_traits>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept
{
  return __builtin_bit_cast(To, from);
}

}  // namespace std

namespace std::ranges {

template <class Range, class Holds>
constexpr bool all_of(const Range& range, Holds holds)
{
  for (const auto& one : range)
    if (!std::invoke(holds, one)) return false;
  return true;
}

template <class Range, class Holds>
constexpr bool none_of(const Range& range, Holds holds)
{
  return all_of(range, [&](const auto& one) { return !std::invoke(holds, one); });
}

}  // namespace std::ranges
