#pragma once

#include <string>

#include "options.hpp"

namespace granulaw {

/// The first word after mpm, its options, and what it does. NAME_command.cpp defines one, NAME_command.
struct Command
{
  const char* name;
  const char* summary;                ///< of mpm NAME --help; its first clause of mpm --help
  void (*define)(Options& command);  ///< adds its options, and the callback that carries it out
  bool on_ranks = false;              ///< shares its runs among the processes of mpirun; others refuse them
  const char* alias = "";             ///< an older name
};

/// The command line as typed, for provenance; set by main.
extern std::string command_line;

}  // namespace granulaw
