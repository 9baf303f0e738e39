#pragma once

#include <mpi.h>

#include "liggghts_plugin/books/contact_statistics.hpp"

namespace granulaw::plugin {

/// The same rule in MPI.
MPI_Op operation(Combine how);

/// Makes sums, largest and least values those of all ranks. Collective.
void reduce(ContactStatistics::Pair& counts, MPI_Comm world);

}  // namespace granulaw::plugin
