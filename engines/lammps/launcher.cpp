// lmp with pair_style granulaw and fix wall/granulaw: the arguments of lmp.
#include "lammps_fmt.hpp"

#include <mpi.h>

#include "input.h"
#include "lammps.h"

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  {
    LAMMPS_NS::LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    lammps.input->file();
  }
  MPI_Finalize();
}
