#include "deck/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace granulaw::deck {
namespace {

double value(const std::string& formula)
{
  return evaluate(formula,
                  [](std::string_view name) { return name == "v_x" ? std::optional(3.0) : std::nullopt; });
}

TEST(Expression, FollowsTheRulesOfLiggghts)
{
  EXPECT_EQ(value("1+2*3"), 7);
  EXPECT_EQ(value("2^3^2"), 64);  // to the left
  EXPECT_EQ(value("-2^2"), 4);    // unary minus first
  EXPECT_EQ(value("-(1-v_x)*2e-1"), 0.4);
  EXPECT_EQ(value("sqrt(16)/ln(exp(2))"), 2);
  EXPECT_EQ(value("1<2&&!(3==4)||0"), 1);
  EXPECT_EQ(value("v_x != 3"), 0);
  EXPECT_DOUBLE_EQ(value("4*atan(1)"), M_PI);
  EXPECT_EQ(value("PI"), M_PI);
}

TEST(Expression, NamesWhatItDoesNotKnow)
{
  for (const char* bad : {"c_ke", "v_y+1", "random(1,2,3)", "1/0", "", "(1", "1 2", "2*", "f_a[2]", "ln(-1)"})
    EXPECT_THROW(value(bad), Unknown) << bad;
  EXPECT_THROW(value(std::string(100000, '(')), Unknown);
  EXPECT_THROW(value(std::string(100000, '-')), Unknown);
}

TEST(Expression, NumbersAreFiniteDecimals)
{
  EXPECT_EQ(number("-1.5e3"), -1500);
  for (const char* bad : {"", "nan", "inf", "0x10", "1a", " 1", "1e999"}) EXPECT_FALSE(number(bad)) << bad;
}

}  // namespace
}  // namespace granulaw::deck
