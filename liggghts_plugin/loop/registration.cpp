#include "liggghts_plugin/loop/registration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
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

/// "tangential NAME" or "cohesion NAME" of ours, and the normal model that it is for.
struct OwnPiece
{
  std::string name;
  int ModelIds::*place;
  int normal;
};
std::map<int, OwnPiece>& own_pieces()
{
  static std::map<int, OwnPiece> pieces;
  return pieces;
}

std::string refusal()
{
  std::string own;
  for (const auto& [id, piece] : own_pieces())
    if (const ModelInfo* model = find_model(piece.normal)) own += fmt::format("; model {} also for '{}'", model->name, piece.name);
  return fmt::format("models {} are built for {}{}: choose among these", model_names(), built_combinations(), own);
}

[[noreturn]] void refuse(LAMMPS* lmp, int64_t hash)
{
  const ModelIds ids = ModelIds::of(hash);
  const auto tangential_piece = own_pieces().find(ids.tangential), beside = own_pieces().find(ids.cohesion);
  if (tangential_piece != own_pieces().end() && beside != own_pieces().end())
    stop_all(lmp, fmt::format("'{}' and '{}' do not go together: shear would have to pay for the surfaces that it parts; say 'tangential history'",
                              tangential_piece->second.name, beside->second.name));
  for (const auto& [id, piece] : own_pieces()) {
    if (ids.*piece.place != id) continue;
    const ModelInfo* model = find_model(piece.normal);
    const bool tangential = piece.place == &ModelIds::tangential;
    if (ids.normal != piece.normal)
      stop_all(lmp, fmt::format("'{}' is for 'model {}': with other normal models say '{}'", piece.name,
                                model ? model->name : "of another plug-in", tangential ? "tangential history" : "cohesion off"));
    stop_all(lmp, fmt::format("'{}' is built for spheres, with {} as '{}' is", piece.name,
                              tangential ? "cohesion and rolling models" : "LIGGGHTS's tangential and rolling models",
                              tangential ? "tangential history" : "cohesion off"));
  }
  stop_all(lmp, refusal());
}

lg::PairStyles::IGranularPairStyle* refuse_pair(LAMMPS* lmp, PairGran*, int64_t hash)
{
  refuse(lmp, hash);
}

lg::Walls::IGranularWall* refuse_wall(LAMMPS* lmp, FixWallGran*, int64_t hash)
{
  refuse(lmp, hash);
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

bool takes_own(const ModelIds& ids, int ModelIds::*place)
{
  static_assert(cm::TANGENTIAL_OFF == 0 && cm::COHESION_OFF == 0);
  return ids.*place == 0 && ids.surface == cm::SURFACE_DEFAULT && is_built(ids);
}

void refuse_other_normals(const std::string& name, int id, int ModelIds::*place, int normal)
{
  for (const auto& [other, piece] : own_pieces())
    if (piece.place != place)
      each_combination(normal, [&, other = other, at = piece.place](ModelIds ids) {
        if (ids.*place != 0 || ids.*at != 0) return;
        ids.*place = id, ids.*at = other;
        const int hash = static_cast<int>(ids.hash());
        lg::PairStyles::Factory::instance().addStyle("gran", hash, &refuse_pair);
        lg::Walls::Factory::instance().addStyle("gran", hash, &refuse_wall);
      });
  own_pieces()[id] = {(place == &ModelIds::tangential ? "tangential " : "cohesion ") + name, place, normal};
  constexpr int last_normal = 63;  // six bits
  for (int other = 1; other <= last_normal; ++other)
    each_combination(other, [&](ModelIds ids) {
      if (ids.*place != 0 || (other == normal && takes_own(ids, place))) return;
      ids.*place = id;
      const int hash = static_cast<int>(ids.hash());
      lg::PairStyles::Factory::instance().addStyle("gran", hash, &refuse_pair);
      lg::Walls::Factory::instance().addStyle("gran", hash, &refuse_wall);
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
  if (combination & HistoryMeaning::body_compliance) text += ", bodyCompliance on";
  if (combination & HistoryMeaning::crush) text += ", beyondRange crush";
  if (combination & HistoryMeaning::confinement) text += ", confinement on";
  if (combination & HistoryMeaning::deformable_wall) text += ", wall deformable";
  if (combination & HistoryMeaning::computed_stiffness) text += ", tangentialStiffness computed";
  if (meaning.stretch > 1.0) text += fmt::format(", stretch {:g}", meaning.stretch);
  return text;
}

}  // namespace granulaw::plugin
