// What a missing or broken file in the folder gives, and what of it reaches the page.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "flank/error.h"
#include "flank/report.h"
#include "flank/report/page_template.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kView = R"({"schema": "openflank/view/1", "part": "/a/hub.step", "faces": "F2"})";
constexpr const char* kVerify = R"({"schema": "openflank/verify/1", "verdict": "pass"})";
constexpr const char* kSummary = R"({"schema": "openflank/summary/1", "part": "/a/blade.step", "faces": "F1,F3"})";

class ReportFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!page_is_built()) GTEST_SKIP() << "built without the page: " << page_is_missing();
    root_ = fs::path(::testing::TempDir()) / ("flank_report_folder_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override {
    if (!root_.empty()) fs::remove_all(root_);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(root_ / name, std::ios::binary) << text;
  }
  std::string page() const { return make_report(root_.string()); }
  std::string title() const {
    const std::string html = page();
    const std::size_t begin = html.find("<title>") + 7;
    return html.substr(begin, html.find("</title>") - begin);
  }
  /// The page refuses the folder and names the file.
  void expect_refused(const std::string& file, const std::string& why) const {
    try {
      (void)page();
      ADD_FAILURE() << file << " was accepted";
    } catch (const InputError& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.rfind((root_ / file).string(), 0), 0u) << message;
      EXPECT_NE(message.find(why), std::string::npos) << message;
    }
  }

  fs::path root_;
};

TEST_F(ReportFolder, FilesArePackedInTheirOrderAsTheyStand) {
  write("summary.json", kSummary);
  write("verify.json", kVerify);
  write("view.json", kView);
  write("motion.json", R"({"schema": "openflank/motion/1", "machine": "mill", "joints": []})");
  write("other.json", R"({"schema": "openflank/other/1", "secret": 1})");
  const std::string html = page();
  std::size_t at = 0;
  for (const std::string& name : report_files()) {
    const std::size_t found = html.find("<script type=\"application/json\" data-file=\"" + name + "\">", at);
    ASSERT_NE(found, std::string::npos) << name;
    at = found;
  }
  for (const char* text : {kView, kVerify, kSummary}) EXPECT_NE(html.find(text), std::string::npos);
  EXPECT_EQ(html.find("secret"), std::string::npos);
  EXPECT_EQ(title(), "F2 of hub.step - OpenFlank") << "the first file that names a part";
}

TEST_F(ReportFolder, AnyOneOfTheFilesIsEnough) {
  for (const auto& [name, text] :
       {std::pair("view.json", kView), std::pair("verify.json", kVerify), std::pair("summary.json", kSummary)}) {
    write(name, text);
    const std::string html = page();
    for (const std::string& other : report_files())
      EXPECT_EQ(html.find("data-file=\"" + other + "\"") != std::string::npos, other == name) << other;
    fs::remove(root_ / name);
  }
}

TEST_F(ReportFolder, OneBrokenFileAmongGoodOnesIsRefusedByName) {
  write("view.json", kView);
  write("summary.json", kSummary);
  for (const auto& [text, why] :
       {std::pair(std::string(), "not JSON"), std::pair(std::string(kVerify, 20), "not JSON"),
        std::pair(std::string("null"), "schema"), std::pair(std::string(kView), "verify/1"),
        std::pair(std::string(R"({"schema": 1})"), "schema"),
        std::pair(std::string("{\"schema\": \"openflank/verify/1\", \"a\": \"\xff\"}"), "not JSON")}) {
    write("verify.json", text);
    expect_refused("verify.json", why);
  }
}

TEST_F(ReportFolder, AFolderInTheFilesPlaceIsRefusedByName) {
  write("view.json", kView);
  fs::create_directories(root_ / "summary.json");
  expect_refused("summary.json", "is not a file");
}

TEST_F(ReportFolder, PartAndFacesAreTexts) {
  for (const char* wrong : {"3", "null", "[\"a.step\"]", "{}"}) {
    write("view.json", std::string(R"({"schema": "openflank/view/1", "faces": "F1", "part": )") + wrong + "}");
    expect_refused("view.json", "part: expected a text");
    write("view.json", std::string(R"({"schema": "openflank/view/1", "part": "a.step", "faces": )") + wrong + "}");
    expect_refused("view.json", "faces: expected a text");
  }
  write("view.json", R"({"schema": "openflank/view/1", "part": ""})");
  EXPECT_EQ(title(), "OpenFlank report");
  write("view.json", R"({"schema": "openflank/view/1", "part": "a.step"})");
  EXPECT_EQ(title(), " of a.step - OpenFlank");
}

TEST_F(ReportFolder, RefusesFiguresOfAnotherType) {
  for (const char* wrong : {R"("bodies": 3)", R"("strips": "none")", R"("tolerance_mm": "0.1")"}) {
    write("view.json", std::string(R"({"schema": "openflank/view/1", )") + wrong + "}");
    expect_refused("view.json", "expected ");
  }
  write("view.json", kView);
  for (const char* wrong : {R"("faces": "F1")", R"("pass": "yes")", R"("worst_places": {})"}) {
    write("verify.json", std::string(R"({"schema": "openflank/verify/1", )") + wrong + "}");
    expect_refused("verify.json", "expected ");
  }
}

TEST_F(ReportFolder, AFileIsNoFolder) {
  write("view.json", kView);
  try {
    (void)make_report((root_ / "view.json").string());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("no such folder"), std::string::npos);
  }
}

TEST_F(ReportFolder, NoTextOfAFileCanEndItsElement) {
  write("summary.json",
        R"({"schema": "openflank/summary/1", "part": "/x/</title><script>alert(1)</script>.step", "faces": "<!--"})");
  const std::string html = page();
  const std::size_t data = html.find("data-file=\"summary.json\">");
  ASSERT_NE(data, std::string::npos);
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find('<', data), html.find("</script>", data)) << "the data's own end comes first";
}

TEST(PageTemplate, EachPlaceIsThereOnceAndTheTitleIsATitle) {
  if (!page_is_built()) {
    EXPECT_THROW((void)make_report("."), UsageError);
    GTEST_SKIP() << "built without the page: " << page_is_missing();
  }
  const std::string page(page_template());
  for (const std::string_view place : {kTitlePlace, kDataPlace}) {
    const std::size_t at = page.find(place);
    ASSERT_NE(at, std::string::npos) << place;
    EXPECT_EQ(page.find(place, at + 1), std::string::npos) << place << " occurs twice";
  }
  const std::size_t title = page.find(kTitlePlace);
  EXPECT_EQ(page.substr(title - 7, 7), "<title>");
  EXPECT_EQ(page.substr(title + kTitlePlace.size(), 8), "</title>");
  EXPECT_LT(page.find(kTitlePlace), page.find(kDataPlace));
  EXPECT_EQ(page.rfind("<!", 0), 0u) << "begins as HTML";
}

TEST(ReportPieces, FillingLeavesTheRestOfThePageAsItIs) {
  const std::string page = "a<!--FLANK_TITLE-->b<!--FLANK_DATA-->c";
  EXPECT_EQ(fill_page(page, "", ""), "abc");
  EXPECT_EQ(fill_page(page, "<!--FLANK_DATA-->", "data"), "a&lt;!--FLANK_DATA--&gt;bdatac") << "a title is text";
  for (const char* lacking : {"a<!--FLANK_TITLE-->", "a<!--FLANK_DATA-->"})
    EXPECT_THROW((void)fill_page(lacking, "t", "d"), InternalError);
}

}  // namespace
}  // namespace flank::internal
