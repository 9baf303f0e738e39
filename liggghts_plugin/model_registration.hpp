#pragma once

#include "liggghts_plugin/combinations.hpp"
#include "liggghts_plugin/pair_style.hpp"
#include "liggghts_plugin/plastic_model.hpp"
#include "liggghts_plugin/wall_style.hpp"

namespace granulaw::plugin {

/// Makes the model known to LIGGGHTS and to models(), and gives every combination that is not built a creator
/// that refuses it in a sentence: LIGGGHTS would say "Unknown normal model".
void add_model(const ModelInfo& model);

/// Registers a model when the library is loaded: one static object in each register_NAME.cpp. Runs in Open
/// MPI's helper processes as well, which inherit LD_PRELOAD: it must print nothing and read nothing.
template <NormalPhysics Physics>
class ModelRegistration
{
 public:
  ModelRegistration()
  {
    add_model(model_info<Physics>);
    add_tangential(BuiltTangential{});
  }

 private:
  template <int... tangential>
  void add_tangential(Ids<tangential...>)
  {
    (add_cohesion<tangential>(BuiltCohesion{}), ...);
  }
  template <int tangential, int... cohesion>
  void add_cohesion(Ids<cohesion...>)
  {
    (add_rolling<tangential, cohesion>(BuiltRolling{}), ...);
  }
  template <int tangential, int cohesion, int... rolling>
  void add_rolling(Ids<rolling...>)
  {
    (add<tangential, cohesion, rolling>(), ...);
  }

  template <int tangential, int cohesion, int rolling, int surface = cm::SURFACE_DEFAULT>
  void add()
  {
    using Style = cm::GranStyle<Physics::id, tangential, cohesion, rolling, surface>;
    LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", Style::HASHCODE,
                                                       &make_pair_style<Style, Physics>);
    LIGGGHTS::Walls::Factory::instance().addStyle("gran", Style::HASHCODE, &make_wall_style<Style, Physics>);
    if constexpr (surface == cm::SURFACE_DEFAULT && surface_is_built(cm::SURFACE_SUPERQUADRIC, cohesion))
      add<tangential, cohesion, rolling, cm::SURFACE_SUPERQUADRIC>();
  }
};

}  // namespace granulaw::plugin
