#include "ranks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "base/error.hpp"
#include "material_file/plausible.hpp"
#ifdef GRANULAW_HAS_MPI
#include "farm_mpi/mpi_farm.hpp"
#endif

namespace granulaw {

namespace {

int from_environment(std::initializer_list<const char*> names, int without)
{
  for (const char* name : names)
    if (const char* value = std::getenv(name)) return std::max(0, std::atoi(value));
  return without;
}

struct Launched
{
  // Open MPI; MPICH, Intel MPI and srun --mpi=pmi2; srun --mpi=pmix
  int rank = from_environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"}, 0);
  int size = from_environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, std::getenv("PMIX_RANK") ? from_environment({"SLURM_STEP_NUM_TASKS"}, 1) : 1);
};

const Launched& launched()
{
  static const Launched values;
  return values;
}

#ifdef GRANULAW_HAS_MPI
std::optional<MpiSession> session;
#endif

}  // namespace

int rank() { return launched().rank; }

int ranks() { return launched().size; }

void join_ranks(const std::string& command, bool shares_runs)
{
  if (ranks() == 1) return;
  if (!shares_runs)
    fail(command, "runs in one process: start it without mpirun (mpm table shares its runs among ranks)", fmt::format("{} processes", ranks()),
        "1");
#ifdef GRANULAW_HAS_MPI
  session.emplace();
  if (session->rank() != 0) ask_nothing_of_units();
  if (session->rank() != 0 && !std::freopen("/dev/null", "w", stdout)) fail("/dev/null", "cannot be opened");
#else
  fail(command, "this program is built without MPI: start it without mpirun (--jobs sets the number of threads)",
      fmt::format("{} processes", ranks()), "1");
#endif
}

std::unique_ptr<Farm> make_farm(int threads_each, RunCache cache)
{
#ifdef GRANULAW_HAS_MPI
  if (session) return std::make_unique<MpiFarm>(*session, threads_each, std::move(cache));
#endif
  return std::make_unique<ThreadFarm>(threads_each, std::move(cache));
}

int leave_ranks(int code, const std::string& sentence)
{
  const auto complain = [&] {
    if (!sentence.empty()) fmt::print(stderr, "mpm: {}\n", sentence);
  };
#ifdef GRANULAW_HAS_MPI
  if (session) return session->finish(code, complain);
#endif
  // Nobody waits for anybody here, and a launcher ends all as soon as one fails: only the first may.
  if (rank() != 0) return 0;
  complain();
  return code;
}

}  // namespace granulaw
