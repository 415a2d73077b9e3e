// A part that was kept is the part that was read; what is damaged, old or of something else is read anew.
#include "flank/io/isolated/part_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/isolated/part_bytes.h"
#include "io/isolated/small_part.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class PartCacheTest : public TemporaryFolder {
 protected:
  PartCacheTest() : TemporaryFolder("part_cache") {}

  void SetUp() override {
    TemporaryFolder::SetUp();
    cache_.folder = (root_ / "cache" / "parts").string();
    cache_.least_seconds = 0.0;
    file_ = {(root_ / "a.step").string(), "STEP", std::nullopt, ""};
    write("content");
  }

  /// The file's content, and its digest as read_part would have it.
  void write(const std::string& content) {
    std::ofstream(file_.name) << content;
    file_.sha256 = sha256(content);
  }

  /// Whether it was read, and not taken from the cache; a part that differs from the one that was read is a failure.
  bool reads() {
    const int before = reads_;
    const Part part = read_or_take(cache_, file_, [&] {
      ++reads_;
      return small_part();
    });
    EXPECT_EQ(encode_part(part), encode_part(small_part()));
    return reads_ > before;
  }

  [[nodiscard]] std::vector<fs::path> kept() const {
    std::vector<fs::path> files;
    if (fs::exists(cache_.folder))
      for (const auto& entry : fs::directory_iterator(cache_.folder)) files.push_back(entry.path());
    return files;
  }

  PartCache cache_;
  CadFile file_;
  int reads_ = 0;
};

TEST_F(PartCacheTest, IsReadOnce) {
  EXPECT_TRUE(reads());
  EXPECT_FALSE(reads());
  ASSERT_EQ(kept().size(), 1u);
  EXPECT_EQ(fs::status(cache_.folder).permissions() & fs::perms::all, fs::perms::owner_all);
}

TEST_F(PartCacheTest, IsReadAnewWhereAnythingDiffers) {
  EXPECT_TRUE(reads());
  file_.unit = "m";
  EXPECT_TRUE(reads());
  file_.format = "IGES";
  EXPECT_TRUE(reads());
  write("other");
  EXPECT_TRUE(reads());
  const std::string other = (root_ / "b.step").string();
  fs::copy_file(file_.name, other);
  file_.name = other;
  EXPECT_TRUE(reads()) << "its notes name the file";
  EXPECT_FALSE(reads());
}

TEST_F(PartCacheTest, IsReadAnewWhereWhatWasKeptIsDamaged) {
  EXPECT_TRUE(reads());
  const fs::path entry = kept().at(0);
  std::ifstream stream(entry, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t k = 0; k < bytes.size(); k += 7) {
    std::string damaged = bytes;
    damaged[k] = static_cast<char>(damaged[k] ^ 1);
    std::ofstream(entry, std::ios::binary) << damaged;
    EXPECT_TRUE(reads()) << k;
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{64}, std::size_t{128}, bytes.size() - 1}) {
    fs::resize_file(entry, length);
    EXPECT_TRUE(reads()) << length;
  }
  EXPECT_FALSE(reads());
}

TEST_F(PartCacheTest, WhatOthersMayWriteOrPointToIsNotTaken) {
  EXPECT_TRUE(reads());
  const fs::path entry = kept().at(0);
  fs::permissions(entry, fs::perms::others_write, fs::perm_options::add);
  EXPECT_TRUE(reads());
  fs::rename(entry, root_ / "elsewhere");
  fs::create_symlink(root_ / "elsewhere", entry);
  EXPECT_TRUE(reads());
}

TEST_F(PartCacheTest, AFileThatChangedWhileItWasReadIsNotKept) {
  file_.sha256 = sha256("what it was");
  EXPECT_TRUE(reads());
  EXPECT_TRUE(kept().empty());
}

TEST_F(PartCacheTest, WhatIsReadFastIsNotKept) {
  cache_.least_seconds = 1e9;
  EXPECT_TRUE(reads());
  EXPECT_TRUE(kept().empty());
}

TEST_F(PartCacheTest, WhatWasNotUsedForLongestGoesFirst) {
  const std::size_t one = 2 * 64 + encode_part(small_part()).size();
  cache_.most_bytes = 5 * one;
  for (int k = 0; k < 5; ++k) {
    write(std::to_string(k));
    EXPECT_TRUE(reads());
  }
  ASSERT_EQ(kept().size(), 5u);
  // The first is the oldest, until it is used.
  const fs::file_time_type now = fs::file_time_type::clock::now();
  for (const fs::path& path : kept()) fs::last_write_time(path, now - std::chrono::hours(1));
  write("0");
  EXPECT_FALSE(reads());
  write("5");
  EXPECT_TRUE(reads());
  EXPECT_EQ(kept().size(), 5u);
  write("0");
  EXPECT_FALSE(reads());
}

TEST_F(PartCacheTest, AFolderThatCannotBeMadeIsNoFailure) {
  std::ofstream(root_ / "cache") << "a file";
  EXPECT_TRUE(reads());
  EXPECT_TRUE(reads());
  cache_.folder.clear();
  EXPECT_TRUE(reads());
}

TEST_F(PartCacheTest, ARefusalIsNotKept) {
  EXPECT_THROW((void)read_or_take(cache_, file_, []() -> Part { throw InputError("damaged"); }), InputError);
  EXPECT_TRUE(kept().empty());
}

TEST_F(PartCacheTest, LiesWhereTheEnvironmentSays) {
  const char* home = std::getenv("HOME");
  const std::string before = home == nullptr ? "/" : home;
  ::setenv("FLANK_CACHE", "on", 1);
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(user_part_cache().folder, "/somewhere/openflank/parts");
  ::setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_EQ(user_part_cache().folder, "");
  ::setenv("XDG_CACHE_HOME", "", 1);
  ::setenv("HOME", "/home/somebody", 1);
  EXPECT_EQ(user_part_cache().folder, "/home/somebody/.cache/openflank/parts");
  ::setenv("HOME", before.c_str(), 1);
  ::setenv("FLANK_CACHE", "off", 1);
  EXPECT_EQ(user_part_cache().folder, "");
}

}  // namespace
}  // namespace flank::internal
