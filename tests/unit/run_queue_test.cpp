#include "characterise/run_queue.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"

namespace granulaw {
namespace {

namespace fs = std::filesystem;

RunResult some_result(double seed)
{
  RunResult r;
  for (int k = 0; k < 20; ++k)
    r.trace.push_back(
        {seed * k / 3.0, 1e-7 * k, std::sqrt(2.0) * k, 1e-5, k < 10 ? Branch::load : Branch::unload, k / 10});
  r.summary.restitution = seed / 7;
  r.summary.steps = 12345;
  return r;
}

class Cache : public ::testing::Test
{
 protected:
  const fs::path folder_ = fs::temp_directory_path() / ("granulaw_cache_" + std::to_string(getpid()));
  void TearDown() override { fs::remove_all(folder_); }
};

TEST_F(Cache, RoundTripIsExactAndKeysDecide)
{
  const RunCache cache(folder_.string());
  RunResult read;
  EXPECT_FALSE(cache.load("one", read));
  cache.store("one", some_result(1.1));
  ASSERT_TRUE(cache.load("one", read));
  EXPECT_EQ(read.summary.restitution, some_result(1.1).summary.restitution);
  EXPECT_EQ(read.summary.steps, 12345);
  ASSERT_EQ(read.trace.size(), 20u);
  EXPECT_EQ(read.trace[13].force, some_result(1.1).trace[13].force);
  EXPECT_EQ(read.trace[13].branch, Branch::unload);
  EXPECT_FALSE(cache.load("two", read));
  cache.remove();
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(Cache, ACutOffFileCountsAsNotThere)
{
  const RunCache cache(folder_.string());
  cache.store("one", some_result(1.1));
  const fs::path file = fs::directory_iterator(folder_)->path();
  const auto size = fs::file_size(file);
  RunResult read;
  for (const auto part :
       {size - 2, size - 4, size / 2, size / 10, size * 0}) {  // the last byte only ends the line
    fs::resize_file(file, part);
    EXPECT_FALSE(cache.load("one", read)) << part;
  }
}

TEST_F(Cache, TheQueueRunsWhatIsNotThereAndKeepsTheOrder)
{
  std::atomic<int> runs{0};
  std::vector<RunJob> jobs;
  for (int k = 0; k < 8; ++k)
    jobs.push_back({"job", "job " + std::to_string(k), 1.0 + k, [&runs, k](const RunOptions& o) {
                      ++runs;
                      o.progress(0.5);
                      return some_result(k);
                    }});
  const RunCache cache(folder_.string());
  double last = -1;
  const auto progress = [&](double done, const std::string&) { last = std::max(last, done); };
  EXPECT_EQ(run_all(jobs, {}, 3, cache, progress)[5].summary.restitution, some_result(5).summary.restitution);
  EXPECT_EQ(runs, 8);
  EXPECT_NEAR(last, 1.0, 1e-12);
  EXPECT_EQ(run_all(jobs, {}, 2, cache, progress)[2].summary.restitution, some_result(2).summary.restitution);
  EXPECT_EQ(runs, 8) << "everything was in the cache";
}

TEST_F(Cache, TheFirstErrorStopsTheQueueAndFinishedRunsStay)
{
  std::vector<RunJob> jobs;
  jobs.push_back({"good", "good", 3.0, [](const RunOptions&) { return some_result(1); }});
  jobs.push_back({"bad", "bad", 2.0, [](const RunOptions&) -> RunResult { throw Error("no"); }});
  jobs.push_back({"late", "late", 1.0, [](const RunOptions&) { return some_result(2); }});
  const RunCache cache(folder_.string());
  EXPECT_THROW(run_all(jobs, {}, 1, cache, {}), Error);
  RunResult read;
  EXPECT_TRUE(cache.load("good", read));
  EXPECT_FALSE(cache.load("late", read));
}

}  // namespace
}  // namespace granulaw
