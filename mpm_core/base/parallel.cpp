#include "base/parallel.hpp"

namespace granulaw {

Parallel::Parallel(int threads)
{
  for (int k = 1; k < threads; ++k) workers_.emplace_back([this, k] { work(k); });
}

Parallel::~Parallel()
{
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  begun_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void Parallel::run(int count, Call call, void* task)
{
  if (workers_.empty()) {
    for (int k = 0; k < count; ++k) call(task, k, 0);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    call_ = call, task_ = task, count_ = count;
    next_ = 0, failed_ = nullptr;
    busy_ = static_cast<int>(workers_.size());
    ++round_;
  }
  begun_.notify_all();
  take(0);
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return busy_ == 0; });
  if (failed_) std::rethrow_exception(failed_);
}

void Parallel::work(int thread)
{
  for (long done = 0;;) {
    {
      std::unique_lock lock(mutex_);
      begun_.wait(lock, [&] { return stop_ || round_ != done; });
      if (stop_) return;
      done = round_;
    }
    take(thread);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) ended_.notify_one();
  }
}

void Parallel::take(int thread)
{
  try {
    for (int k = next_++; k < count_; k = next_++) call_(task_, k, thread);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failed_) failed_ = std::current_exception();
    next_ = count_;
  }
}

}  // namespace granulaw
