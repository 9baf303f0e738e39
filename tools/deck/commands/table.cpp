#include "deck/commands/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "deck/commands/data_file.hpp"
#include "deck/commands/insertion.hpp"
#include "deck/commands/materials.hpp"
#include "deck/commands/meshes.hpp"
#include "deck/commands/motions.hpp"
#include "deck/commands/pair_style.hpp"
#include "deck/commands/particles.hpp"
#include "deck/commands/regions.hpp"
#include "deck/commands/runs.hpp"
#include "deck/commands/settings.hpp"
#include "deck/commands/templates.hpp"
#include "deck/commands/walls.hpp"

namespace granulaw::deck {

namespace {

void follow_fix(Reading& reading, Words words);
void follow_unfix(Reading& reading, Words words);

struct CommandEntry
{
  std::string_view name;
  CommandHandler follow;
};

/// The commands that bear on a plan. To follow a new one: a line here, and its handler in the file of its
/// concept. `variable`, `if`, `include`, `label`, `jump` and `next` are the script's own (deck/script.hpp).
constexpr std::array commands{
    CommandEntry{"atom_style", follow_atom_style},
    CommandEntry{"boundary", follow_boundary},
    CommandEntry{"clear", refuse_clear},
    CommandEntry{"create_atoms", follow_create_atoms},
    CommandEntry{"create_box", follow_create_box},
    CommandEntry{"displace_atoms", follow_displacement},
    CommandEntry{"displace_box", follow_displacement},
    CommandEntry{"fix", follow_fix},
    CommandEntry{"lattice", follow_lattice},
    CommandEntry{"pair_style", follow_pair_style},
    CommandEntry{"read_data", follow_read_data},
    CommandEntry{"read_restart", follow_read_restart},
    CommandEntry{"region", follow_region},
    CommandEntry{"run", follow_run},
    CommandEntry{"set", follow_set},
    CommandEntry{"timestep", follow_timestep},
    CommandEntry{"unfix", follow_unfix},
    CommandEntry{"units", follow_units},
    CommandEntry{"velocity", follow_velocity},
};

/// The commands that have no bearing on a plan.
constexpr std::string_view without_bearing[] = {
    "atom_modify",
    "bond_coeff",
    "bond_style",
    "box",
    "change_box",
    "coarsegraining",
    "communicate",
    "compute",
    "compute_modify",
    "debug",
    "delete_atoms",
    "dielectric",
    "dimension",
    "dump",
    "dump_modify",
    "echo",
    "fix_modify",
    "group",
    "hard_particles",
    "info",
    "log",
    "mass",
    "min_style",
    "minimize",
    "modify_timing",
    "neigh_modify",
    "neighbor",
    "newton",
    "pair_coeff",
    "partition",
    "print",
    "processors",
    "quit",
    "replicate",
    "reset_timestep",
    "restart",
    "run_style",
    "shell",
    "soft_particles",
    "suffix",
    "thermo",
    "thermo_log",
    "thermo_modify",
    "thermo_style",
    "timer",
    "uncompute",
    "undump",
    "write_data",
    "write_dump",
    "write_restart",
};

struct FixEntry
{
  std::string_view style;  // "insert/*": every style that begins with "insert/"
  FixHandler follow;
};

/// The styles of `fix` that bear on a plan; of two that match, the first. To follow a new one: a line here,
/// and its handler in the file of its concept.
constexpr std::array fixes{
    FixEntry{"adapt", follow_adapt},
    FixEntry{"addforce", follow_force},
    FixEntry{"aveforce", follow_force},
    FixEntry{"couple/*", follow_force},
    FixEntry{"drag", follow_force},
    FixEntry{"efield", follow_force},
    FixEntry{"external", follow_force},
    FixEntry{"gravity", follow_gravity},
    FixEntry{"insert/*", follow_insertion},
    FixEntry{"mesh/surface*", follow_mesh},
    FixEntry{"move", follow_force},
    FixEntry{"move/mesh", follow_motion},
    FixEntry{"multisphere", follow_clumps},
    FixEntry{"nve/limit*", follow_force},
    FixEntry{"particledistribution/*", follow_distribution},
    FixEntry{"particletemplate/*", follow_template},
    FixEntry{"property/global", follow_property},
    FixEntry{"rigid", follow_clumps},
    FixEntry{"rigid/*", follow_clumps},
    FixEntry{"setforce", follow_force},
    FixEntry{"spring", follow_force},
    FixEntry{"spring/*", follow_force},
    FixEntry{"wall/gran", follow_wall},
    FixEntry{"wall/gran/*", follow_wall},
    FixEntry{"wall/*", refuse_wall},
};

/// The styles that measure, print, integrate, or only slow particles down.
constexpr std::string_view fixes_without_bearing[] = {
    "ave/atom",
    "ave/correlate",
    "ave/euler",
    "ave/euler/stress",
    "ave/histo",
    "ave/spatial",
    "ave/time",
    "buoyancy",
    "check/timestep/gran",
    "contacthistory",
    "contacthistory/mesh",
    "contactproperty/atom",
    "contactproperty/atom/wall",
    "continuum/weighted",
    "custom_property/global",
    "diam/max",
    "enforce2d",
    "freeze",
    "granulaw/runaway",
    "granulaw/stats",
    "heat/gran",
    "heat/gran/conduction",
    "lineforce",
    "massflow/mesh",
    "massflow/mesh/sieve",
    "multicontact/halfspace",
    "neighlist/mesh",
    "nve",
    "nve/asphere",
    "nve/asphere/noforce",
    "nve/noforce",
    "nve/sphere",
    "nve/superquadric",
    "planeforce",
    "print",
    "property/atom",
    "property/atom/regiontracer/time",
    "property/atom/timetracer",
    "property/atom/tracer",
    "property/atom/tracer/stream",
    "property/atomtype",
    "property/atomtypepair",
    "region/variable",
    "store/force",
    "store/state",
    "transportequation/scalar",
    "viscous",
};

bool matches(std::string_view pattern, std::string_view style)
{
  return pattern.ends_with('*') ? style.starts_with(pattern.substr(0, pattern.size() - 1)) : style == pattern;
}

void follow_fix(Reading& reading, Words w)
{
  Fix fix;
  fix.id = w.word();
  w.word();  // group
  fix.style = w.word();
  for (const FixEntry& entry : fixes)
    if (matches(entry.style, fix.style)) return entry.follow(reading, fix, w);
  if (std::find(std::begin(fixes_without_bearing), std::end(fixes_without_bearing), fix.style) !=
      std::end(fixes_without_bearing))
    return;
  std::vector<std::string> known(std::begin(fixes_without_bearing), std::end(fixes_without_bearing));
  for (const FixEntry& entry : fixes)
    if (!entry.style.ends_with('*')) known.emplace_back(entry.style);
  misread("it is not known to mpm plan", fix.style, known);
}

void follow_unfix(Reading& reading, Words w)
{
  const std::string id = w.word();
  reading.insertions.erase(id);
  reading.motions.erase(id);
}

CommandHandler handler_of(const std::string& name)
{
  std::vector<std::string> known(std::begin(without_bearing), std::end(without_bearing));
  for (const CommandEntry& entry : commands) {
    if (entry.name == name) return entry.follow;
    known.emplace_back(entry.name);
  }
  misread("it is not known to mpm plan", name, known);
}

/// The command as notes call it.
std::string title(const Command& c)
{
  return c.words[0] == "fix" && c.words.size() > 3 ? "fix " + c.words[3] : c.words[0];
}

}  // namespace

void follow(Reading& reading, const Command& c)
{
  const std::string& name = c.words[0];
  if (std::find(std::begin(without_bearing), std::end(without_bearing), name) != std::end(without_bearing))
    return;
  try {
    if (!c.unknown.empty()) misread(c.unknown);
    handler_of(name)(reading, Words(c));
  } catch (const Unknown& error) {
    reading.note(c.where, fmt::format("'{}' is not followed: {}", title(c), error.what()));
  }
}

}  // namespace granulaw::deck
