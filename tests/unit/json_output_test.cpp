#include "json_output.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace granulaw::json_output_test {

TEST(JsonOutput, WhatIsNotFiniteIsNull)
{
  EXPECT_EQ(json_number(0.1).dump(), "0.1");
  EXPECT_TRUE(json_number(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_TRUE(json_number(std::nan("")).is_null());
}

TEST(JsonOutput, KeepsTheOrderOfItsKeys)
{
  testing::internal::CaptureStdout();
  print_json({{"b", 1}, {"a", 2}});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "{\n  \"b\": 1,\n  \"a\": 2\n}\n");
}

}  // namespace granulaw::json_output_test
