#include "liggghts_plugin/particles/particle_columns.hpp"

#include <vector>

namespace granulaw::plugin {

ParticleColumns ParticleColumns::find(LAMMPS_NS::LAMMPS* lmp, const Spec& spec)
{
  return ParticleColumns(static_cast<LAMMPS_NS::FixPropertyAtom*>(
      lmp->modify->find_fix_property(spec.name, "property/atom", "vector", 0, 0, spec.name, false)));
}

ParticleColumns ParticleColumns::provide(LAMMPS_NS::LAMMPS* lmp, const Spec& spec)
{
  if (const ParticleColumns found = find(lmp, spec)) return found;
  const auto yes_or_no = [](bool yes) { return yes ? "yes" : "no"; };
  std::vector<const char*> arg{spec.fix_id ? spec.fix_id : spec.name,
                               "all",
                               "property/atom",
                               spec.name,
                               "vector",
                               yes_or_no(spec.restart),
                               yes_or_no(spec.to_ghosts),
                               yes_or_no(spec.from_ghosts)};
  arg.resize(arg.size() + static_cast<std::size_t>(spec.columns), "0.0");
  lmp->modify->add_fix_property_atom(static_cast<int>(arg.size()), const_cast<char**>(arg.data()), spec.name);
  return find(lmp, spec);
}

}  // namespace granulaw::plugin
