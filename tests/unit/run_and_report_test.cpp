#include "run_and_report.hpp"

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
