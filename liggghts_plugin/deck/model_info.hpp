#pragma once

#include <span>
#include <string>

#include "liggghts_plugin/deck/keywords.hpp"

namespace granulaw::plugin {

/// Names of a normal model. normal_physics.hpp makes them from the model's physics.
struct ModelInfo
{
  const char* name;                   ///< behind `model` in a deck
  int id;                             ///< in restart files
  std::span<const Keyword> keywords;  ///< its own
};

/// Those of this library, by id: "mpm and thornton".
std::string model_names();
/// Null: it is LIGGGHTS's.
const ModelInfo* find_model(int id);

}  // namespace granulaw::plugin
