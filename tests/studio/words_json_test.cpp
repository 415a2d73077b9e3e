// From what a page asks for to a command line.
#include "flank/studio/words_json.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "flank/error.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

using Json = nlohmann::json;

class Words : public TemporaryFolder {
 protected:
  Words() : TemporaryFolder("studio_words") {}
  void SetUp() override {
    TemporaryFolder::SetUp();
    std::ofstream(root_ / "vice.stl") << "solid";
  }
  [[nodiscard]] std::vector<std::string> words(const Json& fields, const std::string& command = "fit") const {
    return option_words(command, fields, root_.string(), {"part"});
  }
};

TEST_F(Words, FieldsBecomeOptions) {
  EXPECT_EQ(words({{"tolerance_mm", "0.1"}, {"side", "-"}, {"coverage", 0.9}}),
            (std::vector<std::string>{"--coverage=0.9", "--side=-", "--tolerance=0.1"}));
  EXPECT_EQ(words({{"dry", "on"}, {"force", "off"}}, "post"), (std::vector<std::string>{"--dry"}));
  EXPECT_EQ(words({{"tolerance_mm", ""}}), std::vector<std::string>{}) << "an empty field is none";
}

TEST_F(Words, FilesAreThoseOfTheFolder) {
  const std::string path = (root_ / "vice.stl").string();
  EXPECT_EQ(words({{"fixtures", Json::array({"vice.stl"})}}), (std::vector<std::string>{"--fixture=" + path}));
  EXPECT_THROW((void)words({{"fixtures", Json::array({"other.stl"})}}), UsageError);
  EXPECT_THROW((void)words({{"fixtures", Json::array({"../vice.stl"})}}), UsageError);
  EXPECT_THROW((void)words({{"fixtures", Json::array({"/etc/passwd"})}}), UsageError);
}

TEST_F(Words, NothingElseGoesThrough) {
  EXPECT_THROW((void)words({{"tool", "/etc/passwd"}}), UsageError);
  EXPECT_THROW((void)words({{"tool", "../tool.json"}}), UsageError);
  EXPECT_THROW((void)words({{"part", "blade.step"}}), UsageError) << "the studio names the part itself";
  EXPECT_THROW((void)words({{"output", "out"}}), UsageError);
  EXPECT_THROW((void)words({{"tolerance_mm", Json::object()}}), UsageError);
  EXPECT_THROW((void)words({{"start", "1\n2"}}), UsageError);
  EXPECT_THROW((void)words({{"start", std::string(5000, '1')}}), UsageError);
  EXPECT_THROW((void)words(Json::array()), UsageError);
}

TEST(PlainName, IsAFileInAFolderAndNothingElse) {
  for (const char* name : {"blade.step", "Schaufel größer 2.stp", "a"}) EXPECT_TRUE(is_plain_name(name)) << name;
  for (const char* name : {"", ".", "..", ".hidden", "-o", "a/b", "a\\b", "a\nb", "../x"})
    EXPECT_FALSE(is_plain_name(name)) << name;
  EXPECT_FALSE(is_plain_name(std::string("a\0b", 3)));
  EXPECT_FALSE(is_plain_name(std::string(121, 'a')));
}

TEST(PlainName, OfWhateverABrowserSays) {
  EXPECT_EQ(plain_name("C:\\parts\\blade.step"), "blade.step");
  EXPECT_EQ(plain_name("../../etc/passwd"), "passwd");
  EXPECT_EQ(plain_name("..."), "file");
  EXPECT_EQ(plain_name("-rf.step"), "rf.step");
  EXPECT_EQ(plain_name("a\tb"), "a_b");
  EXPECT_TRUE(plain_name(std::string(300, 'a') + ".step").ends_with(".step"));
  for (int c = 0; c < 256; ++c) EXPECT_TRUE(is_plain_name(plain_name(std::string(3, static_cast<char>(c))))) << c;
}

TEST(ShellLine, IsQuotedWhereItMust) {
  EXPECT_EQ(shell_line({"flank", "fit", "my blade.step", "--side=-"}), "flank fit 'my blade.step' --side=-");
  EXPECT_EQ(shell_line({"it's", ""}), "'it'\\''s' ''");
}

}  // namespace
}  // namespace flank::internal
