#include "liggghts_plugin/styles.hpp"

namespace granulaw::plugin {

namespace {

namespace lg = LIGGGHTS;

const std::vector<int> tangential_ids = {
    cm::TANGENTIAL_OFF,
#define TANGENTIAL_MODEL(identifier, name, id) id,
#include "style_tangential_model.h"
#undef TANGENTIAL_MODEL
};
const std::vector<int> cohesion_ids = {
    cm::COHESION_OFF,
#define COHESION_MODEL(identifier, name, id) id,
#include "style_cohesion_model.h"
#undef COHESION_MODEL
};
const std::vector<int> rolling_ids = {
    cm::ROLLING_OFF,
#define ROLLING_MODEL(identifier, name, id) id,
#include "style_rolling_model.h"
#undef ROLLING_MODEL
};
const std::vector<int> surface_ids = {
#define SURFACE_MODEL(identifier, name, id) id,
#include "style_surface_model.h"
#undef SURFACE_MODEL
};

std::string refusal()
{
  return fmt::format(
      "models mpm and thornton are built for tangential off, history, no_history; cohesion off, sjkr, sjkr2, "
      "easo/capillary/viscous, washino/capillary/viscous; rolling_friction off, cdt, epsd, epsd2, epsd3; {}: "
      "choose among these",
      built_surfaces);
}

const std::map<int, std::string> tangential_names = {
#define TANGENTIAL_MODEL(identifier, name, id) {id, #name},
#include "style_tangential_model.h"
#undef TANGENTIAL_MODEL
};
const std::map<int, std::string> cohesion_names = {
#define COHESION_MODEL(identifier, name, id) {id, #name},
#include "style_cohesion_model.h"
#undef COHESION_MODEL
};
const std::map<int, std::string> rolling_names = {
#define ROLLING_MODEL(identifier, name, id) {id, #name},
#include "style_rolling_model.h"
#undef ROLLING_MODEL
};

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

/// Registers everything when the library is loaded. Runs in Open MPI's helper processes as well, which
/// inherit LD_PRELOAD: it must print nothing and read nothing.
struct Registration
{
  Registration()
  {
    register_mpm();
    register_thornton();
    register_refusals(mpm_id);
    register_refusals(thornton_id);
  }
} registration;

}  // namespace

std::string describe_combination(long combination)
{
  // six bits each, as in LIGGGHTS's GranStyle
  const auto part = [&](int place) { return static_cast<int>(combination >> 6 * place & 63); };
  std::string text =
      fmt::format("model {}", part(0) == mpm_id ? model_name(Model::mpm) : model_name(Model::thornton));
  const auto add = [&](const char* kind, const std::map<int, std::string>& names, int id) {
    if (const auto found = names.find(id); found != names.end())
      text += fmt::format(" {} {}", kind, found->second);
  };
  add("tangential", tangential_names, part(1));
  add("cohesion", cohesion_names, part(2));
  add("rolling_friction", rolling_names, part(3));
  if (combination & combination_energy) text += ", energy on";
  if (combination & combination_contact_map) text += ", contactMap on";
  return text;
}

void register_refusals(int id)
{
  for (int t : tangential_ids)
    for (int c : cohesion_ids)
      for (int r : rolling_ids)
        for (int s : surface_ids) {
          if (is_built(t, c, r, s)) continue;
          const auto hash = lg::Utils::generate_gran_hashcode(id, t, c, r, s);
          lg::PairStyles::Factory::instance().addStyle("gran", static_cast<int>(hash), &refuse_pair);
          lg::Walls::Factory::instance().addStyle("gran", static_cast<int>(hash), &refuse_wall);
        }
}

}  // namespace granulaw::plugin
