#include "liggghts_plugin/loop/registration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "liggghts_plugin/contact/contact_pieces.hpp"

namespace granulaw::plugin {

namespace {

namespace lg = LIGGGHTS;

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
  return fmt::format("models {} are built for {}: choose among these", model_names(), built_combinations());
}

lg::PairStyles::IGranularPairStyle* refuse_pair(LAMMPS* lmp, PairGran*, int64_t)
{
  stop_all(lmp, refusal());
}

lg::Walls::IGranularWall* refuse_wall(LAMMPS* lmp, FixWallGran*, int64_t)
{
  stop_all(lmp, refusal());
}

}  // namespace

void add_model(const ModelInfo& model, PairMaker pair, WallMaker wall)
{
  refuse_twin(model);
  known_models().push_back(model);
  cm::Factory::instance().addNormalModel(model.name, model.id);
  each_combination(model.id, [&](const ModelIds& ids) {
    const int hash = static_cast<int>(ids.hash());
    lg::PairStyles::Factory::instance().addStyle("gran", hash, is_built(ids) ? pair : &refuse_pair);
    lg::Walls::Factory::instance().addStyle("gran", hash, is_built(ids) ? wall : &refuse_wall);
  });
}

void check_particles(LAMMPS* lmp, const ModelIds& ids)
{
  if (ids.superquadric() && !lmp->atom->superquadric_flag)
    stop_all(lmp, "'surface superquadric' needs atom_style superquadric, said before the pair style");
}

std::string model_names()
{
  std::vector<ModelInfo> models = known_models();
  std::sort(models.begin(), models.end(), [](const ModelInfo& a, const ModelInfo& b) { return a.id < b.id; });
  std::vector<std::string> names;
  for (const ModelInfo& model : models) names.emplace_back(model.name);
  return fmt::format("{}", fmt::join(names, " and "));
}

const ModelInfo* find_model(int id)
{
  for (const ModelInfo& model : known_models())
    if (model.id == id) return &model;
  return nullptr;
}

std::string describe(const HistoryMeaning& meaning)
{
  const long combination = meaning.combination;
  const ModelIds ids = ModelIds::of(combination);
  std::string text = "model";
  for (const ModelInfo& model : known_models())
    if (model.id == ids.normal) text += fmt::format(" {}", model.name);
  text += describe_pieces(ids);
  if (combination & HistoryMeaning::energy) text += ", energy on";
  if (combination & HistoryMeaning::contact_map) text += ", contactMap on";
  if (combination & HistoryMeaning::deformable_wall) text += ", wall deformable";
  if (combination & HistoryMeaning::computed_stiffness) text += ", tangentialStiffness computed";
  if (meaning.stretch > 1.0) text += fmt::format(", stretch {:g}", meaning.stretch);
  return text;
}

}  // namespace granulaw::plugin
