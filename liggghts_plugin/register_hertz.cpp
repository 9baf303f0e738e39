// Stock Hertz, compiled with the plug-in's flags, as model `hertz_granulaw`: for the benchmark only.
#include "liggghts_plugin/liggghts.hpp"
#include "liggghts_plugin/model_ids.hpp"

namespace LIGGGHTS::ContactModels {

template <>
class NormalModel<granulaw::plugin::hertz_copy_id> : public NormalModel<HERTZ>
{
 public:
  using NormalModel<HERTZ>::NormalModel;
};

}  // namespace LIGGGHTS::ContactModels

namespace granulaw::plugin {

namespace {

namespace cm = LIGGGHTS::ContactModels;

template <class Style>
LIGGGHTS::PairStyles::IGranularPairStyle* make_pair(LAMMPS* lmp, PairGran* parent, int64_t hash)
{
  return new LIGGGHTS::PairStyles::Granular<cm::ContactModel<Style>>(lmp, parent, hash);
}

template <class Style>
LIGGGHTS::Walls::IGranularWall* make_wall(LAMMPS* lmp, FixWallGran* parent, int64_t hash)
{
  return new LIGGGHTS::Walls::Granular<cm::ContactModel<Style>>(lmp, parent, hash);
}

template <int rolling>
void add()
{
  using Style =
      cm::GranStyle<hertz_copy_id, cm::TANGENTIAL_HISTORY, cm::COHESION_OFF, rolling, cm::SURFACE_DEFAULT>;
  LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", Style::HASHCODE, &make_pair<Style>);
  LIGGGHTS::Walls::Factory::instance().addStyle("gran", Style::HASHCODE, &make_wall<Style>);
}

struct Registration
{
  Registration()
  {
    cm::Factory::instance().addNormalModel("hertz_granulaw", hertz_copy_id);
    add<cm::ROLLING_OFF>();
    add<cm::ROLLING_CDT>();
    add<cm::ROLLING_EPSD2>();
  }
} registration;

}  // namespace

}  // namespace granulaw::plugin
