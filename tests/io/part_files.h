/// Files for the tests of io: real parts where they are, small ones kept with the tests, and scratch.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "flank/error.h"
#include "flank/part.h"
#include "shared_data.h"

namespace flank::internal::testing_io {

namespace fs = std::filesystem;

inline std::string own_part(const std::string& name) {
  return std::string(FLANK_SOURCE_DIR) + "/tests/io/data/" + name;
}
inline std::string corpus(const std::string& name) { return std::string(FLANK_SOURCE_DIR) + "/tests/corpus/" + name; }

/// A folder of its own for one test, removed with it.
class Scratch {
 public:
  Scratch() : folder_(fs::temp_directory_path() / ("flank_io_test-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Scratch() { fs::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

 private:
  fs::path folder_;
};

/// The message of the InputError that reading the file must end with.
inline std::string refusal(const std::string& file, const std::optional<std::string>& unit = {}) {
  try {
    (void)read_part(file, unit);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(fs::path(file).filename().string()), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << file << " was not refused";
  return {};
}

inline bool tells(const Part& part, const std::string& words) {
  for (const std::string& repair : part.repairs)
    if (repair.find(words) != std::string::npos) return true;
  return false;
}

}  // namespace flank::internal::testing_io
