#pragma once

#include "law/chosen_pair.hpp"
#include "options.hpp"

namespace granulaw {

/// --pair, --radius and --radius2.
void define_pair_options(Options& command, PairAsked& asked);

}  // namespace granulaw
