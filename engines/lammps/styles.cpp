// Registration of pair_style granulaw and fix wall/granulaw. LAMMPS calls post_create() at its start and after `clear`: this library's stands in front of it, for
// the launcher and under LD_PRELOAD. `plugin load` of a LAMMPS with the package PLUGIN calls lammpsplugin_init().
#include <dlfcn.h>

#include "fix_granulaw_history.hpp"
#include "fix_wall_granulaw.hpp"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "pair_granulaw.hpp"
#if __has_include("version.h")
#include "version.h"  // of a LAMMPS source tree; Debian leaves it out
#endif

namespace {

using LAMMPS_NS::LAMMPS;

LAMMPS_NS::Pair* pair(LAMMPS* lmp)
{
  return new granulaw::lammps::PairGranulaw(lmp);
}
template <class Style>
LAMMPS_NS::Fix* fix(LAMMPS* lmp, int narg, char** arg)
{
  return new Style(lmp, narg, arg);
}

/// A plugin as LAMMPS registers it: the struct of its plugin header, which Debian leaves out.
struct Plugin
{
  const char *version, *style, *name, *info, *author;
  void* creator;
  void* handle;
};

}  // namespace

/// `plugin load liblammps_granulaw.so`. `add` is void(Plugin*, void* lmp).
extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void* lmp, void* handle, void* add)
{
  const auto enter = reinterpret_cast<void (*)(Plugin*, void*)>(add);
#ifdef LAMMPS_VERSION
  const char* built_for = LAMMPS_VERSION;
#else
  const char* built_for = static_cast<LAMMPS*>(lmp)->version;
#endif
  const auto style = [&](const char* kind, const char* name, void* creator) {
    Plugin plugin{built_for, kind, name, "Granulaw's contact laws", "Granulaw", creator, handle};
    enter(&plugin, lmp);
  };
  style("pair", "granulaw", reinterpret_cast<void*>(&pair));
  style("fix", "granulaw/history", reinterpret_cast<void*>(&fix<granulaw::lammps::FixGranulawHistory>));
  style("fix", "wall/granulaw", reinterpret_cast<void*>(&fix<granulaw::lammps::FixWallGranulaw>));
}

__attribute__((visibility("default"))) void LAMMPS::post_create()
{
  // LAMMPS's own
  if (const auto next = reinterpret_cast<void (*)(LAMMPS*)>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6LAMMPS11post_createEv"))) next(this);
  const auto enter = [](Plugin* plugin, void* lmp) {
    auto& of = *static_cast<LAMMPS*>(lmp);
    if (plugin->style == std::string("pair")) (*of.force->pair_map)[plugin->name] = reinterpret_cast<LAMMPS_NS::Force::PairCreator>(plugin->creator);
    else (*of.modify->fix_map)[plugin->name] = reinterpret_cast<LAMMPS_NS::Modify::FixCreator>(plugin->creator);
  };
  lammpsplugin_init(this, nullptr, reinterpret_cast<void*>(static_cast<void (*)(Plugin*, void*)>(enter)));
}
