#pragma once

#include <exception>

#include "farm/farm.hpp"
#include "farm_mpi/mpi_session.hpp"

namespace granulaw {

/// Makes batches of runs on all ranks of MPI. Every rank builds the same list of jobs and calls run() with
/// it; every rank gets all outcomes, so that whatever follows is the same on each.
///
/// Rank 0 hands out the runs, the most expensive first, one for each thread of a rank at a time, and computes
/// as well. It alone reads and writes the cache, and keeps each result as it arrives. On every rank the runs
/// are made by threads of their own (worker_pool.hpp) while the calling thread, which alone uses MPI
/// (FUNNELED), looks for messages every 2 ms: about 1 % of a core (every 1 ms: 1.8 %, measured), where a
/// blocking MPI call would spin on one, and at most some 4 ms from the end of a run to the start of the next.
///
/// `progress` gets the fraction of the whole batch on rank 0; on the others it gets 0 and the rank's own run,
/// only to be asked whether to stop. If a rank has to stop (its `progress` throws, or a run ends in another
/// exception than Error), that exception goes through there, and every other rank throws FarmBroken with its
/// sentence, also where all runs of the batch had ended. A rank that dies is the launcher's business: mpirun ends the others.
class MpiFarm : public Farm
{
 public:
  /// `threads` for the runs on this rank; `cache` is used on rank 0 only.
  MpiFarm(const MpiSession& session, int threads, RunCache cache)
      : rank_(session.rank()), size_(session.size()), threads_(threads), cache_(std::move(cache))
  {
  }

 private:
  std::vector<RunOutcome> make(const std::vector<RunJob>& jobs, const Progress& progress) override;
  /// Threads of each rank. Throws Error (run(): FarmBroken), on all ranks, if their lists of jobs differ.
  std::vector<int> agree(const std::vector<RunJob>& jobs) const;
  /// Rank 0; `room`: threads without a run, for each rank. Returns the sentence of a rank that has to stop after the last
  /// run; empty: none has.
  std::string direct(RunQueue& queue, const std::vector<RunJob>& jobs, std::vector<int> room,
              const Progress& progress) const;
  /// The other ranks. Returns what this one has to stop for after the last run; null: nothing.
  std::exception_ptr work(const std::vector<RunJob>& jobs, const Progress& progress) const;

  int rank_, size_, threads_;
  RunCache cache_;
};

}  // namespace granulaw
