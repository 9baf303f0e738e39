#include "ranks.hpp"

#include <cstdlib>

#include "scratch_folder.hpp"

namespace granulaw::ranks_test {

// The launcher's environment is read once a process: each case in a process of its own.

void launch(const char* rank, const char* size)
{
  setenv("OMPI_COMM_WORLD_RANK", rank, 1);
  setenv("OMPI_COMM_WORLD_SIZE", size, 1);
}

/// Ends the process, with 0 where it holds.
[[noreturn]] void end(bool holds)
{
  std::_Exit(holds ? 0 : 1);
}

TEST(RanksDeathTest, WithoutALauncherThereIsOne)
{
  EXPECT_EXIT(end(rank() == 0 && ranks() == 1 && leave_ranks(3, "") == 3), testing::ExitedWithCode(0), "");
  EXPECT_EXIT((join_ranks("plan", false), end(true)), testing::ExitedWithCode(0), "");
}

TEST(RanksDeathTest, TheEnvironmentTellsTheRank)
{
  EXPECT_EXIT((launch("2", "3"), end(rank() == 2 && ranks() == 3)), testing::ExitedWithCode(0), "");
}

TEST(RanksDeathTest, ACommandThatSharesNoRunsWantsOneProcess)
{
  const auto joined = [] {
    launch("0", "2");
    return sentence_of([] { join_ranks("plan", false); });
  };
  EXPECT_EXIT(end(joined() == "plan: runs in one process: start it without mpirun (mpm table shares its "
                              "runs among ranks): found 2 processes, allowed is 1"),
              testing::ExitedWithCode(0), "");
}

TEST(RanksDeathTest, OnlyTheFirstComplains)
{
  EXPECT_EXIT((launch("0", "2"), end(leave_ranks(1, "why") == 1)), testing::ExitedWithCode(0), "mpm: why");
  EXPECT_EXIT((launch("1", "2"), end(leave_ranks(1, "why") == 0)), testing::ExitedWithCode(0), "^$");
}

}  // namespace granulaw::ranks_test
