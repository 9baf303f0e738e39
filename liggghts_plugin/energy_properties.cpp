#include "liggghts_plugin/energy_properties.hpp"

#include "liggghts_plugin/session.hpp"

namespace granulaw::plugin {

namespace {

constexpr const char* fix_name = "granulaw/stats";  // who asks
constexpr const char* energy_name = "granulaw_energy";
/// Of `computeDissipatedEnergy on`, as LIGGGHTS's own models make it: energy, and six places that they work
/// with.
constexpr const char *dissipated_id = "dissipated_energy_", *dissipated_name = "dissipated_energy";

LAMMPS_NS::FixPropertyAtom* dissipated_property(LAMMPS_NS::LAMMPS* lmp)
{
  return static_cast<LAMMPS_NS::FixPropertyAtom*>(
      lmp->modify->find_fix_property(dissipated_name, "property/atom", "vector", 0, 0, fix_name, false));
}

/// The per-atom property that EnergyTally fills; it moves with the particles and into restart files.
LAMMPS_NS::FixPropertyAtom* energy_property(LAMMPS_NS::LAMMPS* lmp)
{
  return static_cast<LAMMPS_NS::FixPropertyAtom*>(
      lmp->modify->find_fix_property(energy_name, "property/atom", "vector", 0, 0, fix_name, false));
}

void provide_energy_property(LAMMPS_NS::LAMMPS* lmp)
{
  if (!Session::of(lmp)->energy || energy_property(lmp)) return;
  const char* arg[] = {energy_name, "all", "property/atom", energy_name, "vector", "yes",
                       "no",        "no",  "0.0",           "0.0",       "0.0"};
  lmp->modify->add_fix_property_atom(11, const_cast<char**>(arg), fix_name);
}

void provide_dissipated_property(LAMMPS_NS::LAMMPS* lmp)
{
  if (!Session::of(lmp)->dissipated_energy || dissipated_property(lmp)) return;
  const char* arg[] = {dissipated_id, "all", "property/atom", dissipated_name, "vector", "yes", "yes", "no",
                       "0.0",         "0.0", "0.0",           "0.0",           "0.0",    "0.0", "0.0"};
  lmp->modify->add_fix_property_atom(15, const_cast<char**>(arg), fix_name);
}

}  // namespace

void provide_energy_properties(LAMMPS_NS::LAMMPS* lmp)
{
  provide_energy_property(lmp);
  provide_dissipated_property(lmp);
}

void find_energy_properties(LAMMPS_NS::LAMMPS* lmp, EnergyTally& books, bool dissipated_energy)
{
  LAMMPS_NS::FixPropertyAtom* property = energy_property(lmp);
  books.per_atom = property ? property->array_atom : nullptr;
  LAMMPS_NS::FixPropertyAtom* dissipated = dissipated_energy ? dissipated_property(lmp) : nullptr;
  books.dissipated_energy = dissipated ? dissipated->array_atom : nullptr;
}

void clear_stored_energy(LAMMPS_NS::LAMMPS* lmp, EnergyTally& books)
{
  for (int a = 0; books.per_atom && a < lmp->atom->nlocal; ++a) books.per_atom[a][EnergyTally::stored] = 0.0;
}

}  // namespace granulaw::plugin
