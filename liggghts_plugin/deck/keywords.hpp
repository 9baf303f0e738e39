#pragma once

#include <array>
#include <string_view>

// Every keyword behind the models in `pair_style gran` and `fix wall/gran`, but for those of a single model,
// which stand with its physics (NormalPhysics::keywords). Needs nothing else: the reader of decks uses the
// same lists.
namespace granulaw::plugin {

/// A keyword and what may follow it: one of `words`, a number from `least` to `most`, or, where it states
/// neither, any one word.
struct Keyword
{
  std::string_view name;
  bool in_pair_style = true, in_wall = true;  ///< where it may stand
  std::array<std::string_view, 3> words{};  ///< the last may be empty
  double least = 0.0, most = -1.0;  ///< least > most: no number
  /// List up to the next keyword, if one word or more: "one name for each atom type".
  std::string_view list{};

  constexpr bool takes_words() const { return !words[0].empty(); }
  constexpr bool takes_number() const { return least <= most; }
  constexpr bool stands_in(bool wall) const { return wall ? in_wall : in_pair_style; }
};

/// Keywords of all models. docs/reference/pair_gran_model_mpm.md says what they mean.
inline constexpr std::array shared_keywords{
    Keyword{.name = "tangentialDampingRatio", .least = 0.0, .most = 1.0},
    Keyword{.name = "tangentialStiffness", .words = {"computed", "mindlin"}},
    Keyword{.name = "elasticDamping", .words = {"off", "restitution"}, .least = 0.0, .most = 1.0},
    Keyword{.name = "bodyCompliance", .words = {"on", "off"}},
    Keyword{.name = "stretch", .least = 1.0, .most = 1000.0},
    Keyword{.name = "heatArea", .words = {"law", "overlap"}},
    Keyword{.name = "wall", .in_pair_style = false, .words = {"deformable", "rigid"}},
    Keyword{.name = "stats", .in_wall = false},
    Keyword{.name = "energy", .in_wall = false, .words = {"on", "off"}},
    Keyword{.name = "contactMap", .in_wall = false, .words = {"on", "off"}},
    Keyword{.name = "computeDissipatedEnergy", .words = {"on", "off"}},
};

/// For models whose law ends at a largest overlap: put it among the model's own keywords.
inline constexpr Keyword beyond_range{.name = "beyondRange", .words = {"stop", "continue", "crush"}};

/// Remedy that messages name where several contacts of a particle act on each other.
inline constexpr std::string_view for_pressed_beds = "'confinement auto' for pressed beds";

/// Keywords that LIGGGHTS itself reads behind the models, each followed by on or off.
inline constexpr std::array liggghts_keywords{
    Keyword{.name = "tangential_damping"},
    Keyword{.name = "limitForce"},
    Keyword{.name = "tangential_reduce"},
    Keyword{.name = "computeElasticPotential"},
    Keyword{.name = "heating_tracking"},
    Keyword{.name = "heating_tangential_history"},
    Keyword{.name = "heating_tangential_no_history"},
    Keyword{.name = "torsionTorque"},
};

/// Keywords of LIGGGHTS's surface model of superquadrics; superquadric.hpp checks what they say.
inline constexpr std::array surface_keywords{
    Keyword{.name = "meanCurvature"},
    Keyword{.name = "gaussianCurvature"},
    Keyword{.name = "curvatureLimitFactor"},
};

/// Keywords that name a model, in LIGGGHTS's order; all others stand behind.
inline constexpr std::array<std::string_view, 5> model_kinds{"model", "tangential", "cohesion",
                                                             "rolling_friction", "surface"};

/// Models of LIGGGHTS that stand beside a normal model of ours (contact_pieces.cpp), and the tangential law of model mpm alone.
inline constexpr std::array<std::string_view, 3> tangential_models{"off", "history", "no_history"};
inline constexpr std::string_view own_tangential_model = "plastic", own_cohesion_model = "dent";
inline constexpr std::array<std::string_view, 5> cohesion_models{"off", "sjkr", "sjkr2", "easo/capillary/viscous", "washino/capillary/viscous"};
inline constexpr std::array<std::string_view, 5> rolling_models{"off", "cdt", "epsd", "epsd2", "epsd3"};
inline constexpr std::array<std::string_view, 2> surface_models{"default", "superquadric"};

/// Words of `fix wall/gran` itself; they stand before the model's keywords.
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

}  // namespace granulaw::plugin
