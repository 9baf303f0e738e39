#pragma once

#include <array>

#include "command.hpp"

// All commands, in the order of mpm --help. To add one, write NAME_command.cpp, which defines
// `extern const Command NAME_command`, and put its name here.
#define MPM_COMMANDS(ENTRY) \
  ENTRY(impact)             \
  ENTRY(press)              \
  ENTRY(oblique)            \
  ENTRY(table)              \
  ENTRY(atlas)              \
  ENTRY(law)                \
  ENTRY(check)              \
  ENTRY(info)               \
  ENTRY(plot)               \
  ENTRY(export)             \
  ENTRY(shape)              \
  ENTRY(calibrate)          \
  ENTRY(design)             \
  ENTRY(plan)               \
  ENTRY(soften)             \
  ENTRY(convert)

namespace granulaw {

#define MPM_DECLARE(NAME) extern const Command NAME##_command;
MPM_COMMANDS(MPM_DECLARE)
#undef MPM_DECLARE

#define MPM_ADDRESS(NAME) &NAME##_command,
inline const std::array commands{MPM_COMMANDS(MPM_ADDRESS)};
#undef MPM_ADDRESS

}  // namespace granulaw
