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
    return {.made_by = "fit",
            .folder = folder(),
            .part = {"/p.step", "00"},
            .judged = {"/p.step", "00"},
            .inputs = {},
            .files = {}};
  }
  void replace(const Files& files) const {
    ResultFolder(folder(), Use::kWrite).replace({files.begin(), files.end()}, manifest());
  }
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

TEST_F(ResultFolderTest, LongTextsAreMadeOneByOneWhenTheyAreWritten) {
  int made = 0;
  const auto text = [&](const std::string& of) { return [&made, of] { return of + std::to_string(++made); }; };
  FileTexts files;
  files["path.json"] = text("path ");
  files["tool.json"] = text("tool ");
  ResultFolder(folder(), Use::kWrite).replace(files, manifest());
  EXPECT_EQ(made, 2);
  EXPECT_EQ(content("path.json"), "path 1");
  EXPECT_EQ(content("tool.json"), "tool 2");
  EXPECT_EQ(refusal([&] { ResultFolder(folder(), Use::kRead).require_whole(); }), "accepted");
  // What cannot be made leaves all as it was.
  files["tool.json"] = std::function<std::string()>([]() -> std::string { throw InputError("no tool"); });
  EXPECT_THROW(ResultFolder(folder(), Use::kWrite).replace(files, manifest()), InputError);
  EXPECT_EQ(content("path.json"), "path 1");
  EXPECT_EQ(all().size(), 3u);
}

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
  replace({{"tool.step", "part"}});
  const ResultFolder held(folder(), Use::kWrite);
  ReadFiles part, others;
  part.add((root_ / "out/../out/tool.step").string(), "as the part");
  others.add((root_ / "elsewhere.json").string(), "as the tool");
  others.add("cone:angle=3", "as the tool");
  const std::string message = refusal([&] { held.require_not_inputs(part); });
  EXPECT_NE(message.find("out/tool.step"), std::string::npos) << message;
  EXPECT_NE(message.find("as the part"), std::string::npos) << message;
  EXPECT_EQ(refusal([&] { held.require_not_inputs(others); }), "accepted");
}

TEST_F(ResultFolderTest, AStrangersFileOfAnyNameOfAResultIsNeverReplaced) {
  for (const std::string& name : result_names()) {
    if (name == kManifestFile) continue;
    // Nobody says whose it is; an earlier result has no such file; tool and path of a verdict are of other programs.
    for (const std::string made_by : {"", "fit", kMadeByVerify}) {
      SCOPED_TRACE(name + " " + made_by);
      fs::remove_all(folder());
      fs::create_directories(folder());
      Manifest earlier = manifest();
      earlier.made_by = made_by;
      if (made_by == "fit") ResultFolder(folder(), Use::kWrite).replace({}, earlier);
      write("out/" + name, "a stranger's");
      if (made_by == kMadeByVerify) ResultFolder(folder(), Use::kWriteOrRead).add({}, earlier);
      const bool added_by_verify = made_by == kMadeByVerify && (name == "verify.json" || name == "view.json" ||
                                                                name == "engagement.json" || name == "motion.json");
      const std::string message = refusal([&] { replace({{name, "of a result"}}); });
      EXPECT_EQ(message == "accepted", added_by_verify) << message;
      if (added_by_verify) continue;
      EXPECT_NE(message.find("out/" + name), std::string::npos) << message;
      EXPECT_NE(message.find("give another folder"), std::string::npos) << message;
      EXPECT_EQ(content(name), "a stranger's");
    }
  }
}

TEST_F(ResultFolderTest, AVerdictReplacesOnlyAVerdict) {
  for (const std::string name : {"verify.json", "view.json", "engagement.json", "motion.json", "report.html"}) {
    SCOPED_TRACE(name);
    fs::remove_all(folder());
    write("out/" + name, "a stranger's");
    const auto add = [&] { ResultFolder(folder(), Use::kWriteOrRead).add({{name, "new"}}, manifest()); };
    EXPECT_NE(refusal(add).find("out/" + name), std::string::npos);
    EXPECT_EQ(all(), (Files{{name, "a stranger's"}}));
    write("out/" + name, name == "report.html"
                             ? "<meta name=\"generator\" content=\"OpenFlank 0.1\">"
                             : "{\"schema\": \"openflank/" + name.substr(0, name.find('.')) + "/1\"}");
    EXPECT_EQ(refusal(add), "accepted");
    EXPECT_EQ(content(name), "new");
  }
}

TEST_F(ResultFolderTest, APageThatIsAFolderOrALinkSpoilsNothing) {
  for (const bool link : {false, true}) {
    fs::remove_all(folder());
    replace({{"tool.json", "a"}});
    write("mine.txt", "mine");
    if (link)
      fs::create_symlink("../mine.txt", root_ / "out/report.html");
    else
      write("out/report.html/x", "x");
    const std::string message = refusal([&] {
      ResultFolder held(folder(), Use::kWriteOrRead);
      held.add({{"report.html", "page"}}, *held.manifest());
    });
    EXPECT_NE(message.find("report.html: is a link or no file"), std::string::npos) << message;
    EXPECT_FALSE(fs::exists(root_ / "out/.flank-complete"));
    EXPECT_EQ(fs::is_symlink(root_ / "out/report.html"), link);
    EXPECT_EQ(std::ifstream(root_ / "mine.txt").get(), 'm');
    EXPECT_EQ(refusal([&] { ResultFolder(folder(), Use::kWriteOrRead).require_whole(); }), "accepted")
        << "a later command";
  }
}

TEST_F(ResultFolderTest, AManifestThatSomebodyEditedRemovesNothingOfOthers) {
  replace({{"tool.json", "a"}});
  write("out/thesis.txt", "precious");
  const std::string whole = content("manifest.json");
  // No hash at all, or the right one.
  for (const std::string& hash : {std::string(), std::string("12"), std::string(64, 'g'), sha256("precious")}) {
    SCOPED_TRACE(hash);
    std::string edited = whole;
    edited.insert(edited.find("\"tool.json\""), "\"thesis.txt\": \"" + hash + "\", ");
    write("out/manifest.json", edited);
    const std::string message = refusal([&] { replace({{"tool.json", "b"}}); });
    if (hash == sha256("precious"))
      EXPECT_EQ(message, "accepted");
    else
      EXPECT_NE(message.find("thesis.txt\": expected 64 hexadecimal digits"), std::string::npos) << message;
    EXPECT_EQ(content("thesis.txt"), "precious");
  }
}

TEST_F(ResultFolderTest, WhatIsReadIsNotWhatIsRemovedOrReplaced) {
  replace({{"tool.json", "a"}, {"ranking.json", "read"}});
  fs::create_symlink(root_ / "out/ranking.json", root_ / "part.step");
  ReadFiles inputs;
  inputs.add((root_ / "part.step").string(), "as the part");
  const Unwritten unwritten(inputs);
  EXPECT_NE(refusal([&] { replace({{"tool.json", "b"}}); }).find("as the part"), std::string::npos);
  EXPECT_EQ(content("ranking.json"), "read");
  write("out/.flank-unfinished/fixture.step", "vice");
  ReadFiles fixture;
  fixture.add((root_ / "out/.flank-unfinished/fixture.step").string(), "as a fixture");
  const Unwritten too(fixture);
  EXPECT_NE(refusal([&] { const ResultFolder held(folder(), Use::kWriteOrRead); }).find("as a fixture"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(root_ / "out/.flank-unfinished/fixture.step"));
}

TEST_F(ResultFolderTest, FindsThePartThatMovedWithTheFolder) {
  write("a/blade.step", "part");
  const Manifest moved{.made_by = "fit", .folder = "/old/a/out", .part = {}, .judged = {}, .inputs = {}, .files = {}};
  EXPECT_EQ(moved_with(moved, (root_ / "a/out").string(), "/old/a/blade.step"), (root_ / "a/blade.step").string());
  EXPECT_EQ(moved_with(moved, (root_ / "a/out").string(), "/old/a/gone.step"), "/old/a/gone.step");
}

TEST(ManifestFile, ReadsBackWithNamesOfAnyBytes) {
  Manifest manifest{.made_by = "verify",
                    .folder = "/a b/\xff",
                    .part = {"/x\xfe%.step", "12"},
                    .judged = {"file:/odd", "34"},
                    .inputs = {{"/t\xfe.json", sha256("t")}},
                    .files = {{"tool.json", sha256("a")}}};
  EXPECT_EQ(manifest_from_json(manifest_to_json(manifest), "m"), manifest);
}

TEST(ManifestFile, RefusesWhatIsNone) {
  const Manifest manifest{
      .made_by = "fit", .folder = "/a", .part = {}, .judged = {}, .inputs = {}, .files = {{"tool.json", sha256("a")}}};
  const std::string whole = manifest_to_json(manifest);
  EXPECT_EQ(manifest_from_json(whole, "m"), manifest);
  for (std::size_t size = 0; size + 2 < whole.size(); ++size)
    EXPECT_THROW((void)manifest_from_json(whole.substr(0, size), "m"), InputError) << size;
  std::string outside = whole;
  outside.replace(outside.find("tool.json"), 9, "../x.json");
  EXPECT_THROW((void)manifest_from_json(outside, "m"), InputError);
}

}  // namespace
}  // namespace flank::internal
