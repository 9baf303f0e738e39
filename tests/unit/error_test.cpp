#include "base/error.hpp"

#include <gtest/gtest.h>

namespace granulaw {
namespace {

TEST(Error, NothingPrintableCommandsATerminal)
{
  EXPECT_EQ(printable("\x1b[2J\n\r\t\x01\x7f ok"), "?[2J????? ok");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m, \x9b"
                      "31m"),
            "??31m, ?31m");  // CSI as one character, UTF-8 and Latin-1
  EXPECT_EQ(printable("5 µm, Güte 0.9 √2 ✓"), "5 µm, Güte 0.9 √2 ✓");
  EXPECT_EQ(printable(""), "");
}

}  // namespace
}  // namespace granulaw
