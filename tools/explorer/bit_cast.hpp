// std::bit_cast for the libc++ of Debian 12's emscripten, which has none. Included before every file of the module.
#pragma once

#include <type_traits>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept
{
  return __builtin_bit_cast(To, from);
}

}  // namespace std
