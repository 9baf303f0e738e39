#pragma once

#include <string>

#include "liggghts_plugin/loop/styles.hpp"

namespace granulaw::plugin {

using PairMaker = LIGGGHTS::PairStyles::IGranularPairStyle* (*)(LAMMPS*, PairGran*, int64_t);
using WallMaker = LIGGGHTS::Walls::IGranularWall* (*)(LAMMPS*, FixWallGran*, int64_t);

/// Makes the model known to LIGGGHTS and to model_names(): `pair` and `wall` make every combination that is
/// built. The others are refused in a sentence, where LIGGGHTS would say "Unknown normal model".
void add_model(const ModelInfo& model, PairMaker pair, WallMaker wall);

/// Stops before the surface model is made, which would stop one rank with a message that may get lost.
void check_particles(LAMMPS* lmp, const ModelIds& ids);

/// Makes a style of `hash` for pairs or walls; stops where this is another LIGGGHTS than the plug-in was built for.
template <class Interface, class Made, class Parent>
Interface* make_style(LAMMPS* lmp, Parent* parent, int64_t hash)
{
  constexpr bool is_pair = std::is_same_v<Parent, PairGran>;
  using Loaded = std::conditional_t<is_pair, PairGranProxy, Parent>;
  check_liggghts(lmp, dynamic_cast<void*>(parent), sizeof(Loaded), is_pair ? "pair style" : "fix wall/gran");
  return new Made(lmp, parent, hash);
}

/// True: a tangential law of ours is built for these.
bool takes_own_tangential(const ModelIds& ids);
/// Notes that `tangential NAME` is of the normal model `normal`: with every other, and with models that are not
/// built, it stops with a sentence.
void refuse_other_normals(const std::string& name, int id, int normal);

/// The style of a normal and a tangential law, with the models of LIGGGHTS's that `hash` names.
template <class Interface, template <class> class Style, NormalPhysics Physics, class Tangential, class Parent>
Interface* make_contact(LAMMPS* lmp, Parent* parent, int64_t hash)
{
  const ModelIds ids = ModelIds::of(hash);
  check_particles(lmp, ids);
#ifdef SUPERQUADRIC_ACTIVE_FLAG
  if (ids.superquadric())
    return make_style<Interface, Style<ComposedContact<Physics, Tangential, Chosen, cm::SURFACE_SUPERQUADRIC>>>(lmp, parent, hash);
#endif
  if (ids.cohesion == cm::COHESION_OFF && ids.rolling == cm::ROLLING_OFF)
    return make_style<Interface, Style<ComposedContact<Physics, Tangential, Off>>>(lmp, parent, hash);
  return make_style<Interface, Style<ComposedContact<Physics, Tangential, Chosen>>>(lmp, parent, hash);
}

/// Makes `tangential NAME`, a TangentialLaw of ours, known for a normal model, with each cohesion and rolling model
/// that is built. `id`: six bits, which none of LIGGGHTS's has; restart files hold it.
template <NormalPhysics Physics, class Law>
void add_tangential(const char* name, int id)
{
  cm::Factory::instance().addTangentialModel(name, id);
  name_tangential(id, name);
  refuse_other_normals(name, id, Physics::id);
  each_combination(Physics::id, [id](ModelIds ids) {
    if (!takes_own_tangential(ids)) return;
    ids.tangential = id;
    const int hash = static_cast<int>(ids.hash());
    LIGGGHTS::PairStyles::Factory::instance().addStyle(
        "gran", hash, &make_contact<LIGGGHTS::PairStyles::IGranularPairStyle, PairStyle, Physics, Law, PairGran>);
    LIGGGHTS::Walls::Factory::instance().addStyle(
        "gran", hash, &make_contact<LIGGGHTS::Walls::IGranularWall, WallStyle, Physics, Law, FixWallGran>);
  });
}

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
    switch (ModelIds::of(hash).tangential) {
      case cm::TANGENTIAL_HISTORY: return make_contact<Interface, Style, Physics, Spring>(lmp, parent, hash);
      case cm::TANGENTIAL_NO_HISTORY: return make_contact<Interface, Style, Physics, ViscousFriction>(lmp, parent, hash);
      default: return make_contact<Interface, Style, Physics, Frictionless>(lmp, parent, hash);
    }
  }
};

}  // namespace granulaw::plugin
