#pragma once

#include <utility>

#include "liggghts_plugin/liggghts.hpp"
#include "liggghts_plugin/shapes.hpp"

// Which tangential, cohesion, rolling and surface models each normal model is built with.
namespace granulaw::plugin {

template <int... ids>
using Ids = std::integer_sequence<int, ids...>;

template <int... ids>
constexpr bool contains(Ids<ids...>, int id)
{
  return ((ids == id) || ...);
}

/// What is built: every combination of these.
#ifdef GRANULAW_PLAIN_COMBINATION  // one, for the first tries of a new model: seconds to compile, not minutes
using BuiltTangential = Ids<cm::TANGENTIAL_HISTORY>;
using BuiltCohesion = Ids<cm::COHESION_OFF>;
using BuiltRolling = Ids<cm::ROLLING_OFF>;
#else
using BuiltTangential = Ids<cm::TANGENTIAL_OFF, cm::TANGENTIAL_HISTORY, cm::TANGENTIAL_NO_HISTORY>;
using BuiltCohesion = Ids<cm::COHESION_OFF, cm::COHESION_SJKR, cm::COHESION_SJKR2,
                          cm::COHESION_EASO_CAPILLARY_VISCOUS, cm::COHESION_WASHINO_CAPILLARY_VISCOUS>;
using BuiltRolling =
    Ids<cm::ROLLING_OFF, cm::ROLLING_CDT, cm::ROLLING_EPSD, cm::ROLLING_EPSD2, cm::ROLLING_EPSD3>;
#endif

}  // namespace granulaw::plugin
