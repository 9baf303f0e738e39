#pragma once

#include "liggghts_plugin/styles.hpp"

namespace granulaw::plugin {

using PairMaker = LIGGGHTS::PairStyles::IGranularPairStyle* (*)(LAMMPS*, PairGran*, int64_t);
using WallMaker = LIGGGHTS::Walls::IGranularWall* (*)(LAMMPS*, FixWallGran*, int64_t);

/// Makes the model known to LIGGGHTS and to model_names(): `pair` and `wall` make every combination that is
/// built. The others are refused in a sentence, where LIGGGHTS would say "Unknown normal model".
void add_model(const ModelInfo& model, PairMaker pair, WallMaker wall);

/// Stops before the surface model is made, which would stop one rank with a message that may get lost.
void check_particles(LAMMPS* lmp, const ModelIds& ids);

/// Registers a model when the library is loaded: one static object in each register_NAME.cpp. Runs in Open
/// MPI's helper processes as well, which inherit LD_PRELOAD: it must print nothing and read nothing.
template <NormalPhysics Physics>
class ModelRegistration
{
 public:
  ModelRegistration()
  {
    add_model(model_info<Physics>, &make<LIGGGHTS::PairStyles::IGranularPairStyle, PairStyle, PairGran>,
              &make<LIGGGHTS::Walls::IGranularWall, WallStyle, FixWallGran>);
  }

 private:
  template <class Interface, template <class> class Style, class Parent>
  static Interface* make(LAMMPS* lmp, Parent* parent, int64_t hash)
  {
    constexpr bool is_pair = std::is_same_v<Parent, PairGran>;
    using Loaded = std::conditional_t<is_pair, PairGranProxy, Parent>;
    check_liggghts(lmp, dynamic_cast<void*>(parent), sizeof(Loaded), is_pair ? "pair style" : "fix wall/gran");
    const ModelIds ids = ModelIds::of(hash);
    check_particles(lmp, ids);
#ifdef SUPERQUADRIC_ACTIVE_FLAG
    if (ids.superquadric())
      return new Style<AnyContact<Physics, cm::SURFACE_SUPERQUADRIC>>(lmp, parent, hash);
#endif
    if (ids.tangential == cm::TANGENTIAL_HISTORY && ids.cohesion == cm::COHESION_OFF &&
        ids.rolling == cm::ROLLING_OFF)
      return new Style<UsualContact<Physics>>(lmp, parent, hash);
    return new Style<AnyContact<Physics>>(lmp, parent, hash);
  }
};

}  // namespace granulaw::plugin
