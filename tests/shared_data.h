/// Parts and programs that do not lie in the tree: below $FLANK_DATA, else in ../shared/data beside it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace flank {

/// A file or folder of the shared data; empty where it is not.
inline std::string shared_data(const std::string& name) {
  const char* folder = std::getenv("FLANK_DATA");
  const std::filesystem::path path =
      std::filesystem::path(folder != nullptr ? folder : FLANK_SOURCE_DIR "/../shared/data") / name;
  return std::filesystem::exists(path) ? path.string() : std::string();
}

}  // namespace flank

/// Declares `path` as shared_data(name), or skips the test, which says what it lacks. For the body of a test alone.
#define FLANK_REAL_PART(path, name)                    \
  const std::string path = ::flank::shared_data(name); \
  if (path.empty()) GTEST_SKIP() << "FLANK_DATA has no " << (name)
