#pragma once

#include <memory>
#include <string>

#include "farm/farm.hpp"

namespace granulaw {

/// The processes that a launcher (mpirun, mpiexec, srun) has started for one command. Without a launcher
/// there is one, and MPI is not started.

/// To be called once, before the command is carried out. `command` is the first word of the command line,
/// `shares_runs` its Command::on_ranks. Throws Error if there are several processes and the command is one
/// that runs in one only, or MPI is not built in. Ranks other than the first print nothing from here on.
void join_ranks(const std::string& command, bool shares_runs);

/// Rank among the launcher's processes, by its environment if join_ranks has not been called or has thrown.
int rank();
int ranks();

/// Makes the runs of this command on all its ranks; `cache` is used on the first.
std::unique_ptr<Farm> make_farm(int threads_each, RunCache cache);

/// Waits for the others and returns the exit code of all. `sentence` is why the code is not 0, empty if there
/// is nothing to say; one rank prints one.
int leave_ranks(int code, const std::string& sentence);

}  // namespace granulaw
