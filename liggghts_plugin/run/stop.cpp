#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

void stop_all(LAMMPS_NS::LAMMPS* lmp, const std::string& message)
{
  MPI_Barrier(lmp->world);
  for (std::FILE* out : {lmp->screen, lmp->logfile})
    if (out && lmp->comm->me == 0) std::fprintf(out, "ERROR: %s\n", message.c_str());
  std::fflush(nullptr);
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
