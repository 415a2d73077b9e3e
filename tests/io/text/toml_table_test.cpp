#include "flank/io/text/toml_table.h"

#include <gtest/gtest.h>

#include "flank/error.h"

namespace flank::internal {
namespace {

std::string message(const std::string& text) {
  try {
    (void)TomlTable::parse(text, "a.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TomlTable, AnyCharacterMayStandInTextsAndComments) {
  const TomlTable table = TomlTable::parse(
      "\xEF\xBB\xBF# Fr\u00e4ser \"\n"
      R"toml(
a = "ä \" ä"  # 'ä
b = 'ä \'
c = """ä
"ä" \"""
""ä"""
d = '''ä
'ä''''
e = ["ä", 'ä']
)toml",
      "a.toml");
  EXPECT_EQ(table.text("a"), "ä \" ä");
  EXPECT_EQ(table.text("b"), "ä \\");
  EXPECT_EQ(table.text("c"), "ä\n\"ä\" \"\"\"\n\"\"ä");
  EXPECT_EQ(table.text("d"), "ä\n'ä'");
  EXPECT_EQ(table.texts("e").size(), 2u);
}

// toml++ 3.3 asks its tables whether such a character is a space or a letter, and reaches what it says cannot be reached:
// seen by the undefined-behaviour sanitizer.
TEST(TomlTable, ElsewhereItIsRefusedWithItsPlace) {
  for (const char* text :
       {"a = 1\nb = 5\u0203.0\n", "a = 1\n\u00e4 = 1\n", "a = 1\nb = 1 \u2e3f\n", "a = 1\nb = [0\"\u02d6\"]\n"})
    EXPECT_EQ(message(text).substr(0, 15), "a.toml: line 2,") << text << message(text);
}

TEST(TomlTable, WhatIsNotClosedIsRefused) {
  for (const char* text : {"a = \"x", "a = 'x", "a = \"\"\"x\n", "a = '''x", "a = \"x\\", "a = \"", "a = '''"})
    EXPECT_NE(message(text), "") << text;
}

}  // namespace
}  // namespace flank::internal
