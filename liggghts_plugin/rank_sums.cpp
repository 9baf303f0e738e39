#include "liggghts_plugin/rank_sums.hpp"

namespace granulaw::plugin {

void reduce(ContactStatistics::Pair& counts, MPI_Comm world)
{
  using Pair = ContactStatistics::Pair;
  const auto numbers = counts.numbers();
  double values[Pair::sums + Pair::maxima + Pair::minima];
  for (std::size_t k = 0; k < numbers.size(); ++k) values[k] = *numbers[k];
  double *largest = values + Pair::sums, *least = largest + Pair::maxima;
  MPI_Allreduce(MPI_IN_PLACE, values, Pair::sums, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, largest, Pair::maxima, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, least, Pair::minima, MPI_DOUBLE, MPI_MIN, world);
  for (std::size_t k = 0; k < numbers.size(); ++k) *numbers[k] = values[k];
  MPI_Allreduce(MPI_IN_PLACE, counts.speed.count.data(), LogHistogram::bins, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, counts.overlap.count.data(), LogHistogram::bins, MPI_DOUBLE, MPI_SUM, world);
  int mapped = counts.map.empty() ? 0 : 1;  // one rank may have it alone, out of a restart file
  MPI_Allreduce(MPI_IN_PLACE, &mapped, 1, MPI_INT, MPI_MAX, world);
  if (!mapped) return;
  counts.open_map();
  MPI_Allreduce(MPI_IN_PLACE, counts.map.data(), static_cast<int>(counts.map.size()), MPI_DOUBLE, MPI_SUM,
                world);
}

}  // namespace granulaw::plugin
