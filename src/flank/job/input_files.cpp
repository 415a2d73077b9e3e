#include "flank/job/input_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <variant>

#include "flank/base/rest_of.h"
#include "flank/base/sha256.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// Empty where nothing can be read: who needs the file says so.
std::string hash_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return sha256(rest_of(stream));
}

}  // namespace

std::vector<std::string> input_files(const PlanJob& job) {
  std::vector<std::string> names;
  std::visit(
      [&](const auto& plan) {
        for_each_input(plan, [&](const FieldInfo&, const std::string& word) { names.push_back(word); });
      },
      job);
  return names;
}

ReadFiles read_files(const PlanJob& job) {
  return std::visit([](const auto& plan) { return read_files(plan); }, job);
}

std::string hash_of_input(const std::string& name) {
  std::error_code none;
  if (fs::is_regular_file(name, none)) return hash_of_file(name);
  if (name.empty() || !fs::is_directory(name, none)) return {};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(name, none))
    if (entry.is_regular_file(none)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::string hashes;
  for (const fs::path& file : files) hashes += file.filename().string() + ":" + hash_of_file(file) + "\n";
  return sha256(hashes);
}

}  // namespace flank::internal
