#include "farm/farm.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <new>
#include <thread>

#include "scratch_folder.hpp"
#include "some_runs.hpp"

namespace granulaw::farm_test {

class CachedFarm : public ScratchFolder
{
};

struct UserStop
{
};

RunJob good(int k, std::atomic<int>* runs = nullptr)
{
  return {"job " + std::to_string(k), "key " + std::to_string(k), 1.0 + k, [=](const RunOptions& options) {
            if (runs) ++*runs;
            EXPECT_EQ(options.threads, 1);
            options.progress(0.5);
            return some_result(k);
          }};
}

TEST_F(CachedFarm, RunsWhatIsNotInTheCacheAndKeepsTheOrder)
{
  std::atomic<int> runs{0};
  std::vector<RunJob> jobs;
  for (int k = 0; k < 8; ++k) jobs.push_back(good(k, &runs));
  double last = -1;
  const auto progress = [&](double done, const std::string&) {
    EXPECT_GE(done, last);
    last = done;
  };
  ThreadFarm first(3, RunCache(path("")));
  const auto made = first.run(jobs, progress);
  ASSERT_EQ(made.size(), 8u);
  EXPECT_EQ(runs, 8);
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(first.count().made, 8);
  EXPECT_EQ(first.count().from_cache, 0);
  EXPECT_GT(first.count().cpu_s, 0);
  for (int k = 0; k < 8; ++k)
    EXPECT_EQ(made[static_cast<std::size_t>(k)].result.summary.restitution,
              some_result(k).summary.restitution);

  ThreadFarm second(2, RunCache(path("")));
  jobs.push_back(good(8, &runs));  // a wider range
  const auto again = second.run(jobs);
  EXPECT_EQ(runs, 9);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(bytes_of(again[k]), bytes_of(made[k]));
  EXPECT_EQ(second.count().made, 1);
  EXPECT_EQ(second.count().from_cache, 8);
  EXPECT_EQ(second.count().cpu_s_saved, first.count().cpu_s);
}

TEST(ThreadFarm, TheMostExpensiveRunStartsFirst)
{
  std::vector<std::string> order;
  std::vector<RunJob> jobs;
  for (const double cost : {2.0, 5.0, 1.0, 5.0, 3.0})
    jobs.push_back({"", std::to_string(jobs.size()), cost, [&order, k = jobs.size()](const RunOptions&) {
                      order.push_back(std::to_string(k));
                      return some_result(1);
                    }});
  ThreadFarm(1).run(jobs);
  EXPECT_EQ(order, (std::vector<std::string>{"1", "3", "4", "0", "2"}));
}

TEST(ThreadFarm, EqualKeysAreOneRun)
{
  std::atomic<int> runs{0};
  ThreadFarm farm(2);
  const auto outcomes = farm.run({good(1, &runs), good(2, &runs), good(1, &runs)});
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(bytes_of(outcomes[0]), bytes_of(outcomes[2]));
  EXPECT_EQ(farm.count().from_cache, 1);
}

/// Fails on every grid up to a factor of `until` on its resolution.
RunJob failing(const std::string& key, double until)
{
  return {"bad run", key, 3.0, [until](const RunOptions& options) {
            if (options.refine <= until) throw Error("unstable at refine " + std::to_string(options.refine));
            return some_result(3);
          }};
}

TEST_F(CachedFarm, ARunThatFailsIsTriedOnAFinerGridAndThenReported)
{
  const std::vector<RunJob> jobs{good(0), failing("once", 1.0), failing("always", 99.0)};
  ThreadFarm farm(2, RunCache(path("")));
  const auto outcomes = farm.run(jobs);
  EXPECT_FALSE(outcomes[0].failed());
  EXPECT_EQ(outcomes[0].first_error, "");
  EXPECT_FALSE(outcomes[1].failed());
  EXPECT_EQ(outcomes[1].first_error, "unstable at refine 1.000000");
  EXPECT_EQ(outcomes[1].result.trace.size(), 20u);
  EXPECT_TRUE(outcomes[2].failed());
  EXPECT_EQ(outcomes[2].error, "unstable at refine 1.400000");
  EXPECT_EQ(farm.count().made, 3);
  EXPECT_EQ(farm.count().retried, 2);
  EXPECT_EQ(farm.count().failed, 1);
  // the second attempt's result is kept, with the reason; what failed is tried again
  ThreadFarm again(1, RunCache(path("")));
  EXPECT_EQ(bytes_of(again.run(jobs)[1]), bytes_of(outcomes[1]));
  EXPECT_EQ(again.count().from_cache, 2);
  EXPECT_EQ(again.count().failed, 1);
  EXPECT_EQ(sentence_of([&] { farm.run_all(jobs); }),
            "bad run: the run failed, on a finer grid too (unstable at refine 1.400000)");
}

TEST_F(CachedFarm, WhatProgressThrowsStopsTheRunsAndGoesThrough)
{
  RunJob endless{"endless", "endless", 0.5, [](const RunOptions& options) -> RunResult {
                   for (;;) {
                     options.progress(0.1);
                     std::this_thread::sleep_for(std::chrono::milliseconds(1));
                   }
                 }};
  const RunCache cache(path(""));
  ThreadFarm farm(2, cache);
  const auto stop = [](double done, const std::string&) {
    if (done > 0.6) throw UserStop{};  // the first run is two thirds of the cost
  };
  EXPECT_THROW(farm.run({good(0), endless}, stop), UserStop);
  RunOutcome kept;
  EXPECT_TRUE(cache.load("key 0", kept));
  EXPECT_FALSE(cache.load("endless", kept));
}

TEST(ThreadFarm, OtherExceptionsOfARunGoThrough)
{
  RunJob greedy{"greedy", "greedy", 9, [](const RunOptions&) -> RunResult { throw std::bad_alloc(); }};
  EXPECT_THROW(ThreadFarm(2).run({good(0), greedy}), std::bad_alloc);
}

TEST(ThreadFarm, AnEmptyBatch)
{
  int calls = 0;
  EXPECT_TRUE(ThreadFarm(4)
                  .run({},
                       [&](double done, const std::string&) {
                         ++calls;
                         EXPECT_EQ(done, 1.0);
                       })
                  .empty());
  EXPECT_EQ(calls, 1);
}

}  // namespace granulaw::farm_test
