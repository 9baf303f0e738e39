#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

namespace {

/// True once every rank is here; false where one is not: this one failed alone, and the others wait for it elsewhere.
bool all_arrive(MPI_Comm ranks)
{
  constexpr std::chrono::seconds patience(20);  // ranks that read the same deck are here within moments
  MPI_Request arrival;
  MPI_Ibarrier(ranks, &arrival);
  for (const auto start = std::chrono::steady_clock::now(); std::chrono::steady_clock::now() < start + patience;) {
    int is_complete = 0;
    MPI_Test(&arrival, &is_complete, MPI_STATUS_IGNORE);
    if (is_complete) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

void stop_all(LAMMPS_NS::LAMMPS* lmp, const std::string& message)
{
  for (std::FILE* out : {lmp->screen, lmp->logfile})
    if (out && lmp->comm->me == 0) std::fprintf(out, "ERROR: %s\n", message.c_str());
  std::fflush(nullptr);
  if (!all_arrive(lmp->world)) stop_one(lmp, message);
  if (lmp->universe->nworlds > 1) MPI_Abort(lmp->universe->uworld, 1);
  MPI_Finalize();
  std::exit(1);
}

void stop_one(LAMMPS_NS::LAMMPS* lmp, const std::string& message)
{
  const std::string line = fmt::format("ERROR on proc {}: {}\n", lmp->comm->me, message);
  std::fflush(nullptr);
  write_stats_at_stop(lmp, message);
  std::fputs(line.c_str(), stderr);
  if (lmp->logfile) std::fputs(line.c_str(), lmp->logfile);
  std::fflush(nullptr);
  MPI_Abort(lmp->world, 1);
  std::abort();
}

}  // namespace granulaw::plugin
