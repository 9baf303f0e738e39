#pragma once

#include "solver/flow/cowper_symonds.hpp"
#include "solver/flow/johnson_cook.hpp"
#include "solver/flow/linear.hpp"
#include "solver/flow/plastic_increment.hpp"
#include "solver/flow/swift.hpp"
#include "solver/flow/tabulated.hpp"
#include "solver/flow/voce.hpp"

namespace granulaw::flow {

template <class... Law>
struct LawList
{
};

// A new law: one file beside the others, and its name here. `scale_strains` makes every plastic strain of a
// hardening law `by` times as large; lists of strains are scaled as they are. Kernels, materials file and
// checks follow these lists; the first of each is what a material has that names none.
using HardeningLaws = LawList<Linear, Swift, Voce, JohnsonCook, Tabulated>;
using RateLaws = LawList<RateIndependent, JohnsonCookRate, CowperSymonds>;

/// The laws of one material as the kernels read them: places in the lists, parameters in their order (a list
/// of points as its law wants it), in solver units. Plain data.
struct Flow
{
  int hardening = 0, rate = 0;
  double hardening_values[law_room]{};
  double rate_values[8]{};
};

}  // namespace granulaw::flow
