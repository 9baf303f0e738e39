#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace granulaw {

/// Threads for loops whose passes are independent of each other. Each pass has its own result, so that the
/// outcome is the same with any number of threads.
class Parallel
{
 public:
  /// `threads`: the caller's own included.
  explicit Parallel(int threads);
  ~Parallel();
  Parallel(const Parallel&) = delete;
  Parallel& operator=(const Parallel&) = delete;
  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls task(k, thread) for k from 0 to count - 1; `thread`: from 0 to threads() - 1. Throws what a pass
  /// threw first.
  template <class Task>
  void each(int count, Task&& task)
  {
    run(
        count,
        [](void* t, int k, int thread) { (*static_cast<std::remove_reference_t<Task>*>(t))(k, thread); },
        &task);
  }

 private:
  using Call = void (*)(void*, int, int);
  void run(int count, Call call, void* task);
  void work(int thread);
  void take(int thread);

  std::mutex mutex_;
  std::condition_variable begun_, ended_;
  long round_ = 0;  // guarded, as busy_, stop_ and failed_
  int busy_ = 0;
  bool stop_ = false;
  std::exception_ptr failed_;
  std::atomic<int> next_ = 0;
  int count_ = 0;
  Call call_ = nullptr;
  void* task_ = nullptr;
  std::vector<std::thread> workers_;
};

}  // namespace granulaw
