#include "farm_mpi/mpi_session.hpp"

#include <mpi.h>

#include <chrono>
#include <thread>

#include "base/error.hpp"

namespace granulaw {

MpiSession::MpiSession()
{
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED)
    fail("MPI", "this MPI does not allow threads beside it (MPI_THREAD_FUNNELED)");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm own;
  MPI_Comm_dup(MPI_COMM_WORLD, &own);
  last_words_ = MPI_Comm_c2f(own);
}

int MpiSession::finish(int code, const std::function<void()>& complain)
{
  using Clock = std::chrono::steady_clock;
  const auto patience = std::chrono::seconds(10);
  // the maximum over all ranks of the code, and of -rank where there is trouble: the first such rank
  const int mine[2] = {code, code ? -rank_ : -size_};
  int all[2] = {0, 0};
  MPI_Request request;
  MPI_Iallreduce(mine, all, 2, MPI_INT, MPI_MAX, MPI_Comm_f2c(last_words_), &request);
  const Clock::time_point start = Clock::now();
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) break;
    if (code && Clock::now() - start > patience) {
      complain();
      MPI_Abort(MPI_COMM_WORLD, code);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (code && all[1] == -rank_) complain();
  MPI_Finalize();
  return all[0];
}

}  // namespace granulaw
