#include "liggghts_plugin/contact/contact_pieces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "liggghts_plugin/deck/keywords.hpp"

namespace granulaw::plugin {

namespace {

template <int... ids>
struct Ids
{
};
// tangential_models, cohesion_models, rolling_models (deck/keywords.hpp)
using Tangential = Ids<cm::TANGENTIAL_OFF, cm::TANGENTIAL_HISTORY, cm::TANGENTIAL_NO_HISTORY>;
using Cohesion = Ids<cm::COHESION_OFF, cm::COHESION_SJKR, cm::COHESION_SJKR2,
                     cm::COHESION_EASO_CAPILLARY_VISCOUS, cm::COHESION_WASHINO_CAPILLARY_VISCOUS>;
using Rolling =
    Ids<cm::ROLLING_OFF, cm::ROLLING_CDT, cm::ROLLING_EPSD, cm::ROLLING_EPSD2, cm::ROLLING_EPSD3>;

template <int... ids>
constexpr bool contains(Ids<ids...>, int id)
{
  return ((ids == id) || ...);
}

/// The model of this id; none for the first, which is off.
template <class Base, template <int> class Model, int off, int... ids>
std::unique_ptr<Base> make_model(Ids<off, ids...>, LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup,
                                 cm::ContactModelBase* contact, int id)
{
  std::unique_ptr<Base> made;
  ((id == ids && (made = std::make_unique<Model<ids>>(lmp, hsetup, contact))) || ...);
  return made;
}

using Names = std::map<int, std::string>;

// LIGGGHTS's models by id. Functions, as models register themselves while static objects are made.
const Names& tangential_names()
{
  static const Names names = {
      {cm::TANGENTIAL_OFF, "off"},
#define TANGENTIAL_MODEL(identifier, name, id) {id, #name},
#include "style_tangential_model.h"
#undef TANGENTIAL_MODEL
  };
  return names;
}

Names& own_names(int ModelIds::*place)
{
  static Names tangential, cohesion;
  return place == &ModelIds::tangential ? tangential : cohesion;
}

const Names& cohesion_names()
{
  static const Names names = {
      {cm::COHESION_OFF, "off"},
#define COHESION_MODEL(identifier, name, id) {id, #name},
#include "style_cohesion_model.h"
#undef COHESION_MODEL
  };
  return names;
}

const Names& rolling_names()
{
  static const Names names = {
      {cm::ROLLING_OFF, "off"},
#define ROLLING_MODEL(identifier, name, id) {id, #name},
#include "style_rolling_model.h"
#undef ROLLING_MODEL
  };
  return names;
}

const Names& surface_names()
{
  static const Names names = {
#define SURFACE_MODEL(identifier, name, id) {id, #name},
#include "style_surface_model.h"
#undef SURFACE_MODEL
  };
  return names;
}

}  // namespace

template <>
std::unique_ptr<cm::CohesionModelBase> Chosen<cm::CohesionModelBase>::make(
    LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup, cm::ContactModelBase* contact, int id)
{
  return make_model<cm::CohesionModelBase, cm::CohesionModel>(Cohesion{}, lmp, hsetup, contact, id);
}

template <>
std::unique_ptr<cm::RollingModelBase> Chosen<cm::RollingModelBase>::make(
    LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* hsetup, cm::ContactModelBase* contact, int id)
{
  return make_model<cm::RollingModelBase, cm::RollingModel>(Rolling{}, lmp, hsetup, contact, id);
}

void name_piece(int ModelIds::*place, int id, const char* name) { own_names(place)[id] = name; }

bool is_built(const ModelIds& ids)
{
  return contains(Tangential{}, ids.tangential) && contains(Cohesion{}, ids.cohesion) &&
         contains(Rolling{}, ids.rolling) && surface_is_built(ids.surface, ids.cohesion);
}

void each_combination(int normal, const std::function<void(const ModelIds&)>& visit)
{
  for (const auto& [tangential, of_tangential] : tangential_names())
    for (const auto& [cohesion, of_cohesion] : cohesion_names())
      for (const auto& [rolling, of_rolling] : rolling_names())
        for (const auto& [surface, of_surface] : surface_names())
          visit({normal, tangential, cohesion, rolling, surface});
}

std::string built_combinations()
{
  return fmt::format("tangential {}; cohesion {}; rolling_friction {}; {}", fmt::join(tangential_models, ", "),
                     fmt::join(cohesion_models, ", "), fmt::join(rolling_models, ", "), built_surfaces);
}

std::string describe_pieces(const ModelIds& ids)
{
  std::string text;
  const auto add = [&](const char* kind, const Names& names, int id) {
    const auto found = names.find(id);
    if (found != names.end() && found->second != "off") text += fmt::format(" {} {}", kind, found->second);
  };
  add("tangential", tangential_names(), ids.tangential);
  add("tangential", own_names(&ModelIds::tangential), ids.tangential);
  add("cohesion", cohesion_names(), ids.cohesion);
  add("cohesion", own_names(&ModelIds::cohesion), ids.cohesion);
  add("rolling_friction", rolling_names(), ids.rolling);
  return text;
}

}  // namespace granulaw::plugin
