#include "farm/run_cache.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>
#include <vector>

#include "scratch_folder.hpp"
#include "some_runs.hpp"

namespace granulaw::run_cache_test {

namespace fs = std::filesystem;

class CacheFolder : public ScratchFolder
{
 protected:
  std::string name() const { return fs::directory_iterator(path(""))->path().filename(); }
};

TEST_F(CacheFolder, RoundTripIsExactAndKeysDecide)
{
  const RunCache cache(path(""));
  RunOutcome found;
  EXPECT_FALSE(cache.load("one", found));
  cache.store("one", 2.5, some_outcome(1.1));
  ASSERT_TRUE(cache.load("one", found));
  EXPECT_TRUE(found.from_cache);
  EXPECT_EQ(bytes_of(found), bytes_of(some_outcome(1.1)));
  EXPECT_EQ(found.result.trace[13].force, some_result(1.1).trace[13].force);
  EXPECT_FALSE(cache.load("two", found));
  const std::string file = name();
  EXPECT_TRUE(read(path(file)).starts_with("granulaw run 3\nkey one\ncost 2.5\ncpu_s 0.366667\noutcome "));
  // the file of another key under this one's name
  cache.store("two", 1, some_outcome(2));
  for (const fs::directory_entry& other : fs::directory_iterator(path("")))
    if (other.path() != path(file)) fs::rename(other.path(), path(file));
  EXPECT_FALSE(cache.load("one", found));
}

TEST_F(CacheFolder, KeepsWhatThreeDimensionsAdd)
{
  const RunCache cache(path(""));
  RunOutcome outcome = some_outcome(1.1), found;
  outcome.result.planes = {{{0, 0, 1}, {{1e-6, 2.0 / 3, {0.1, 0, 2.0 / 3}, {}, {}, {}}}}};
  outcome.result.rebound = {0.5, 0.7, {0, 1.0 / 3, 0}, 0.01, 0.002};
  cache.store("one", 1, outcome);
  ASSERT_TRUE(cache.load("one", found));
  ASSERT_EQ(found.result.planes.size(), 1u);
  EXPECT_EQ(found.result.planes[0].samples.at(0).vector[2], 2.0 / 3);
  ASSERT_TRUE(found.result.rebound.has_value());
  EXPECT_EQ(found.result.rebound->spin[1], 1.0 / 3);
}

TEST_F(CacheFolder, ADamagedFileCountsAsNotThere)
{
  const RunCache cache(path(""));
  cache.store("one", 2.5, some_outcome(1.1));
  const std::string file = name();
  const std::string whole = read(path(file)), result = bytes_of(some_outcome(1.1));
  RunOutcome found;
  for (std::size_t size = 0; size < whole.size(); size += size < 150 ? 1 : 7) {
    write(file, whole.substr(0, size));
    EXPECT_FALSE(cache.load("one", found)) << size;
  }
  write(file, whole.substr(0, whole.size() - 1));
  EXPECT_FALSE(cache.load("one", found));
  write(file, whole + "x");
  EXPECT_FALSE(cache.load("one", found));
  const std::size_t outcome = whole.find("outcome ");
  for (std::size_t at = 0; at < whole.size(); at += at < 150 ? 1 : 7) {
    std::string damaged = whole;
    damaged[at] ^= 0x10;
    write(file, damaged);
    // only what is there for people, cost and CPU time, may be wrong unnoticed
    if (!cache.load("one", found)) continue;
    EXPECT_LT(at, outcome);
    EXPECT_EQ(bytes_of(found), result) << at;
  }
}

TEST_F(CacheFolder, WritersOfOneFolderLeaveWholeFiles)
{
  const RunCache cache(path(""));
  const auto work = [&] {
    for (int k = 0; k < 200; ++k) {
      const std::string key = std::to_string(k % 3);
      cache.store(key, 1, some_outcome(k % 3));
      RunOutcome found;
      EXPECT_TRUE(cache.load(key, found));
      EXPECT_EQ(bytes_of(found), bytes_of(some_outcome(k % 3)));
    }
  };
  {
    std::vector<std::jthread> writers;
    for (int k = 0; k < 4; ++k) writers.emplace_back(work);
  }
  EXPECT_EQ(files(), 3u) << "nothing temporary is left";
}

TEST_F(CacheFolder, AFolderThatCannotBeWrittenIsNoCache)
{
  const RunCache cache(write("file", "a file, not a folder"));
  cache.store("one", 1, some_outcome(1));
  RunOutcome found;
  EXPECT_FALSE(cache.load("one", found));
  const RunCache none;
  none.store("one", 1, some_outcome(1));
  EXPECT_FALSE(none.load("one", found));
}

TEST(RunCache, DefaultFolder)
{
  setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(default_cache_folder(), "/somewhere/granulaw/runs");
  unsetenv("XDG_CACHE_HOME");
  setenv("HOME", "/home/me", 1);
  EXPECT_EQ(default_cache_folder(), "/home/me/.cache/granulaw/runs");
  unsetenv("HOME");
  EXPECT_EQ(default_cache_folder(), "");
}

}  // namespace granulaw::run_cache_test
