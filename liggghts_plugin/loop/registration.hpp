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

/// True: a piece of ours is built for these. `place`: where it stands, &ModelIds::tangential or cohesion.
bool takes_own(const ModelIds& ids, int ModelIds::*place);
/// Notes that the piece NAME is of the normal model `normal`: with every other, and with models that are not built, it stops with
/// a sentence.
void refuse_other_normals(const std::string& name, int id, int ModelIds::*place, int normal);

/// The style of a contact element, with the models of LIGGGHTS's that `hash` names.
template <class Interface, template <class> class Style, NormalPhysics Physics, class Tangential, class Beside, class Parent>
Interface* make_contact(LAMMPS* lmp, Parent* parent, int64_t hash)
{
  const ModelIds ids = ModelIds::of(hash);
  check_particles(lmp, ids);
#ifdef SUPERQUADRIC_ACTIVE_FLAG
  if (ids.superquadric())
    return make_style<Interface, Style<ComposedContact<Physics, Tangential, Beside, Chosen, cm::SURFACE_SUPERQUADRIC>>>(lmp, parent, hash);
#endif
  if ((ids.cohesion == cm::COHESION_OFF || !std::same_as<Beside, NothingBeside>) && ids.rolling == cm::ROLLING_OFF)
    return make_style<Interface, Style<ComposedContact<Physics, Tangential, Beside, Off>>>(lmp, parent, hash);
  return make_style<Interface, Style<ComposedContact<Physics, Tangential, Beside, Chosen>>>(lmp, parent, hash);
}
/// The same with LIGGGHTS's tangential models, which are ours by those names.
template <class Interface, template <class> class Style, NormalPhysics Physics, class Beside, class Parent>
Interface* make_with_usual_tangential(LAMMPS* lmp, Parent* parent, int64_t hash)
{
  switch (ModelIds::of(hash).tangential) {
    case cm::TANGENTIAL_HISTORY: return make_contact<Interface, Style, Physics, Spring, Beside>(lmp, parent, hash);
    case cm::TANGENTIAL_NO_HISTORY: return make_contact<Interface, Style, Physics, ViscousFriction, Beside>(lmp, parent, hash);
    default: return make_contact<Interface, Style, Physics, Frictionless, Beside>(lmp, parent, hash);
  }
}

/// Makes a piece of ours known for a normal model, with each of LIGGGHTS's that is built. `id`: six bits, which none of
/// LIGGGHTS's has; restart files hold it.
template <NormalPhysics Physics>
void add_piece(const char* name, int id, int ModelIds::*place, PairMaker pair, WallMaker wall)
{
  name_piece(place, id, name);
  refuse_other_normals(name, id, place, Physics::id);
  each_combination(Physics::id, [&](ModelIds ids) {
    if (!takes_own(ids, place)) return;
    ids.*place = id;
    const int hash = static_cast<int>(ids.hash());
    LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", hash, pair);
    LIGGGHTS::Walls::Factory::instance().addStyle("gran", hash, wall);
  });
}
/// `tangential NAME`: a TangentialLaw.
template <NormalPhysics Physics, class Law>
void add_tangential(const char* name, int id)
{
  cm::Factory::instance().addTangentialModel(name, id);
  add_piece<Physics>(name, id, &ModelIds::tangential,
                     &make_contact<LIGGGHTS::PairStyles::IGranularPairStyle, PairStyle, Physics, Law, NothingBeside, PairGran>,
                     &make_contact<LIGGGHTS::Walls::IGranularWall, WallStyle, Physics, Law, NothingBeside, FixWallGran>);
}
/// `cohesion NAME`: a piece that StandsBeside the laws, made of the normal law and its number of the pair of types
/// (`Piece::property`, a peratomtypepair property of the deck).
template <NormalPhysics Physics, class Piece>
void add_beside(const char* name, int id)
{
  cm::Factory::instance().addCohesionModel(name, id);
  add_piece<Physics>(name, id, &ModelIds::cohesion,
                     &make_with_usual_tangential<LIGGGHTS::PairStyles::IGranularPairStyle, PairStyle, Physics, Piece, PairGran>,
                     &make_with_usual_tangential<LIGGGHTS::Walls::IGranularWall, WallStyle, Physics, Piece, FixWallGran>);
}

/// Registers a model when the library is loaded: one static object in each register_NAME.cpp. Runs in Open
/// MPI's helper processes as well, which inherit LD_PRELOAD: it must print nothing and read nothing.
template <NormalPhysics Physics>
class ModelRegistration
{
 public:
  ModelRegistration()
  {
    add_model(model_info<Physics>,
              &make_with_usual_tangential<LIGGGHTS::PairStyles::IGranularPairStyle, PairStyle, Physics, NothingBeside, PairGran>,
              &make_with_usual_tangential<LIGGGHTS::Walls::IGranularWall, WallStyle, Physics, NothingBeside, FixWallGran>);
  }
};

}  // namespace granulaw::plugin
