#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace granulaw {

/// A value, or several, in a contact's history, from one step to the next: zero in a new contact, zero again when it
/// ends. A particle code takes from the list how much it stores, what it turns, clears and may leave out of a
/// restart.
struct HistoryValue
{
  std::string_view name;
  std::size_t values = 1;
  bool changes_sign = false;  ///< a vector's: changes sign where i and j change places
  bool derived = false;  ///< follows from the others and the law: any of these set to zero is worked out anew
};

/// Numbers that a list stands for.
constexpr std::size_t values_of(std::span<const HistoryValue> list)
{
  std::size_t sum = 0;
  for (const HistoryValue& one : list) sum += one.values;
  return sum;
}

/// Two lists, one behind the other.
template <std::size_t n, std::size_t m>
constexpr std::array<HistoryValue, n + m> operator+(const std::array<HistoryValue, n>& first,
                                            const std::array<HistoryValue, m>& second)
{
  std::array<HistoryValue, n + m> all{};
  for (std::size_t k = 0; k < n; ++k) all[k] = first[k];
  for (std::size_t k = 0; k < m; ++k) all[n + k] = second[k];
  return all;
}

}  // namespace granulaw
