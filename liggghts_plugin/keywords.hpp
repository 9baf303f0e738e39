#pragma once

#include <algorithm>
#include <array>
#include <string_view>

/// The words of `pair_style gran` and `fix wall/gran` with the models `mpm` and `thornton`: read by the
/// plug-in (options.hpp) and by what plans a deck without LIGGGHTS (tools/deck).
namespace granulaw::plugin {

/// Who reads a keyword.
enum class KeywordReader {
  plugin,          ///< options.cpp
  surface_model,   ///< LIGGGHTS's superquadrics, checked by the plug-in
  contact_models,  ///< LIGGGHTS's other models, each followed by on or off
};

/// A word that may stand behind the models, and where.
struct Keyword
{
  std::string_view name;
  KeywordReader reader = KeywordReader::plugin;
  bool in_pair_style = true, in_wall = true;
  bool only_mpm = false;     ///< not with the model `thornton`
  bool many_values = false;  ///< up to the next keyword; else exactly one
};

/// A new keyword of the plug-in is one line here, and what it does in options.cpp.
inline constexpr std::array keyword_table{
    Keyword{.name = "tangentialDampingRatio"},
    Keyword{.name = "tangentialStiffness"},
    Keyword{.name = "elasticDamping"},
    Keyword{.name = "stretch"},
    Keyword{.name = "heatArea"},
    Keyword{.name = "wall", .in_pair_style = false},
    Keyword{.name = "stats", .in_wall = false},
    Keyword{.name = "energy", .in_wall = false},
    Keyword{.name = "contactMap", .in_wall = false},
    Keyword{.name = "law", .only_mpm = true},
    Keyword{.name = "materials", .only_mpm = true, .many_values = true},
    Keyword{.name = "beyondRange", .only_mpm = true},
    Keyword{.name = "tangential_damping", .reader = KeywordReader::contact_models},
    Keyword{.name = "limitForce", .reader = KeywordReader::contact_models},
    Keyword{.name = "tangential_reduce", .reader = KeywordReader::contact_models},
    Keyword{.name = "computeElasticPotential", .reader = KeywordReader::contact_models},
    Keyword{.name = "computeDissipatedEnergy"},
    Keyword{.name = "heating_tracking", .reader = KeywordReader::contact_models},
    Keyword{.name = "heating_tangential_history", .reader = KeywordReader::contact_models},
    Keyword{.name = "heating_tangential_no_history", .reader = KeywordReader::contact_models},
    Keyword{.name = "torsionTorque", .reader = KeywordReader::contact_models},
    Keyword{.name = "meanCurvature", .reader = KeywordReader::surface_model},
    Keyword{.name = "gaussianCurvature", .reader = KeywordReader::surface_model},
    Keyword{.name = "curvatureLimitFactor", .reader = KeywordReader::surface_model},
};

/// The words that name the five models, in their order.
inline constexpr std::array<std::string_view, 5> model_kinds{"model", "tangential", "cohesion",
                                                             "rolling_friction", "surface"};

/// LIGGGHTS's own words of `fix wall/gran`, which stand before the model's.
inline constexpr std::array<std::string_view, 13> wall_words{"primitive",
                                                             "mesh",
                                                             "n_meshes",
                                                             "meshes",
                                                             "shear",
                                                             "store_force",
                                                             "store_force_contact",
                                                             "store_force_contact_every",
                                                             "store_force_contact_stress",
                                                             "temperature",
                                                             "contact_area",
                                                             "track_energy",
                                                             "allow_special_domain_periodic"};

/// The keyword of this name in `fix wall/gran` (`is_wall`) or `pair_style gran`; null: there is none.
constexpr const Keyword* find_keyword(std::string_view name, bool is_wall)
{
  for (const Keyword& k : keyword_table)
    if (k.name == name && (is_wall ? k.in_wall : k.in_pair_style)) return &k;
  return nullptr;
}

/// Whether `word` ends the names that stand behind `materials`.
constexpr bool is_reserved(std::string_view word, bool is_wall)
{
  const auto in = [&](const auto& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  return find_keyword(word, is_wall) || in(model_kinds) || (is_wall && in(wall_words));
}

}  // namespace granulaw::plugin
