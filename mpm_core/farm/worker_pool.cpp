#include "farm/worker_pool.hpp"

#include <algorithm>
#include <utility>

namespace granulaw {

namespace {

struct Stopped
{
};  // thrown through the solver

}  // namespace

WorkerPool::WorkerPool(int threads) : slots_(static_cast<std::size_t>(std::max(1, threads)))
{
  for (Slot& slot : slots_) threads_.emplace_back([this, &slot] { work(slot); });
}

WorkerPool::~WorkerPool()
{
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  started_.notify_all();
}

void WorkerPool::start(std::size_t index, const RunJob& job)
{
  {
    const std::lock_guard lock(mutex_);
    Slot& slot = *std::find_if(slots_.begin(), slots_.end(), [](const Slot& s) { return !s.job; });
    slot.index = index;
    slot.fraction = 0;
    slot.job = &job;
  }
  ++busy_;
  started_.notify_all();
}

void WorkerPool::work(Slot& slot)
{
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      started_.wait(lock, [&] { return stop_ || slot.job; });
      if (stop_) return;
    }
    Finished end{slot.index, {}, {}};
    try {
      end.outcome = perform(*slot.job, [&](double fraction) {
        if (stop_) throw Stopped{};
        slot.fraction = fraction;
      });
    } catch (const Stopped&) {
      return;
    } catch (...) {
      end.broken = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      slot.job = nullptr;
      finished_.push_back(std::move(end));
    }
    ended_.notify_one();
  }
}

std::vector<WorkerPool::Finished> WorkerPool::wait(std::chrono::milliseconds patience)
{
  if (idle()) return {};
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, patience, [&] { return !finished_.empty(); });
  busy_ -= finished_.size();
  return std::exchange(finished_, {});
}

std::vector<WorkerPool::Running> WorkerPool::running() const
{
  const std::lock_guard lock(mutex_);
  std::vector<Running> list;
  for (const Slot& slot : slots_)
    if (slot.job) list.push_back({slot.index, slot.fraction});
  return list;
}

}  // namespace granulaw
