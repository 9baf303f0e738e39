#pragma once

#include <string>

#include "law/chosen_pair.hpp"
#include "options.hpp"

namespace granulaw {

/// The first word after mpm, its options, and what it does. NAME_command.cpp defines one, NAME_command.
struct Command
{
  const char* name;
  const char* summary;               ///< of mpm NAME --help; its first clause of mpm --help
  void (*define)(Options& command);  ///< adds its options, and the callback that carries it out
  bool on_ranks = false;             ///< shares its runs among the processes of mpirun; others refuse them
  const char* alias = "";            ///< an older name
};

/// Options --pair, --radius and --radius2.
inline void define_pair_options(Options& command, PairAsked& asked)
{
  command.add_option("--pair", asked.pair, "a:b or a:wall; may be left out if the file holds one");
  command.add_option(
      "--radius", asked.radius, "radius of the first body, m (default 1e-3; e depends on no radius). A rate-dependent law allows only the\nradius that it was made for");
  command.add_option("--radius2", asked.radius2, "radius of the second body, m (default: the first's); inf: a thick deformable wall");
}

/// The command line as typed, for provenance; set by main.
extern std::string command_line;

}  // namespace granulaw
