#include "flank/io/text/read_text.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

std::string complaint(const TextLines& lines, bool whole, std::size_t word) {
  try {
    if (whole)
      (void)lines.integer(word);
    else
      (void)lines.number(word);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

TEST(TextLines, GoesFromLineToLineOverEmptyOnes) {
  TextLines lines("f", "\n  \t\r\n one two\r\n\n\nthree");
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.line(), 3);
  EXPECT_EQ(lines.words(), (std::vector<std::string_view>{"one", "two"}));
  EXPECT_EQ(lines.word(1), "two");
  EXPECT_EQ(lines.word(2), "") << "there is no third";
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.line(), 6);
  EXPECT_EQ(lines.word(0), "three");
  EXPECT_FALSE(lines.next());
  EXPECT_TRUE(lines.words().empty());
  EXPECT_FALSE(lines.next());
}

TEST(TextLines, KnowsWhatFollowsTheLine) {
  const std::string content = "head\r\nbytes";
  TextLines lines("f", content);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(content.substr(lines.position()), "bytes");
  TextLines later("f", content, 6);
  ASSERT_TRUE(later.next());
  EXPECT_EQ(later.word(0), "bytes");
  TextLines end("f", "last");
  ASSERT_TRUE(end.next());
  EXPECT_EQ(end.position(), 4u) << "never beyond the end";
}

TEST(TextLines, NumbersAreWholeWords) {
  TextLines lines("f.obj", "x 1 -2.5 +3e2 .5 1e-400 0x10 1,5 nan inf 1e400 1.5.2 +");
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.number(1), 1.0);
  EXPECT_EQ(lines.number(2), -2.5);
  EXPECT_EQ(lines.number(3), 300.0);
  EXPECT_EQ(lines.number(4), 0.5);
  for (const std::size_t word : {0, 6, 7, 11, 12})
    EXPECT_EQ(complaint(lines, false, word),
              "f.obj, line 1: \"" + std::string(lines.word(word)) + "\" is not a number");
  for (const std::size_t word : {8, 9, 10})
    EXPECT_NE(complaint(lines, false, word).find("is not a finite number"), std::string::npos) << lines.word(word);
  EXPECT_EQ(complaint(lines, false, 13), "f.obj, line 1: \"\" is not a number") << "beyond the last word";
}

TEST(TextLines, WholeNumbersMayHaveASlashAndWhatFollowsIt) {
  TextLines lines("f.obj", "12 -4 7/8/9 5//2 2.5 1e3 99999999999999999999 /3 x");
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.integer(0), 12);
  EXPECT_EQ(lines.integer(1), -4);
  EXPECT_EQ(lines.integer(2), 7);
  EXPECT_EQ(lines.integer(3), 5);
  for (std::size_t word = 4; word < 10; ++word)
    EXPECT_NE(complaint(lines, true, word).find("is not a whole number"), std::string::npos) << lines.word(word);
}

}  // namespace
}  // namespace flank::internal
