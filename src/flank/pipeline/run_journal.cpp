#include "flank/pipeline/run_journal.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "flank/base/sha256.h"
#include "flank/job/input_files.h"
#include "flank/job/job_json.h"
#include "flank/version.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// Empty where nothing can be read: who needs the file says so.
std::string hash_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return sha256(std::string{std::istreambuf_iterator<char>(stream), {}});
}

/// Of a file; of the files of a folder, such as a catalogue; nothing of words that name neither.
std::string hash_of_named(const std::string& name) {
  std::error_code none;
  if (fs::is_regular_file(name, none)) return hash_of_file(name);
  if (name.empty() || !fs::is_directory(name, none)) return {};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(name, none))
    if (entry.is_regular_file(none)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::string hashes;
  for (const fs::path& file : files) hashes += file.filename().string() + ":" + hash_of_file(file) + "\n";
  return hashes;
}

}  // namespace

Progress with_journal(const Progress& progress) {
  Progress kept = progress;
  if (!kept.journal) kept.journal = std::make_shared<Journal>();
  return kept;
}

JournalKey journal_key(const PlanJob& job, const std::string& part_sha256) {
  PlanJob asked = job;
  std::visit([](auto& plan) { plan.part.file.clear(); }, asked);
  std::string all = job_to_json(asked);
  for (const std::string& name : input_files(asked)) all += hash_of_named(name) + "\n";
  return {kVersion, sha256(all), part_sha256};
}

}  // namespace flank::internal
