#pragma once

#include <string>
#include <vector>

// Programs and files that came with this one, and how they are run.
namespace granulaw {

/// A file beside this program or where an installation has it; empty: it is not there.
std::string own_file(const std::string& name);

/// A file in memory that holds `text`, to be closed by the caller. Throws Error, which `who` leads.
int memory_file(const std::string& who, const std::string& text = {});
/// All of a file or pipe from where it stands.
std::string read_all(int file);

/// A program to run; no shell is between.
struct Process
{
  std::vector<std::string> words;  ///< the program's path first
  std::string folder = {};         ///< where it starts; empty: here
  int input = -1;                  ///< file that it reads on stdin; below 0: this program's
  bool keeps_stdout = false;       ///< what it writes there is not heard, but goes where this program's does
};

struct Ended
{
  int exit = 0;      ///< its exit status; 127: it could not be started
  int signal = 0;    ///< that ended it; 0: none
  std::string said;  ///< what was heard
};

/// Runs it outside MPI (a rank's program would take itself for the rank). Throws Error, which its path leads.
Ended run_process(const Process& process);

}  // namespace granulaw
