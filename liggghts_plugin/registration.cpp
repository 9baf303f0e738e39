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
      "models mpm and thornton are built for tangential off, history, no_history; cohesion off, sjkr, sjkr2; "
      "rolling_friction off, cdt, epsd, epsd2; {}: choose among these",
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
