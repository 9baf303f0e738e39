#include "terminal.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <regex>

namespace granulaw::terminal_test {

TEST(Terminal, NothingIsInterruptedAtFirst)
{
  EXPECT_FALSE(is_interrupted());
  EXPECT_NO_THROW(stop_if_interrupted());
}

/// Exit code after the signal: the flag stays for the rest of the process.
[[noreturn]] void interrupted_by(int signal)
{
  catch_interrupts();
  std::raise(signal);
  bool thrown = false;
  try {
    ProgressBar(false).update(0.5, "");  // looks for it even where it is not drawn
  } catch (const Interrupted&) {
    thrown = true;
  }
  std::_Exit(is_interrupted() && thrown ? 0 : 1);
}

TEST(TerminalDeathTest, TheFirstSignalSetsAFlagThatProgressSees)
{
  EXPECT_EXIT(interrupted_by(SIGINT), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(interrupted_by(SIGTERM), testing::ExitedWithCode(0), "");
}

TEST(TerminalDeathTest, TheSecondEndsTheProgram)
{
  const auto twice = [] {
    catch_interrupts();
    std::raise(SIGINT);
    std::raise(SIGINT);
  };
  EXPECT_EXIT(twice(), testing::KilledBySignal(SIGINT), "");
}

TEST(Terminal, ABarThatIsNotWantedPrintsNothing)
{
  testing::internal::CaptureStderr();
  {
    ProgressBar bar(false);
    bar.update(0.5, "half");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// A captured stderr is no terminal: a line each time the interval is over, and none before.
TEST(Terminal, WithoutATerminalProgressIsLines)
{
  testing::internal::CaptureStderr();
  {
    ProgressBar often(true, ProgressBar::Clock::duration::zero());
    often.update(0.25, "lead: press to 0.02 R");
    often.update(0.5, "");
    often.update(0.2, "the next run");
    ProgressBar seldom(true, ProgressBar::Clock::duration::max());
    seldom.update(0.5, "half");
  }
  const std::regex lines(
      "mpm: 25 % after 0 s, 0 s left: lead: press to 0.02 R\nmpm: 50 % after 0 s, 0 s left\nmpm: 20 % after 0 s, 0 s "
      "left: the next run\n");
  EXPECT_TRUE(std::regex_match(testing::internal::GetCapturedStderr(), lines));
}

TEST(Terminal, DurationsHaveTheUnitThatOneSays)
{
  EXPECT_EQ(duration_text(40), "40 s");
  EXPECT_EQ(duration_text(12 * 60), "12 minutes");
  EXPECT_EQ(duration_text(3.5 * 3600), "3.5 hours");
}

}  // namespace granulaw::terminal_test
