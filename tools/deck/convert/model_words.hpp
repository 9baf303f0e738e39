#pragma once

#include <string>
#include <vector>

#include "deck/convert/deck_text.hpp"

namespace granulaw::deck {

/// Words of `pair_style gran` or `fix wall/gran` as model mpm takes them.
struct ModelWords
{
  std::vector<std::string> words;    ///< from `model` on
  std::vector<std::string> dropped;  ///< "WORDS: reason"
};

/// `words`: from behind `gran` or `wall/gran` on, variables replaced.
ModelWords model_words(const std::vector<std::string>& words, bool is_wall);

}  // namespace granulaw::deck
