#include "run_report.hpp"

#include <regex>

#include "refusal.hpp"
#include "scratch_folder.hpp"
#include "some_materials.hpp"
#include "some_runs.hpp"

namespace granulaw::run_and_report_test {

class RunAndReport : public ScratchFolder
{
 protected:
  RunAndReport() { request_.json = true; }
  /// Output of the command.
  std::string reported(const granulaw::Run& run)
  {
    testing::internal::CaptureStdout();
    run_and_report(request_, {Particle::sphere(2e-3, soft_powder()), {}}, {{"command", "test"}}, false, run);
    return testing::internal::GetCapturedStdout();
  }
  RunRequest request_;
};

TEST_F(RunAndReport, RunsOnceAtTheResolutionAskedFor)
{
  request_.resolution = 12;
  int runs = 0;
  const std::string said = reported([&](const RunOptions& options) {
    EXPECT_EQ(options.resolution, 12);
    EXPECT_TRUE(options.progress);
    ++runs;
    return some_result(1);
  });
  EXPECT_EQ(runs, 1);
  EXPECT_NE(said.find("\"steps\": 12345"), std::string::npos);
}

TEST_F(RunAndReport, RefinesToTheToleranceAskedFor)
{
  request_.tolerance = 0.5;
  int runs = 0;
  reported([&](const RunOptions&) {
    ++runs;
    return some_result(1);
  });
  EXPECT_GT(runs, 1);
}

/// Runs whose e errs by the error rule of the cells, or another order: 0.5 (12/cells)^1.65, `hours` at 14 cells.
granulaw::Run converging(double hours, double order = 1.65)
{
  return [hours, order](const RunOptions& options) {
    const int cells = options.resolution ? options.resolution : 14;
    RunResult run = some_result(1);
    run.summary.resolution = cells, run.summary.force_max = 1;
    run.summary.restitution = 0.5 + 0.5 * std::pow(12.0 / cells, order);
    run.summary.cpu_s = 3600 * hours * std::pow(cells / 14.0, 3);
    return run;
  };
}

TEST_F(RunAndReport, TheCostOfAToleranceIsStatedBeforeItIsSpent)
{
  request_.tolerance = 0.1;
  testing::internal::CaptureStderr();
  reported(converging(0.1));
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("0.1 takes about"), std::string::npos) << said;
  EXPECT_NE(said.find("of CPU"), std::string::npos) << said;
}

/// Just above the onset of a stiff body the error falls more slowly than by the rule.
TEST_F(RunAndReport, TheCostFollowsTheOrderThatTheRunsShow)
{
  request_.tolerance = 0.1;
  int finest = 0;
  testing::internal::CaptureStderr();
  reported([&](const RunOptions& options) {
    finest = std::max(finest, options.resolution);
    return converging(0.1, 1)(options);
  });
  const std::string said = testing::internal::GetCapturedStderr();
  std::smatch told;
  ASSERT_TRUE(std::regex_search(said, told, std::regex("at 20 cells .* takes about (\\d+) cells"))) << said;
  EXPECT_EQ(told[1], std::to_string(finest)) << said;
}

TEST_F(RunAndReport, AToleranceOutOfReachIsRefusedAfterTheFirstResolution)
{
  request_.tolerance = 1e-4;
  int finest = 0;
  const granulaw::Run run = [&](const RunOptions& options) {
    finest = std::max(finest, options.resolution);
    return converging(0.1)(options);
  };
  const std::string sentence = sentence_of(
      [&] { run_and_report(request_, {Particle::sphere(2e-3, soft_powder()), {}}, {{"command", "test"}}, false, run); });
  for (const char* part : {"--tolerance", "out of reach", "--resolution", "mpm law"})
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  EXPECT_EQ(finest, 14);
}

TEST_F(RunAndReport, TheCheckpointIsGoneWhenTheRunIsReported)
{
  request_.checkpoint = path("state");
  request_.checkpoint_every = 0;
  reported([&](const RunOptions& options) {
    EXPECT_TRUE(options.checkpoints.save);
    return some_result(1);
  });
  EXPECT_EQ(files(), 0u);
}

}  // namespace granulaw::run_and_report_test
