#pragma once

#include <functional>
#include <string>
#include <vector>

#include "liggghts_plugin/liggghts.hpp"
#include "liggghts_plugin/session.hpp"
#include "liggghts_plugin/superquadric.hpp"

// How `pair_style gran` and `fix wall/gran` with a model of ours are read: our keywords into a Setup, the
// others to LIGGGHTS.
namespace granulaw::plugin {

/// What of a command depends on its models.
struct CommandModels
{
  ModelInfo normal;
  void (*read_keywords)(LAMMPS_NS::LAMMPS* lmp, Setup& setup);  ///< NormalPhysics::read_keywords
  int tangential, cohesion;                                     ///< ids
  long hash;                                                    ///< LIGGGHTS's number of the five
  bool superquadric;                                            ///< surface
};

/// Liquid bridges pull across a gap.
constexpr bool has_bridges(int cohesion)
{
  return cohesion == cm::COHESION_EASO_CAPILLARY_VISCOUS ||
         cohesion == cm::COHESION_WASHINO_CAPILLARY_VISCOUS;
}

/// Reads our own words of a command into `setup`; `call(nargs, args)` gets the others, with our setup being
/// current for the model's postSettings. Throws Error with one sentence. Collective.
void read_command(LAMMPS_NS::LAMMPS* lmp, const CommandModels& models, Setup& setup, int nargs, char** args,
                  const std::function<void(int, char**)>& call);

/// Runs `work`; what it throws ends the run on all ranks with one sentence. Nothing that a single rank may
/// fail at is thrown here without the ranks having agreed on it (load_law).
template <class Work>
void guarded(LAMMPS_NS::LAMMPS* lmp, Work&& work)
{
  try {
    work();
  } catch (const std::exception& failure) {
    stop_all(lmp, failure.what());
  }
}

/// The fixes that come with our models.
void provide_fixes(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin
