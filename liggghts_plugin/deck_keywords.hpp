#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "liggghts_plugin/keywords.hpp"
#include "liggghts_plugin/mpm_physics.hpp"

// For readers of decks without LIGGGHTS: every keyword that may stand behind `model mpm` and the other
// models.
namespace granulaw::plugin {

template <std::size_t... sizes>
constexpr auto join_keywords(const std::array<Keyword, sizes>&... lists)
{
  std::array<Keyword, (sizes + ...)> joined;
  auto end = joined.begin();
  ((end = std::copy(lists.begin(), lists.end(), end)), ...);
  return joined;
}

inline constexpr auto keyword_table =
    join_keywords(shared_keywords, MpmPhysics::keywords, liggghts_keywords, surface_keywords);

/// The keyword of this name in `fix wall/gran` (`is_wall`) or `pair_style gran`; null: there is none.
constexpr const Keyword* find_keyword(std::string_view name, bool is_wall)
{
  for (const Keyword& k : keyword_table)
    if (k.name == name && k.stands_in(is_wall)) return &k;
  return nullptr;
}

/// Whether the names behind `materials` end before this word.
constexpr bool is_reserved(std::string_view word, bool is_wall)
{
  const auto in = [&](const auto& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  return find_keyword(word, is_wall) || in(model_kinds) || (is_wall && in(wall_words));
}

}  // namespace granulaw::plugin
