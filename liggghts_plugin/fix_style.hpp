#pragma once

#include "liggghts_plugin/liggghts.hpp"

namespace granulaw::plugin {

using FixCreator = LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS*, int, char**);

/// Makes `name` a fix style of this LIGGGHTS; a style that is there already stays.
void register_fix_style(LAMMPS_NS::LAMMPS* lmp, const char* name, FixCreator create);

}  // namespace granulaw::plugin
