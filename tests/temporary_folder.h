/// A folder of its own for each test, gone with it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace flank::internal {

class TemporaryFolder : public ::testing::Test {
 protected:
  /// `name`: part of the folder's.
  explicit TemporaryFolder(std::string name) : name_(std::move(name)) {}

  void SetUp() override {
    root_ =
        std::filesystem::path(::testing::TempDir()) / (name_ + "_" + std::to_string(::getpid()) + "_" +
                                                       ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(root_);
    std::filesystem::create_directories(root_);
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  /// Of a file in it; empty if there is none.
  [[nodiscard]] std::string content(const std::string& file) const {
    std::ifstream stream(root_ / file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::filesystem::path root_;

 private:
  std::string name_;
};

}  // namespace flank::internal
