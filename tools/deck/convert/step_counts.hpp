#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace granulaw::deck {

/// Places of the words of a command that are numbers of time steps.
std::vector<std::size_t> step_counts(const std::vector<std::string>& words);

}  // namespace granulaw::deck
