// No name of a file moves the cursor of a terminal.
#include "flank/printable.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(Printable, ControlCharactersAndWhatIsNotUtf8AreShown) {
  EXPECT_EQ(printable("blade \xc3\xbc\xe2\x82\xac.step"), "blade \xc3\xbc\xe2\x82\xac.step");
  EXPECT_EQ(printable("a\x1b[31m\r\n\t"), "a\\x1b[31m\\x0d\\x0a\\x09");
  EXPECT_EQ(printable("a\nb", true), "a\nb");
  EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "CSI in one character";
  EXPECT_EQ(printable(std::string("\0", 1)), "\\x00");
}

TEST(Printable, Utf8IsStrict) {
  EXPECT_TRUE(is_utf8("\xf0\x9f\x94\xa7"));
  for (const char* text :
       {"\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "\x80"})
    EXPECT_FALSE(is_utf8(text)) << text;
}

}  // namespace
}  // namespace flank::internal
