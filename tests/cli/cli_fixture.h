/// A scratch folder and the built command.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/process.h"
#include "sanitized.h"

namespace flank::cli {

class Cli : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(info->test_suite_name()) + "_" + info->name();
    std::replace(name.begin(), name.end(), '/', '_');
    root_ = fs::path(::testing::TempDir()) / ("flank_cli_" + std::to_string(::getpid()) + "_" + name);
    fs::remove_all(root_);
    fs::create_directories(root_ / "streams");
  }
  void TearDown() override { fs::remove_all(root_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (root_ / name).string(); }
  [[nodiscard]] Outcome flank(const std::vector<std::string>& arguments) const {
    return run_program(FLANK_BINARY, arguments, root_ / "streams");
  }

  /// The twisted blade that the program makes itself.
  [[nodiscard]] std::string make_blade() const {
    const Outcome made = flank({"example", "twisted-blade", "-o", path("blade.step")});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return path("blade.step");
  }

  /// A side that is round across and almost straight along: one strip of a cylinder along it, and soon found.
  [[nodiscard]] std::string make_side() const {
    const Outcome made = flank({"example", "elliptic-side", "-o", path("side.step")});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return path("side.step");
  }

  /// What a cone leaves: another cone fits it in a second.
  [[nodiscard]] std::string make_cone() const {
    const Outcome made = flank({"example", "envelope-cone-1", "-o", path("cone.step")});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return path("cone.step");
  }

  /// Refused with this exit code, one line that contains `what`, and nothing left in the folder `out`.
  void expect_refused(const std::vector<std::string>& arguments, int exit_code, const std::string& what) const {
    const Outcome outcome = flank(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(messages(outcome).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(what), std::string::npos) << "no '" << what << "' in: " << outcome.err;
    if (fs::is_directory(root_ / "out")) {
      EXPECT_TRUE(fs::is_empty(root_ / "out")) << "left behind: " << fs::directory_iterator(root_ / "out")->path();
    }
  }

  fs::path root_;
};

}  // namespace flank::cli
