// The command line that a browser gets: a program of ours stands in for it and writes down its words.
#include "flank/report/browser.h"
#include "flank/report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "flank/error.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class Browser : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(::testing::TempDir()) / ("flank_browser_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override {
    unsetenv("FLANK_BROWSER");
    fs::remove_all(root_);
  }
  /// A program that writes its words to the file `words`, then does `more`.
  std::string program(const std::string& more) const {
    const fs::path file = root_ / "browser.sh";
    std::ofstream(file) << "#!/bin/sh\nprintf '%s\\n' \"$@\" > '" << (root_ / "words").string() << "'\n" << more;
    fs::permissions(file, fs::perms::owner_all);
    return file.string();
  }
  std::vector<std::string> words() const {
    std::vector<std::string> lines;
    std::ifstream stream(root_ / "words");
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  /// What follows "--name=" in the words; empty if it is not there.
  std::string value(const std::string& name) const {
    for (const std::string& word : words())
      if (word.rfind(name + "=", 0) == 0) return word.substr(name.size() + 1);
    return "";
  }

  fs::path root_;
};

/// Writes "picture" to the file of --screenshot.
constexpr const char* kDraws =
    "for w in \"$@\"; do case \"$w\" in --screenshot=*) echo picture > \"${w#--screenshot=}\";; esac; done\n";

TEST_F(Browser, GetsSizeAndPageAndAProfileOfItsOwn) {
  setenv("FLANK_BROWSER", program(kDraws).c_str(), 1);
  make_picture((root_ / "a page #1 \xc3\xa4.html").string(), (root_ / "out.png").string(), {640, 480, "theme=dark"});
  EXPECT_EQ(value("--window-size"), "640,480");
  ASSERT_FALSE(words().empty());
  EXPECT_EQ(words().back(), "file://" + root_.string() + "/a%20page%20%231%20%C3%A4.html#theme=dark");
  const std::vector<std::string> all = words();
  EXPECT_EQ(std::count(all.begin(), all.end(), "--headless"), 1) << "no window opens";
  const std::string profile = value("--user-data-dir");
  EXPECT_FALSE(profile.empty());
  EXPECT_EQ(value("--screenshot").rfind(profile + "/", 0), 0u);
  EXPECT_FALSE(fs::exists(profile)) << "it is gone afterwards";
  std::ifstream png(root_ / "out.png");
  std::string text;
  std::getline(png, text);
  EXPECT_EQ(text, "picture");
}

TEST_F(Browser, WithoutAFragmentTheAddressEndsWithTheFile) {
  setenv("FLANK_BROWSER", program(kDraws).c_str(), 1);
  make_picture("relative/../page.html", (root_ / "out.png").string());
  EXPECT_EQ(words().back(), "file://" + (fs::current_path() / "page.html").string());
  EXPECT_EQ(value("--window-size"), "1600,1000");
}

TEST_F(Browser, OneThatFailsLeavesNoPictureAndItsStatusIsNamed) {
  setenv("FLANK_BROWSER", program(std::string(kDraws) + "exit 3\n").c_str(), 1);
  try {
    make_picture((root_ / "page.html").string(), (root_ / "out.png").string());
    FAIL();
  } catch (const InternalError& e) {
    EXPECT_NE(std::string(e.what()).find("page.html (exit 3)"), std::string::npos) << e.what();
  }
  EXPECT_FALSE(fs::exists(root_ / "out.png"));
  EXPECT_FALSE(fs::exists(value("--user-data-dir"))) << "its profile is gone all the same";
}

TEST_F(Browser, AFileThatIsNoProgramIsNoBrowser) {
  std::ofstream(root_ / "text") << "text";
  setenv("FLANK_BROWSER", (root_ / "text").c_str(), 1);
  EXPECT_EQ(find_browser(), "");
  setenv("FLANK_BROWSER", (root_ / "not there").c_str(), 1);
  EXPECT_EQ(find_browser(), "");
}

TEST_F(Browser, NamesAreLookedForInThePath) {
  const std::string file = program("");
  const std::string before = std::getenv("PATH") != nullptr ? std::getenv("PATH") : "";
  setenv("PATH", (":" + (root_ / "none").string() + ":" + root_.string()).c_str(), 1);
  setenv("FLANK_BROWSER", "browser.sh", 1);
  EXPECT_EQ(find_browser(), file);
  unsetenv("FLANK_BROWSER");
  EXPECT_EQ(find_browser(), "") << "none of the names is there";
  fs::copy_file(file, root_ / browsers().back());
  EXPECT_EQ(find_browser(), (root_ / browsers().back()).string());
  fs::copy_file(file, root_ / browsers().front());
  EXPECT_EQ(find_browser(), (root_ / browsers().front()).string()) << "the first of the names comes first";
  EXPECT_THROW(open_page("page.html"), UsageError) << "no xdg-open";
  setenv("PATH", before.c_str(), 1);
}

}  // namespace
}  // namespace flank::internal
