// std::ranges::all_of and none_of for the libc++ of Debian 12's emscripten, which has neither. Included before the files that
// declare flow laws.
#pragma once

#include <functional>

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
