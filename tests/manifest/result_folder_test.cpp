// A folder of results: exchanged as one thing, locked, and refused where its files do not belong together.
#include "flank/manifest/result_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "flank/base/sha256.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;
using Use = ResultFolder::Use;
using Files = std::map<std::string, std::string>;

class ResultFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("result_folder_test-" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  [[nodiscard]] std::string folder() const { return (root_ / "out").string(); }
  void write(const std::string& name, const std::string& content) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name, std::ios::binary) << content;
  }
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ifstream in(root_ / "out" / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] Files all() const {
    Files found;
    for (const auto& entry : fs::directory_iterator(root_ / "out"))
      found[entry.path().filename().string()] = content(entry.path().filename().string());
    return found;
  }
  [[nodiscard]] Manifest manifest() const {
    return {.made_by = "fit", .folder = folder(), .part = {"/p.step", "00"}, .judged = {"/p.step", "00"}, .files = {}};
  }
  void replace(const Files& files) const { ResultFolder(folder(), Use::kWrite).replace(files, manifest()); }
  /// The message, "accepted" if there is none.
  static std::string refusal(const std::function<void()>& what) {
    try {
      what();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path root_;
};

TEST_F(ResultFolderTest, ReplacesAResultAndLeavesOthersFiles) {
  replace({{"tool.json", "a"}, {"path.json", "b"}, {"ranking.json", "c"}});
  write("out/mine.txt", "mine");
  write("out/sub/mine.txt", "mine");
  replace({{"tool.json", "d"}, {"path.json", "e"}});
  EXPECT_EQ(content("tool.json"), "d");
  EXPECT_EQ(content("path.json"), "e");
  EXPECT_EQ(content("mine.txt"), "mine");
  EXPECT_TRUE(fs::exists(root_ / "out/sub/mine.txt"));
  EXPECT_FALSE(fs::exists(root_ / "out/ranking.json")) << "of the earlier result";
  const ResultFolder read(folder(), Use::kRead);
  ASSERT_TRUE(read.manifest());
  EXPECT_EQ(read.manifest()->files.at("tool.json"), sha256("d"));
  EXPECT_EQ(refusal([&] { read.require_whole(); }), "accepted");
}

TEST_F(ResultFolderTest, WhatIsAddedStaysUntilTheNextResult) {
  replace({{"tool.json", "a"}});
  {
    ResultFolder held(folder(), Use::kWriteOrRead);
    held.add({{"report.html", "page"}, {"verify.json", "v"}}, *held.manifest());
    EXPECT_EQ(held.manifest()->files.size(), 3u);
  }
  EXPECT_EQ(content("tool.json"), "a");
  replace({{"tool.json", "b"}});
  EXPECT_FALSE(fs::exists(root_ / "out/report.html"));
  EXPECT_FALSE(fs::exists(root_ / "out/verify.json"));
}

TEST_F(ResultFolderTest, WhatOtherProgramsWroteStaysWhenAVerdictIsAdded) {
  write("out/tool.json", "a");
  write("out/path.json", "b");
  write("out/mine.txt", "mine");
  Manifest verdict = manifest();
  verdict.made_by = kMadeByVerify;
  ResultFolder(folder(), Use::kWriteOrRead).add({{"verify.json", "v"}}, verdict);
  EXPECT_EQ(content("tool.json") + content("path.json") + content("verify.json") + content("mine.txt"), "abvmine");
  EXPECT_EQ(refusal([&] { ResultFolder(folder(), Use::kRead).require_whole(); }), "accepted");
  write("out/path.json", "c");
  EXPECT_NE(refusal([&] { ResultFolder(folder(), Use::kRead).require_whole(); }), "accepted");
  ResultFolder(folder(), Use::kWriteOrRead).add({{"verify.json", "w"}}, verdict);
  EXPECT_EQ(refusal([&] { ResultFolder(folder(), Use::kRead).require_whole(); }), "accepted");
  EXPECT_EQ(content("tool.json") + content("path.json") + content("verify.json"), "acw");
}

TEST_F(ResultFolderTest, APageThatSomebodyElseWroteIsTheirs) {
  replace({{"tool.json", "a"}, {"report.html", "page"}});
  write("out/report.html", "my own");
  replace({{"tool.json", "b"}});
  EXPECT_EQ(content("report.html"), "my own");
}

TEST_F(ResultFolderTest, NamesWhatIsGone) {
  replace({{"tool.json", "a"}, {"path.json", "b"}});
  fs::remove(root_ / "out/path.json");
  const ResultFolder read(folder(), Use::kRead);
  EXPECT_EQ(refusal([&] {
              read.require_there({"tool.json", "ranking.json"});
            }),
            "accepted")
      << "it never had a ranking";
  const std::string message = refusal([&] { read.require_there({"tool.json", "path.json"}); });
  EXPECT_NE(message.find("out/path.json: is gone"), std::string::npos) << message;
  EXPECT_NE(message.find("make the result again"), std::string::npos) << message;
}

TEST_F(ResultFolderTest, RefusesMixturesByName) {
  replace({{"tool.json", "a"}, {"path.json", "b"}});
  write("out/path.json", "other");
  const ResultFolder read(folder(), Use::kRead);
  EXPECT_NE(refusal([&] { read.require_whole(); }).find("out/path.json"), std::string::npos);
  EXPECT_EQ(refusal([&] { read.require_whole({"path.json"}); }), "accepted");
  write("out/path.json", "b");
  write("out/verify.json", "of another result");
  EXPECT_NE(refusal([&] { read.require_whole(); }).find("out/verify.json"), std::string::npos);
}

TEST_F(ResultFolderTest, ASecondWriterIsRefused) {
  const ResultFolder first(folder(), Use::kWrite);
  EXPECT_NE(refusal([&] { const ResultFolder second(folder(), Use::kWrite); }).find("another flank"),
            std::string::npos);
  EXPECT_EQ(refusal([&] { const ResultFolder reader(folder(), Use::kRead); }), "accepted");
}

TEST_F(ResultFolderTest, AFolderThatItMadeForNothingIsRemoved) {
  { const ResultFolder held(folder(), Use::kWrite); }
  EXPECT_FALSE(fs::exists(folder()));
  fs::create_directories(folder());
  { const ResultFolder held(folder(), Use::kWrite); }
  EXPECT_TRUE(fs::exists(folder())) << "was there before";
}

TEST_F(ResultFolderTest, TakesUpWhatAKilledRunHasLeft) {
  replace({{"tool.json", "a"}, {"path.json", "b"}, {"ranking.json", "c"}});
  // Killed after one of two files was moved.
  Manifest next = manifest();
  next.files = {{"tool.json", sha256("d")}, {"path.json", sha256("e")}};
  write("out/.flank-complete/path.json", "e");
  write("out/.flank-complete/manifest.json", manifest_to_json(next));
  write("out/tool.json", "d");
  { const ResultFolder read(folder(), Use::kRead); }
  EXPECT_EQ(all(), (Files{{"tool.json", "d"}, {"path.json", "e"}, {"manifest.json", manifest_to_json(next)}}));
  // Killed before the result was complete.
  write("out/.flank-unfinished/path.json", "half");
  { const ResultFolder held(folder(), Use::kWrite); }
  EXPECT_EQ(all().size(), 3u);
  EXPECT_EQ(content("path.json"), "e");
  // Killed when only the empty folder was left.
  fs::create_directories(root_ / "out/.flank-complete");
  { const ResultFolder read(folder(), Use::kRead); }
  EXPECT_EQ(all().size(), 3u);
}

TEST_F(ResultFolderTest, RefusesLinksAndInputsInItsPlace) {
  fs::create_directories(folder());
  write("elsewhere.json", "x");
  fs::create_symlink(root_ / "elsewhere.json", root_ / "out/tool.json");
  EXPECT_NE(refusal([&] { const ResultFolder held(folder(), Use::kWrite); }).find("out/tool.json"), std::string::npos);
  fs::remove(root_ / "out/tool.json");
  write("out/tool.step", "part");
  const ResultFolder held(folder(), Use::kWrite);
  EXPECT_NE(refusal([&] { held.require_not_inputs({(root_ / "out/../out/tool.step").string()}); }).find("tool.step"),
            std::string::npos);
  EXPECT_EQ(refusal([&] {
              held.require_not_inputs({(root_ / "elsewhere.json").string(), "cone:angle=3"});
            }),
            "accepted");
}

TEST_F(ResultFolderTest, FindsThePartThatMovedWithTheFolder) {
  write("a/blade.step", "part");
  const Manifest moved{.made_by = "fit", .folder = "/old/a/out", .part = {}, .judged = {}, .files = {}};
  EXPECT_EQ(moved_with(moved, (root_ / "a/out").string(), "/old/a/blade.step"), (root_ / "a/blade.step").string());
  EXPECT_EQ(moved_with(moved, (root_ / "a/out").string(), "/old/a/gone.step"), "/old/a/gone.step");
}

TEST(ManifestFile, ReadsBackWithNamesOfAnyBytes) {
  Manifest manifest{.made_by = "verify",
                    .folder = "/a b/\xff",
                    .part = {"/x\xfe%.step", "12"},
                    .judged = {"file:/odd", "34"},
                    .files = {{"tool.json", "56"}}};
  EXPECT_EQ(manifest_from_json(manifest_to_json(manifest), "m"), manifest);
}

TEST(ManifestFile, RefusesWhatIsNone) {
  const Manifest manifest{.made_by = "fit", .folder = "/a", .part = {}, .judged = {}, .files = {{"tool.json", "56"}}};
  const std::string whole = manifest_to_json(manifest);
  for (std::size_t size = 0; size + 2 < whole.size(); ++size)
    EXPECT_THROW((void)manifest_from_json(whole.substr(0, size), "m"), InputError) << size;
  std::string outside = whole;
  outside.replace(outside.find("tool.json"), 9, "../x.json");
  EXPECT_THROW((void)manifest_from_json(outside, "m"), InputError);
}

}  // namespace
}  // namespace flank::internal
