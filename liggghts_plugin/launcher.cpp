// liggghts-mpm: LIGGGHTS with the models `mpm` and `thornton`. The stock main(), linked to the plug-in's
// library.
#include <mpi.h>

#include <csignal>
#include <cstdlib>
#include <cstring>

#include "input.h"
#include "lammps.h"
#include "signal_handling.h"

/// contact_history.hpp, of the plug-in's library
extern "C" void granulaw_provide_contact_histories(LAMMPS_NS::LAMMPS* lmp);

int main(int argc, char** argv)
{
  struct sigaction on_interrupt, on_user;
  std::memset(&on_interrupt, 0, sizeof on_interrupt);
  std::memset(&on_user, 0, sizeof on_user);
  on_interrupt.sa_handler = LAMMPS_NS::SignalHandler::int_handler;
  on_user.sa_handler = LAMMPS_NS::SignalHandler::usr1_handler;
  sigaction(SIGINT, &on_interrupt, nullptr);
  sigaction(SIGTERM, &on_interrupt, nullptr);  // mpirun turns an interrupt into SIGTERM for its children
  sigaction(SIGUSR1, &on_user, nullptr);

  // Else Open MPI starts a daemon where there is no mpirun, which takes 0.4 s.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  MPI_Init(&argc, &argv);
  auto* lammps = new LAMMPS_NS::LAMMPS(argc, argv, MPI_COMM_WORLD);
  granulaw_provide_contact_histories(lammps);
  lammps->input->file();
  delete lammps;
  MPI_Finalize();
  return 0;
}
