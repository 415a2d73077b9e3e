// What is read is not written, by whatever name it goes.
#include "flank/base/kept/read_files.h"

#include <gtest/gtest.h>

#include <functional>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class ReadFilesTest : public TemporaryFolder {
 protected:
  ReadFilesTest() : TemporaryFolder("flank_read_files") {}
  void SetUp() override {
    TemporaryFolder::SetUp();
    write("part.step", "part");
    fs::create_directories(root_ / "sub");
    fs::create_symlink("part.step", root_ / "link.step");
    fs::create_symlink("sub/../link.step", root_ / "link-of-link");
    fs::create_symlink(root_, root_ / "here");
    fs::create_hard_link(root_ / "part.step", root_ / "hard.step");
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(root_ / name) << text; }
  [[nodiscard]] std::string path(const std::string& name) const { return (root_ / name).string(); }
  /// The same place, told from the working folder.
  [[nodiscard]] std::string relative(const std::string& name) const { return fs::relative(path(name)).string(); }
  static std::string refusal(const std::function<void()>& what) {
    try {
      what();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  [[nodiscard]] std::vector<std::string> spellings() const {
    return {path("part.step"),        path("./sub/../part.step"), path("here/part.step"), path("link.step"),
            path("link-of-link"),     path("hard.step"),          path("here/hard.step"), relative("part.step"),
            relative("link-of-link"), path("sub//../part.step")};
  }
};

TEST_F(ReadFilesTest, AnyNameOfAFileIsThatFile) {
  for (const std::string& read : spellings())
    for (const std::string& written : spellings()) {
      SCOPED_TRACE(read + " and " + written);
      ReadFiles files;
      files.add(read, "as the part");
      const std::string message = refusal([&] { files.require_not_written(written); });
      EXPECT_TRUE(message.starts_with(written + ": is ")) << message;
      EXPECT_NE(message.find("(as the part) and would be overwritten; give another name"), std::string::npos)
          << message;
      EXPECT_TRUE(is_same_file(read, written));
    }
}

TEST_F(ReadFilesTest, OthersMayBeWritten) {
  ReadFiles files;
  files.add(path("part.step"), "as the part");
  files.add("cylinder:radius=3", "as the tool");
  files.add("", "as nothing");
  write("Part.step", "another one, where the file system tells cases apart");
  const bool tells = content("part.step") == "part";
  EXPECT_EQ(refusal([&] { files.require_not_written(path("Part.step")); }) == "accepted", tells);
  for (const char* name : {"other.step", "sub/part.step", "part.step.bak", "sub"})
    EXPECT_EQ(refusal([&] { files.require_not_written(path(name)); }), "accepted") << name;
  EXPECT_FALSE(is_same_file(path("part.step"), path("other.step")));
}

TEST_F(ReadFilesTest, OfAFolderTheFilesInItAreRead) {
  write("sub/a.json", "tool");
  ReadFiles files;
  files.add(path("sub"), "as the catalogue");
  EXPECT_NE(refusal([&] { files.require_not_written(path("sub/a.json")); }), "accepted");
  EXPECT_EQ(refusal([&] { files.require_not_written(path("sub/b.json")); }), "accepted");
  EXPECT_NE(refusal([&] { files.require_none_below(path("here/sub")); }), "accepted");
  EXPECT_EQ(refusal([&] { files.require_none_below(path("su")); }), "accepted");
}

TEST_F(ReadFilesTest, WhileAListIsInForceNoWriterTouchesItsFiles) {
  for (const std::string& name : spellings()) {
    SCOPED_TRACE(name);
    ReadFiles files;
    files.add(path("part.step"), "as the part");
    {
      const Unwritten unwritten(files);
      EXPECT_NE(refusal([&] { write_file(name, "page"); }), "accepted");
      EXPECT_NE(refusal([&] { const AtomicFile file(name); }), "accepted");
      EXPECT_EQ(content("part.step"), "part");
      EXPECT_EQ(refusal([&] { write_file(path("page.html"), "page"); }), "accepted");
    }
    EXPECT_EQ(refusal([&] { require_unread(name); }), "accepted") << "no longer in force";
  }
}

}  // namespace
}  // namespace flank::internal
