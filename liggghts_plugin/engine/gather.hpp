#pragma once

#include <mpi.h>

#include <concepts>
#include <numeric>
#include <vector>

namespace granulaw::plugin {

/// The numbers of all ranks, one rank's behind the other's. Collective.
template <class Number>
  requires std::same_as<Number, int> || std::same_as<Number, double>
std::vector<Number> gather(const std::vector<Number>& own, MPI_Comm world)
{
  int ranks = 0, count = static_cast<int>(own.size());
  MPI_Comm_size(world, &ranks);
  std::vector<int> counts(static_cast<std::size_t>(ranks)), starts(counts.size(), 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  std::vector<Number> all(static_cast<std::size_t>(starts.back() + counts.back()));
  const auto collect = [&](auto type) {
    if (!all.empty()) MPI_Allgatherv(own.data(), count, type, all.data(), counts.data(), starts.data(), type, world);
  };
  collect(std::same_as<Number, int> ? MPI_INT : MPI_DOUBLE);
  return all;
}

}  // namespace granulaw::plugin
