#include "deck/questions.hpp"

#include <gtest/gtest.h>

namespace granulaw::deck::questions_test {

TEST(Questions, AreAskedOnce)
{
  std::vector<Question> questions;
  ask(questions, "heights", "--drop-height H");
  ask(questions, "speeds", "--speed V");
  ask(questions, "heights", "--drop-height H");
  ASSERT_EQ(questions.size(), 2u);
  EXPECT_EQ(questions[1].what, "speeds");
  EXPECT_EQ(first_of({"a"}), "a");
  EXPECT_EQ(first_of({"a", "b", "c"}), "a (and 2 more)");
}

}  // namespace granulaw::deck::questions_test
