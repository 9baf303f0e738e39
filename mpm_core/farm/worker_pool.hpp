#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "farm/run_queue.hpp"

namespace granulaw {

/// Threads that make runs for one thread that directs them: so that progress, cache and messages between
/// ranks are the business of that one alone, and a run is independent of them.
class WorkerPool
{
 public:
  explicit WorkerPool(int threads);
  /// Runs under way end at their next report of progress.
  ~WorkerPool();

  bool has_room() const { return busy_ < slots_.size(); }
  bool idle() const { return busy_ == 0; }
  /// `job` must live until the run has ended. Needs room.
  void start(std::size_t index, const RunJob& job);

  struct Finished
  {
    std::size_t index;
    RunOutcome outcome;
    std::exception_ptr broken;  ///< what perform() let through
  };
  /// Jobs that have ended since the last call. Waits at most `patience` for one to end; empty at once if
  /// nothing is under way.
  std::vector<Finished> wait(std::chrono::milliseconds patience);

  struct Running
  {
    std::size_t index;
    double fraction;
  };
  std::vector<Running> running() const;

 private:
  struct Slot
  {
    const RunJob* job = nullptr;
    std::size_t index = 0;
    std::atomic<double> fraction = 0;
  };
  void work(Slot& slot);

  std::atomic<bool> stop_ = false;
  std::size_t busy_ = 0;
  mutable std::mutex mutex_;  ///< guards slots and finished_
  std::condition_variable started_, ended_;
  std::vector<Slot> slots_;
  std::vector<Finished> finished_;
  std::vector<std::jthread> threads_;
};

}  // namespace granulaw
