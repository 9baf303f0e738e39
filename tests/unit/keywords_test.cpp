#include <gtest/gtest.h>

#include <set>

#include "liggghts_plugin/deck_keywords.hpp"

namespace granulaw::plugin {
namespace {

TEST(Keywords, AreListedOnce)
{
  std::set<std::string_view> names;
  for (const Keyword& k : keyword_table) EXPECT_TRUE(names.insert(k.name).second) << k.name;
}

TEST(Keywords, AreFoundWhereTheyMayStand)
{
  for (const Keyword& k : keyword_table)
    for (const bool is_wall : {false, true}) {
      EXPECT_EQ(find_keyword(k.name, is_wall), k.stands_in(is_wall) ? &k : nullptr) << k.name;
      EXPECT_EQ(is_reserved(k.name, is_wall), k.stands_in(is_wall)) << k.name;
    }
}

}  // namespace
}  // namespace granulaw::plugin
