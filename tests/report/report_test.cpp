#include "flank/report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "flank/error.h"
#include "flank/report/browser.h"
#include "flank/report/page_template.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(::testing::TempDir()) / ("flank_report_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(root_ / name) << text; }
  /// What make_report says about the folder as it is.
  std::string complaint() const {
    try {
      (void)make_report(root_.string());
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  }

  fs::path root_;
};

TEST(ReportPieces, DataCannotLeaveItsScript) {
  EXPECT_EQ(script_safe(R"({"a":"</script><!--"})"), R"({"a":"\u003c/script>\u003c!--"})");
  EXPECT_EQ(html_safe("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
}

TEST(ReportPieces, EverythingGoesToItsPlace) {
  EXPECT_EQ(fill_page("<t><!--FLANK_TITLE--></t><!--FLANK_DATA--><s>", "A & B", "<!--FLANK_TITLE-->"),
            "<t>A &amp; B</t><!--FLANK_TITLE--><s>");
  EXPECT_THROW((void)fill_page("nothing", "a", "b"), InternalError);
}

TEST(ReportPieces, ThePageHasItsPlacesAndAsksForNothingElse) {
  if (!page_is_built()) GTEST_SKIP() << "built without the page: " << page_is_missing();
  const std::string page(page_template());
  EXPECT_NE(page.find(kTitlePlace), std::string::npos);
  EXPECT_NE(page.find(kDataPlace), std::string::npos);
  for (const char* address : {"src=\"http", "href=\"http", "@import", "url(http", "//# sourceMappingURL"})
    EXPECT_EQ(page.find(address), std::string::npos) << address;
  EXPECT_NE(page.find("SPDX-License-Identifier: MIT"), std::string::npos) << "the licence of three.js must stay";
  EXPECT_LT(page.size(), 1000000u);
}

TEST_F(Report, SaysWhatIsWrongWithTheFolder) {
  if (!page_is_built()) GTEST_SKIP() << "built without the page: " << page_is_missing();
  EXPECT_NE(complaint().find("contains none of view.json"), std::string::npos);
  write("view.json", "{");
  EXPECT_NE(complaint().find("view.json: not JSON"), std::string::npos);
  write("view.json", R"({"schema": "openflank/view/2"})");
  EXPECT_NE(complaint().find("expected schema \"openflank/view/1\""), std::string::npos);
  write("view.json", "[]");
  EXPECT_NE(complaint().find("schema"), std::string::npos);
  fs::remove_all(root_);
  EXPECT_NE(complaint().find("no such folder"), std::string::npos);
}

TEST_F(Report, PacksWhatIsThere) {
  if (!page_is_built()) GTEST_SKIP() << "built without the page: " << page_is_missing();
  write("summary.json", R"({"schema": "openflank/summary/1", "part": "/home/a<b.step", "faces": "F1"})");
  const std::string page = make_report(root_.string());
  EXPECT_NE(page.find("<title>F1 of a&lt;b.step - OpenFlank</title>"), std::string::npos);
  EXPECT_NE(page.find("data-file=\"summary.json\">{\"schema\": \"openflank/summary/1\""), std::string::npos);
  EXPECT_EQ(page.find("data-file=\"view.json\""), std::string::npos);
  EXPECT_EQ(page, make_report(root_.string()));
}

TEST_F(Report, SaysThatThereIsNoBrowser) {
  ASSERT_EQ(setenv("FLANK_BROWSER", "no-such-browser", 1), 0);
  EXPECT_EQ(find_browser(), "");
  try {
    make_picture((root_ / "page.html").string(), (root_ / "page.png").string());
    ADD_FAILURE() << "made a picture without a browser";
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("Chromium"), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(root_ / "page.png"));
  // A program that succeeds and makes nothing.
  ASSERT_EQ(setenv("FLANK_BROWSER", "true", 1), 0);
  EXPECT_THROW(make_picture((root_ / "page.html").string(), (root_ / "page.png").string()), InternalError);
  EXPECT_FALSE(fs::exists(root_ / "page.png"));
  unsetenv("FLANK_BROWSER");
}

}  // namespace
}  // namespace flank::internal
