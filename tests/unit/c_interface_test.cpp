#include <gtest/gtest.h>

#include <cmath>

#include "granulaw.h"

namespace granulaw::c_interface_test {

TEST(CInterface, ANullContactIsAnsweredWithoutNumbers)
{
  EXPECT_EQ(granulaw_kept(nullptr), 0u);
  EXPECT_EQ(granulaw_turns(nullptr, 0), 0);
  EXPECT_TRUE(std::isnan(granulaw_range_of(nullptr, 1e-3, 1e-6).fastest));
}

}  // namespace granulaw::c_interface_test
