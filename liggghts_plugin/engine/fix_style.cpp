#include "liggghts_plugin/engine/fix_style.hpp"

#include <algorithm>
#include <string_view>

#include "liggghts_plugin/engine/private_members.hpp"

namespace granulaw::plugin {

// Modify's maps are private, and LIGGGHTS has no call that adds a style.
GRANULAW_EXPOSE(FixMapTag, LAMMPS_NS::Modify, fix_map);
GRANULAW_EXPOSE(ComputeMapTag, LAMMPS_NS::Modify, compute_map);

void register_fix_style(LAMMPS_NS::LAMMPS* lmp, const char* name, FixCreator create)
{
  (lmp->modify->*exposed(FixMapTag{}))->emplace(name, create);
}

void replace_fix_style(LAMMPS_NS::LAMMPS* lmp, const char* name, FixCreator create)
{
  (*(lmp->modify->*exposed(FixMapTag{})))[name] = create;
}

void replace_compute_style(LAMMPS_NS::LAMMPS* lmp, const char* name, ComputeCreator create)
{
  (*(lmp->modify->*exposed(ComputeMapTag{})))[name] = create;
}

bool moves_particles(const LAMMPS_NS::Modify& modify)
{
  return std::any_of(modify.fix, modify.fix + modify.nfix, [](const LAMMPS_NS::Fix* fix) {
    return fix->time_integrate || std::string_view(fix->style).starts_with("multisphere");
  });
}

UnfinishedFix::UnfinishedFix(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::Fix* unfinished) : modify_(lmp->modify)
{
  // Modify::add_fix has emptied the place of the fix that it replaces, or made room behind the last one
  for (int f = 0; f < modify_->nfix; ++f)
    if (!modify_->fix[f]) {
      modify_->fix[f] = unfinished;
      return;
    }
  modify_->fix[modify_->nfix++] = unfinished;
  entered_ = true;
}

UnfinishedFix::~UnfinishedFix()
{
  if (entered_) --modify_->nfix;  // add_fix counts it when the constructor is done, whatever came behind it
}

}  // namespace granulaw::plugin
