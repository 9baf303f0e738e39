#include "farm_options.hpp"

#include <CLI/CLI.hpp>

#include "scratch_folder.hpp"

namespace granulaw::farm_options_test {

class FarmOptionsTest : public ScratchFolder
{
 protected:
  static FarmOptions parsed(std::vector<std::string> words)
  {
    CLI::App app;
    FarmOptions options;
    Options words_of(app);
    options.add_to(words_of);
    std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
    app.parse(words);
    return options;
  }
};

TEST_F(FarmOptionsTest, AreRead)
{
  const FarmOptions options = parsed({"--jobs", "3", "--cache", "x"});
  EXPECT_EQ(options.jobs, 3);
  EXPECT_EQ(options.cache, "x");
  EXPECT_FALSE(options.no_cache);
  EXPECT_TRUE(parsed({"--no-cache"}).no_cache);
  EXPECT_THROW(parsed({"--jobs", "0"}), CLI::ParseError);
  EXPECT_THROW(parsed({"--cache", "x", "--no-cache"}), CLI::ParseError);
}

TEST_F(FarmOptionsTest, TheCacheIsAFolder)
{
  FarmOptions options;
  options.cache = path("runs");
  options.check();
  EXPECT_EQ(files(), 0u);  // it is made when the first run is needed
  EXPECT_NE(options.farm(), nullptr);
  EXPECT_TRUE(std::filesystem::is_directory(path("runs")));

  options.cache = write("file", "");
  expect_error("--cache: is no folder", [&] { options.check(); });
  expect_error("cannot be made", [&] { options.farm(); });
  options.no_cache = true;
  EXPECT_EQ(sentence_of([&] { options.check(), options.farm(); }), "");
}

TEST_F(FarmOptionsTest, ACacheThatCannotBeWrittenIsToldBeforeTheRuns)
{
  FarmOptions options;
  options.cache = "/proc/self";  // a folder that not even root writes to
  expect_error("--cache: the folder '/proc/self' cannot be written to", [&] { options.farm(); });
  setenv("XDG_CACHE_HOME", write("file", "").c_str(), 1);
  testing::internal::CaptureStderr();
  EXPECT_NE(FarmOptions{}.farm(), nullptr);
  const std::string said = testing::internal::GetCapturedStderr();
  unsetenv("XDG_CACHE_HOME");
  EXPECT_NE(said.find("mpm: warning: --cache: the folder"), std::string::npos) << said;
  EXPECT_NE(said.find("runs that finish are not kept"), std::string::npos) << said;
}

TEST_F(FarmOptionsTest, WhatItCostIsOneLine)
{
  const auto said = [](const FarmCount& count) {
    testing::internal::CaptureStdout();
    print_count(count);
    return testing::internal::GetCapturedStdout();
  };
  FarmCount count;
  count.made = 4;
  count.cpu_s = 1.25;
  EXPECT_EQ(said(count), "4 runs made in 1.2 CPU s\n");
  count.from_cache = 2;
  count.cpu_s_saved = 3;
  count.retried = 1;
  EXPECT_EQ(
      said(count),
      "4 runs made in 1.2 CPU s, 2 taken from the cache (3.0 CPU s saved); 1 of them failed at first, 0 "
      "at a higher resolution too\n");
}

}  // namespace granulaw::farm_options_test
