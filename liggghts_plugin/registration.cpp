#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

#include "liggghts_plugin/model_registration.hpp"

namespace granulaw::plugin {

namespace {

namespace lg = LIGGGHTS;

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

template <int... ids>
std::string join_names(const Names& names, Ids<ids...>)
{
  return fmt::format("{}", fmt::join({names.at(ids)...}, ", "));
}

std::vector<ModelInfo>& known_models()
{
  static std::vector<ModelInfo> models;
  return models;
}

/// Two models of one name or id would hide each other.
void refuse_twin(const ModelInfo& model)
{
  for (const ModelInfo& other : known_models())
    if (other.id == model.id || std::string(other.name) == model.name) {
      std::fprintf(stderr, "granulaw: models %s and %s have one name or one id (%d)\n", other.name,
                   model.name, model.id);
      std::abort();
    }
}

std::string refusal()
{
  return fmt::format(
      "models {} are built for tangential {}; cohesion {}; rolling_friction {}; {}: choose among these",
      model_names(), join_names(tangential_names(), BuiltTangential{}),
      join_names(cohesion_names(), BuiltCohesion{}), join_names(rolling_names(), BuiltRolling{}),
      built_surfaces);
}

lg::PairStyles::IGranularPairStyle* refuse_pair(LAMMPS* lmp, PairGran*, int64_t)
{
  stop_all(lmp, refusal());
}

lg::Walls::IGranularWall* refuse_wall(LAMMPS* lmp, FixWallGran*, int64_t)
{
  stop_all(lmp, refusal());
}

bool is_built(int tangential, int cohesion, int rolling, int surface)
{
  return contains(BuiltTangential{}, tangential) && contains(BuiltCohesion{}, cohesion) &&
         contains(BuiltRolling{}, rolling) && surface_is_built(surface, cohesion);
}

void add_refusals(const ModelInfo& model)
{
  for (const auto& [t, tangential] : tangential_names())
    for (const auto& [c, cohesion] : cohesion_names())
      for (const auto& [r, rolling] : rolling_names())
        for (const auto& [s, surface] : surface_names()) {
          if (is_built(t, c, r, s)) continue;
          const auto hash = static_cast<int>(lg::Utils::generate_gran_hashcode(model.id, t, c, r, s));
          lg::PairStyles::Factory::instance().addStyle("gran", hash, &refuse_pair);
          lg::Walls::Factory::instance().addStyle("gran", hash, &refuse_wall);
        }
}

}  // namespace

void add_model(const ModelInfo& model)
{
  refuse_twin(model);
  known_models().push_back(model);
  cm::Factory::instance().addNormalModel(model.name, model.id);
  add_refusals(model);
}

std::string model_names()
{
  std::vector<ModelInfo> models = known_models();
  std::sort(models.begin(), models.end(), [](const ModelInfo& a, const ModelInfo& b) { return a.id < b.id; });
  std::vector<std::string> names;
  for (const ModelInfo& model : models) names.emplace_back(model.name);
  return fmt::format("{}", fmt::join(names, " and "));
}

std::string describe(const HistoryMeaning& meaning)
{
  const long combination = meaning.combination;
  // six bits each, as in LIGGGHTS's GranStyle
  const auto part = [&](int place) { return static_cast<int>(combination >> 6 * place & 63); };
  std::string text = "model";
  for (const ModelInfo& model : known_models())
    if (model.id == part(0)) text += fmt::format(" {}", model.name);
  const auto add = [&](const char* kind, const Names& names, int id) {
    const auto found = names.find(id);
    if (found != names.end() && found->second != "off") text += fmt::format(" {} {}", kind, found->second);
  };
  add("tangential", tangential_names(), part(1));
  add("cohesion", cohesion_names(), part(2));
  add("rolling_friction", rolling_names(), part(3));
  if (combination & HistoryMeaning::energy) text += ", energy on";
  if (combination & HistoryMeaning::contact_map) text += ", contactMap on";
  if (combination & HistoryMeaning::deformable_wall) text += ", wall deformable";
  if (combination & HistoryMeaning::computed_stiffness) text += ", tangentialStiffness computed";
  if (meaning.stretch > 1.0) text += fmt::format(", stretch {:g}", meaning.stretch);
  return text;
}

}  // namespace granulaw::plugin
