#include "liggghts_plugin/rank_sums.hpp"

namespace granulaw::plugin {

void reduce(ContactLedger::Side& side, MPI_Comm world)
{
  using Side = ContactLedger::Side;
  const auto numbers = side.numbers();
  double values[Side::sums + Side::maxima + Side::minima];
  for (std::size_t k = 0; k < numbers.size(); ++k) values[k] = *numbers[k];
  double *largest = values + Side::sums, *least = largest + Side::maxima;
  MPI_Allreduce(MPI_IN_PLACE, values, Side::sums, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, largest, Side::maxima, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, least, Side::minima, MPI_DOUBLE, MPI_MIN, world);
  for (std::size_t k = 0; k < numbers.size(); ++k) *numbers[k] = values[k];
  MPI_Allreduce(MPI_IN_PLACE, side.speed.count.data(), LogHistogram::bins, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, side.overlap.count.data(), LogHistogram::bins, MPI_DOUBLE, MPI_SUM, world);
  int mapped = side.map.empty() ? 0 : 1;  // one rank may have it alone, out of a restart file
  MPI_Allreduce(MPI_IN_PLACE, &mapped, 1, MPI_INT, MPI_MAX, world);
  if (!mapped) return;
  side.open_map();
  MPI_Allreduce(MPI_IN_PLACE, side.map.data(), static_cast<int>(side.map.size()), MPI_DOUBLE, MPI_SUM, world);
}

}  // namespace granulaw::plugin
