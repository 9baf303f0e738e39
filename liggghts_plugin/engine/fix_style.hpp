#pragma once

#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

using FixCreator = LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS*, int, char**);

/// Makes `name` a fix style of this LIGGGHTS; a style that is there already stays.
void register_fix_style(LAMMPS_NS::LAMMPS* lmp, const char* name, FixCreator create);

/// Makes Made a fix style `style`, and adds `fix ID all STYLE` where the box exists and the deck has no fix of the style. True: added.
template <class Made>
bool provide_fix(LAMMPS_NS::LAMMPS* lmp, const char* id, const char* style)
{
  register_fix_style(lmp, style, [](LAMMPS_NS::LAMMPS* l, int narg, char** arg) -> LAMMPS_NS::Fix* { return new Made(l, narg, arg); });
  if (!lmp->domain->box_exist || lmp->modify->find_fix_style_strict(style, 0)) return false;
  const char* arg[] = {id, "all", style};
  lmp->modify->add_fix(3, const_cast<char**>(arg));
  return true;
}

/// Makes `create` what the deck's fix or compute `name` is from now on: for classes that do what LIGGGHTS's
/// own do and more.
using ComputeCreator = LAMMPS_NS::Compute* (*)(LAMMPS_NS::LAMMPS*, int iarg, int, char**);
void replace_fix_style(LAMMPS_NS::LAMMPS* lmp, const char* name, FixCreator create);
void replace_compute_style(LAMMPS_NS::LAMMPS* lmp, const char* name, ComputeCreator create);

/// True where a fix moves particles: one that integrates in time, or multisphere, which sets no flag.
bool moves_particles(const LAMMPS_NS::Modify& modify);

/// While it lives, Modify's list can be searched and other fixes can be added although the constructor of
/// `unfinished` is still running. Modify enters a fix in its list after that: it would give the place to the
/// other, or, where it replaces a fix of the same id, hold a null pointer there that its searches follow.
class UnfinishedFix
{
 public:
  UnfinishedFix(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::Fix* unfinished);
  ~UnfinishedFix();
  UnfinishedFix(const UnfinishedFix&) = delete;
  UnfinishedFix& operator=(const UnfinishedFix&) = delete;

 private:
  LAMMPS_NS::Modify* modify_;
  bool entered_ = false;
};

}  // namespace granulaw::plugin
