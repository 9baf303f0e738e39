// Stock Hertz, compiled with the plug-in's flags, for the benchmark only: as model `hertz_granulaw` in
// LIGGGHTS's loop over pairs, as `hertz_loop` in ours.
#include "liggghts_plugin/engine/liggghts.hpp"
#include "liggghts_plugin/loop/pair_loop.hpp"

namespace granulaw::plugin {

inline constexpr int hertz_copy_id = 42, hertz_loop_id = 43;

}  // namespace granulaw::plugin

namespace LIGGGHTS::ContactModels {

template <>
class NormalModel<granulaw::plugin::hertz_copy_id> : public NormalModel<HERTZ>
{
 public:
  using NormalModel<HERTZ>::NormalModel;
};

template <>
class NormalModel<granulaw::plugin::hertz_loop_id> : public NormalModel<HERTZ>
{
 public:
  using NormalModel<HERTZ>::NormalModel;
};

}  // namespace LIGGGHTS::ContactModels

namespace granulaw::plugin {

namespace {

namespace cm = LIGGGHTS::ContactModels;

template <class Pair>
LIGGGHTS::PairStyles::IGranularPairStyle* make_pair(LAMMPS* lmp, PairGran* parent, int64_t hash)
{
  return new Pair(lmp, parent, hash);
}

template <class Style>
LIGGGHTS::Walls::IGranularWall* make_wall(LAMMPS* lmp, FixWallGran* parent, int64_t hash)
{
  return new LIGGGHTS::Walls::Granular<cm::ContactModel<Style>>(lmp, parent, hash);
}

template <int id, template <class> class Pair>
void add(const char* name)
{
  using Style =
      cm::GranStyle<id, cm::TANGENTIAL_HISTORY, cm::COHESION_OFF, cm::ROLLING_OFF, cm::SURFACE_DEFAULT>;
  cm::Factory::instance().addNormalModel(name, id);
  LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", Style::HASHCODE,
                                                     &make_pair<Pair<cm::ContactModel<Style>>>);
  LIGGGHTS::Walls::Factory::instance().addStyle("gran", Style::HASHCODE, &make_wall<Style>);
}

struct Registration
{
  Registration()
  {
    add<hertz_copy_id, LIGGGHTS::PairStyles::Granular>("hertz_granulaw");
    add<hertz_loop_id, PairLoop>("hertz_loop");
  }
} registration;

}  // namespace

}  // namespace granulaw::plugin
