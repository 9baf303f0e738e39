#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace granulaw {

/// A value, or several, that a contact keeps between two steps: zero in a new contact, zero again when it
/// ends. A particle code takes from the list how much it stores, what it turns, clears and may leave out of a
/// restart.
struct Kept
{
  std::string_view name;
  std::size_t values = 1;
  bool turns_with_exchange = false;  ///< a vector's: changes sign where i and j change places
  bool derived = false;  ///< follows from the others and the law: any of these set to zero is worked out anew
};

/// Numbers that a list stands for.
constexpr std::size_t values_of(std::span<const Kept> list)
{
  std::size_t sum = 0;
  for (const Kept& one : list) sum += one.values;
  return sum;
}

/// Two lists, one behind the other.
template <std::size_t n, std::size_t m>
constexpr std::array<Kept, n + m> operator+(const std::array<Kept, n>& first,
                                            const std::array<Kept, m>& second)
{
  std::array<Kept, n + m> all{};
  for (std::size_t k = 0; k < n; ++k) all[k] = first[k];
  for (std::size_t k = 0; k < m; ++k) all[n + k] = second[k];
  return all;
}

}  // namespace granulaw
