#pragma once

#include "liggghts_plugin/command.hpp"
#include "liggghts_plugin/normal_physics.hpp"

namespace granulaw::plugin {

/// Of a GranStyle, LIGGGHTS's combination of five models, whose normal model has this physics.
template <class Style, NormalPhysics Physics>
inline constexpr CommandModels command_models{model_info<Physics>, &Physics::read_keywords,
                                              Style::TANGENTIAL,   Style::COHESION,
                                              Style::HASHCODE,     is_superquadric<Style>};

}  // namespace granulaw::plugin
