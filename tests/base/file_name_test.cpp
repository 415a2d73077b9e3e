// Names of any bytes as text and back.
#include "flank/base/file_name.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/printable.h"

namespace flank::internal {
namespace {

TEST(FileName, PlainNamesAreThemselves) {
  for (const char* name : {"", "/a b/c.step", "\xc3\xbc.step", "%41", "100%"}) {
    EXPECT_EQ(text_of_name(name), name);
    EXPECT_EQ(name_of_text(name), name);
  }
  EXPECT_EQ(text_of_name("bl\xff.step"), "file:bl%FF.step");
}

TEST(FileName, AnyBytesReadBack) {
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    std::string name = k % 3 == 0 ? "file:" : "";
    const auto size = static_cast<int>(random.uniform() * 12.0);
    for (int i = 0; i < size; ++i) name += static_cast<char>(static_cast<unsigned char>(random.uniform() * 255.9));
    EXPECT_TRUE(is_utf8(text_of_name(name)));
    EXPECT_EQ(name_of_text(text_of_name(name)), name);
  }
}

TEST(FileName, DamagedTextIsRead) {
  for (const char* text : {"file:%", "file:%4", "file:%zz", "file:%4g%", "file:"}) (void)name_of_text(text);
  EXPECT_EQ(name_of_text("file:%zz"), "%zz");
}

}  // namespace
}  // namespace flank::internal
