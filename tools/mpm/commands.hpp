#pragma once

#include <array>

#include "command.hpp"

// All commands, in the order of mpm --help: group, name. To add one, write NAME_command.cpp, which defines
// `extern const Command NAME_command`, and put its name here.
#define MPM_COMMANDS(ENTRY)        \
  ENTRY("Laws", table)             \
  ENTRY("Laws", law)               \
  ENTRY("Laws", info)              \
  ENTRY("Laws", plot)              \
  ENTRY("Laws", export)            \
  ENTRY("Laws", check)             \
  ENTRY("Laws", shape)             \
  ENTRY("LIGGGHTS decks", convert) \
  ENTRY("LIGGGHTS decks", plan)    \
  ENTRY("LIGGGHTS decks", stretch) \
  ENTRY("Measurements", calibrate) \
  ENTRY("Measurements", design)    \
  ENTRY("Solver", impact)          \
  ENTRY("Solver", press)           \
  ENTRY("Solver", oblique)         \
  ENTRY("Solver", compact)

namespace granulaw {

#define MPM_DECLARE(GROUP, NAME) extern const Command NAME##_command;
MPM_COMMANDS(MPM_DECLARE)
#undef MPM_DECLARE

struct CommandEntry
{
  const char* group;
  const Command* command;
};

#define MPM_ENTRY(GROUP, NAME) CommandEntry{GROUP, &NAME##_command},
inline const std::array commands{MPM_COMMANDS(MPM_ENTRY)};
#undef MPM_ENTRY

}  // namespace granulaw
