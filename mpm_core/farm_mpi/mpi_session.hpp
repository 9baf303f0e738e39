#pragma once

#include <functional>

namespace granulaw {

/// MPI, from MPI_Init to MPI_Finalize. One object in the life of a process; only the thread that made it may
/// use it and what is built on it.
class MpiSession
{
 public:
  /// Throws Error if this MPI cannot be used beside threads.
  MpiSession();
  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Waits for all ranks, ends MPI and returns the largest code (0: all is well). Of the ranks whose code is
  /// not 0, the first calls `complain`. A rank with another code than 0 that waits 10 s in vain is alone with
  /// its trouble: it complains and takes the others down (MPI_Abort), so that nobody waits for it for ever.
  int finish(int code, const std::function<void()>& complain);

 private:
  int rank_ = 0, size_ = 1;
  int last_words_ = 0;  ///< a communicator for finish() alone (MPI_Comm_c2f)
};

}  // namespace granulaw
