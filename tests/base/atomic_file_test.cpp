#include "flank/base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "flank/error.h"
#include "flank/printable.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("atomic_file_test-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] static std::string content(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  [[nodiscard]] long count() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  fs::path folder_;
};

TEST_F(AtomicFileTest, WritesTextAndBytes) {
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file(path("bytes"), bytes);
  EXPECT_EQ(content(path("bytes")), bytes);
  EXPECT_EQ(count(), 1);
}

TEST_F(AtomicFileTest, ReplacesWhatWasThere) {
  write_file(path("f"), "a much longer first version");
  write_file(path("f"), "second");
  EXPECT_EQ(content(path("f")), "second");
  EXPECT_EQ(count(), 1);
}

TEST_F(AtomicFileTest, LeavesNothingWithoutCommit) {
  write_file(path("f"), "old");
  {
    const AtomicFile file(path("f"));
    std::ofstream(file.temporary()) << "half";
    EXPECT_EQ(count(), 2);
  }
  EXPECT_EQ(content(path("f")), "old");
  EXPECT_EQ(count(), 1);
}

TEST_F(AtomicFileTest, RemovesWhatAWriterLeftThatWasKilled) {
  for (const std::string& name : {std::string("f"), std::string(255, 'x')}) {
    const pid_t child = ::fork();
    if (child == 0) {
      const AtomicFile file(path(name));
      std::ofstream(file.temporary()) << "half";
      ::_exit(0);  // without a destructor, as if it were killed
    }
    ASSERT_GT(child, 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(count(), 1);
    // Of another file, and of somebody who writes still.
    std::ofstream(path("g.part-1-1")) << "of g";
    const AtomicFile writer(path(name));
    write_file(path(name), "whole");
    EXPECT_TRUE(fs::exists(writer.temporary()));
    EXPECT_EQ(count(), 3);
    fs::remove(path(name));
    fs::remove(path("g.part-1-1"));
    fs::remove(writer.temporary());
  }
}

TEST_F(AtomicFileTest, ANameMayBeAsLongAsTheFileSystemLetsItBe) {
  // Of letters, and of characters of two and three bytes, which the temporary name must not cut apart.
  for (const std::string& letter : {std::string("x"), std::string("\u00e9"), std::string("\u20ac")})
    for (const std::size_t length : {230u, 240u, 243u, 250u, 255u}) {
      std::string name;
      while (name.size() + letter.size() <= length) name += letter;
      SCOPED_TRACE(name.size());
      const AtomicFile file(path(name));
      EXPECT_TRUE(is_utf8(fs::path(file.temporary()).filename().string()));
      write_file(path(name), "whole");
      EXPECT_EQ(content(path(name)), "whole");
    }
  try {
    write_file(path(std::string(256, 'x')), "too long");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("give a shorter name"), std::string::npos) << error.what();
  }
}

TEST_F(AtomicFileTest, TheTemporaryLiesInTheSameFolder) {
  const AtomicFile file(path("f"));
  EXPECT_EQ(fs::path(file.temporary()).parent_path(), folder_);
}

TEST_F(AtomicFileTest, RefusesAFolderThatIsNotThere) {
  try {
    write_file(path("no/such/f"), "x");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no/such/f"), std::string::npos) << error.what();
  }
  EXPECT_EQ(count(), 0);
}

TEST_F(AtomicFileTest, RefusesAFolderAndAnEmptyName) {
  fs::create_directories(folder_ / "sub");
  EXPECT_THROW(write_file(path("sub"), "x"), InputError);
  EXPECT_THROW(write_file("", "x"), InputError);
  EXPECT_EQ(count(), 1);
}

TEST_F(AtomicFileTest, WritesWhereALinkLeads) {
  write_file(path("real"), "old");
  fs::create_symlink("real", folder_ / "link");
  write_file(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(path("real")), "new");
  fs::create_symlink("not-yet", folder_ / "dangling");
  write_file(path("dangling"), "x");
  EXPECT_EQ(content(path("not-yet")), "x");
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_THROW(write_file(path("circle"), "x"), InputError);
}

TEST_F(AtomicFileTest, RefusesDevices) {
  EXPECT_THROW(write_file("/dev/null", "x"), InputError);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace flank::internal
