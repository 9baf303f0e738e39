#include "deck/convert/time_steps.hpp"

#include <gtest/gtest.h>

namespace granulaw::deck::deck_variables_test {

TEST(DeckVariables, FollowEachOther)
{
  DeckVariables variables;
  variables.define("n", "${seconds}/${dt}");
  variables.define("many", "10*v_n");
  variables.define("m", "$s/2");
  variables.define("a", "v_b+1");
  variables.define("b", "v_a+1");
  variables.define("own", "0.01/dt");
  for (const char* text : {"${n}", "x_${many}", "v_many", "$(v_many+1)", "${own}", "dt"}) EXPECT_TRUE(variables.follows(text, {"dt"})) << text;
  for (const char* text : {"${seconds}", "$m", "${a}", "width", "v_dtx", "n"}) EXPECT_FALSE(variables.follows(text, {"dt"})) << text;
  EXPECT_TRUE(variables.follows("$m", {"s"}));
  EXPECT_FALSE(variables.follows("${dt}", {}));
}

}  // namespace granulaw::deck::deck_variables_test
