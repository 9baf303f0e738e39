#pragma once

#include <mpi.h>

#include "liggghts_plugin/ledger.hpp"

namespace granulaw::plugin {

/// Makes sums, largest and least values those of all ranks. Collective.
void reduce(ContactLedger::Side& side, MPI_Comm world);

}  // namespace granulaw::plugin
