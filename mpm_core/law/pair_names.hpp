#pragma once

#include <string>
#include <utility>
#include <vector>

#include "law/law.hpp"

namespace granulaw {

using PairNames = std::pair<std::string, std::string>;

/// The two names of "a:b"; of a text without a colon the second is empty.
PairNames split_pair(const std::string& text);

/// The pair that a law's user names by --pair. Throws Error, with the law's pairs, if it is not "a:b".
PairNames pair_option(const std::string& text, const Law& law);

/// The same, or every pair of the law where --pair is not given.
std::vector<PairNames> pairs_asked(const std::string& text, const Law& law);

/// A pair to make a law for: "a:b" or "a:wall", in either order. Throws Error if it is neither.
PairNames new_pair(const std::string& text);

}  // namespace granulaw
