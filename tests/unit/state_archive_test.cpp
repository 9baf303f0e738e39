// An archive returns its content to the last bit; content that does not fit gives one sentence.
#include "base/state_archive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "refusal.hpp"

namespace granulaw::state_archive_test {

enum class Phase { one, two };

struct State
{
  double x = 0, nan = 0, zero = 0;
  int n = 0;
  bool flag = false;
  Phase phase = Phase::one;
  std::string text;
  std::vector<double> field = std::vector<double>(3);
  std::vector<float> list;

  void visit_state(StateArchive& a)
  {
    a.value(x), a.value(nan), a.value(zero), a.value(n), a.value(flag), a.value(phase), a.value(text);
    a.values(field), a.growing(list);
  }
};

std::string saved()
{
  State s{0.1, std::nan("7"), -0.0, -5, true, Phase::two, "a b", {1, 2, 1e-310}, {0.1f, 3}};
  StateArchive archive;
  s.visit_state(archive);
  return archive.take();
}

std::string sentence(std::string bytes, State& s)
{
  return sentence_of([&] {
    StateArchive archive(std::move(bytes), "here");
    s.visit_state(archive);
    archive.finish();
  });
}

TEST(StateArchive, KeepsEveryBit)
{
  State s;
  EXPECT_EQ(sentence(saved(), s), "");
  EXPECT_EQ(s.x, 0.1);
  EXPECT_TRUE(std::isnan(s.nan));
  EXPECT_TRUE(s.zero == 0 && std::signbit(s.zero));
  EXPECT_EQ(s.n, -5);
  EXPECT_TRUE(s.flag);
  EXPECT_EQ(s.phase, Phase::two);
  EXPECT_EQ(s.text, "a b");
  EXPECT_EQ(s.field, (std::vector<double>{1, 2, 1e-310}));
  EXPECT_EQ(s.list, (std::vector<float>{0.1f, 3}));
  StateArchive again;
  s.visit_state(again);
  EXPECT_EQ(again.take(), saved());
}

TEST(StateArchive, RefusesWhatEndsTooEarly)
{
  const std::string whole = saved();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    State s;
    EXPECT_EQ(sentence(whole.substr(0, size), s), "here: its state of the run ends too early") << size;
  }
}

TEST(StateArchive, RefusesWhatIsLeftOver)
{
  State s;
  EXPECT_EQ(sentence(saved() + '\0', s), "here: its state of the run is followed by something else");
}

TEST(StateArchive, RefusesAFieldOfAnotherSize)
{
  State s;
  s.field.resize(4);
  EXPECT_EQ(sentence(saved(), s),
            "here: its state does not fit this run (size of a field): found 0x3, allowed is 0x4");
}

/// A length of 2^64 - 1 must not be asked for.
TEST(StateArchive, RefusesAnAbsurdLength)
{
  StateArchive archive(std::string(8, '\xff') + "some", "here");
  std::vector<double> list;
  EXPECT_THROW(archive.growing(list), Error);
  EXPECT_TRUE(list.empty());
}

/// Fowler, Noll and Vo's own test vectors.
TEST(StateArchive, Checksum)
{
  EXPECT_EQ(checksum(""), 0xcbf29ce484222325u);
  EXPECT_EQ(checksum("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(checksum("foobar"), 0x85944171f73967e8u);
  EXPECT_EQ(checksum("bar", checksum("foo")), checksum("foobar"));
}

}  // namespace granulaw::state_archive_test
