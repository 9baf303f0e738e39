#include "liggghts_plugin/books/rank_sums.hpp"

#include <vector>

namespace granulaw::plugin {

MPI_Op operation(Combine how)
{
  return how == Combine::sum ? MPI_SUM : how == Combine::largest ? MPI_MAX : MPI_MIN;
}

void reduce(ContactStatistics::Pair& counts, MPI_Comm world)
{
  for (const Combine how : {Combine::sum, Combine::largest, Combine::least}) {
    std::vector<double> values;
    for (const Quantity& q : quantities)
      if (q.combine == how) values.push_back(q.value.of(counts));
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, operation(how), world);
    const double* next = values.data();
    for (const Quantity& q : quantities)
      if (q.combine == how) q.value.of(counts) = *next++;
  }
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
