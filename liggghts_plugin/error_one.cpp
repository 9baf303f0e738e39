// LIGGGHTS's error->one in this process: its own writes to a stream that MPI_Abort drops, to no log, and now and then a
// joke from memory that it has freed.
#pragma GCC visibility push(default)
#include "error.h"
#pragma GCC visibility pop

#include <mpi.h>

#include <cstdio>

#include "universe.h"

void LAMMPS_NS::Error::one(const char* file, int line, const char* text)
{
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  const auto say = [&](std::FILE* to) { std::fprintf(to, "ERROR on proc %d: %s (%s:%d)\n", rank, text, file, line); };
  if (screen) say(screen);
  if (screen != stdout) say(stderr);
  if (logfile) say(logfile);
  if (universe->nworlds > 1 && universe->uscreen && universe->uscreen != screen) say(universe->uscreen);
  MPI_Abort(world, 1);
}
