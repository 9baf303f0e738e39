#pragma once

#include "solver/material/concepts.hpp"
#include "solver/material/cowper_symonds.hpp"
#include "solver/material/johnson_cook.hpp"
#include "solver/material/linear.hpp"
#include "solver/material/rate_independent.hpp"
#include "solver/material/swift.hpp"
#include "solver/material/tabulated.hpp"
#include "solver/material/voce.hpp"
#include "solver/material/drucker_prager.hpp"
#include "solver/material/von_mises.hpp"

namespace granulaw::flow {

template <class... Law>
struct LawList
{
};

// A new law: one file beside the others with what concepts.hpp requires, included above and named here.
// Kernels, materials file, checks and messages follow these lists. The first of each is what a material has
// that names none.
using YieldSurfaces = LawList<VonMises, DruckerPrager>;
using HardeningLaws = LawList<Linear, Swift, Voce, JohnsonCook, Tabulated>;
using RateLaws = LawList<RateIndependent, JohnsonCookRate, CowperSymonds>;

/// Each law on its own, so that the compiler's message names the law and the member that it lacks.
template <class Law>
struct RequireHardening
{
  static_assert(HardeningLaw<Law>, "a hardening law lacks what concepts.hpp asks for");
};
template <class Law>
struct RequireRate
{
  static_assert(RateLaw<Law>, "a rate law lacks what concepts.hpp asks for");
};
template <class Law>
struct RequireSurface
{
  static_assert(YieldSurface<Law>, "a yield surface lacks what concepts.hpp asks for");
};
template <template <class> class Require, class... Law>
consteval bool all(LawList<Law...>)
{
  return ((sizeof(Require<Law>) > 0) && ...);
}
static_assert(all<RequireSurface>(YieldSurfaces{}));
static_assert(all<RequireHardening>(HardeningLaws{}));
static_assert(all<RequireRate>(RateLaws{}));

/// The laws of one material as the kernels read them: places in the lists, parameters in their order (a list
/// of points as its law wants it), in solver units. Plain data.
struct Flow
{
  int surface = 0, hardening = 0, rate = 0;
  double surface_values[surface_room]{};
  double hardening_values[law_room]{};
  double rate_values[rate_room]{};
};

}  // namespace granulaw::flow
