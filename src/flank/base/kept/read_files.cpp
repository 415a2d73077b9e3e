#include "flank/base/kept/read_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <mutex>

#include "flank/error.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// Where a name leads; what is not there yet keeps its last words.
std::string place_of(const std::string& name) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(name, error), error);
  return error ? fs::path(name).lexically_normal().string() : place.string();
}

bool same_bytes(const struct stat& a, const std::string& name) {
  struct stat b {};
  return ::stat(name.c_str(), &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

struct Lists {
  std::mutex mutex;
  std::vector<const ReadFiles*> in_force;
};
Lists& lists() {
  static Lists all;
  return all;
}

template <class Check>
void check_all(const Check& check) {
  const std::lock_guard lock(lists().mutex);
  for (const ReadFiles* files : lists().in_force) check(*files);
}

}  // namespace

bool is_same_file(const std::string& a, const std::string& b) {
  struct stat status {};
  return place_of(a) == place_of(b) || (::stat(a.c_str(), &status) == 0 && same_bytes(status, b));
}

void ReadFiles::add(const std::string& name, const std::string& reader) {
  std::error_code error;
  if (name.empty()) return;
  if (fs::is_regular_file(name, error)) files_.push_back({name, reader, place_of(name)});
  if (!fs::is_directory(name, error)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(name, error))
    if (entry.is_regular_file(error))
      files_.push_back({entry.path().string(), reader, place_of(entry.path().string())});
}

void ReadFiles::add(const ReadFiles& others) {
  files_.insert(files_.end(), others.files_.begin(), others.files_.end());
}

void ReadFiles::require_not_written(const std::string& output) const {
  if (output.empty() || files_.empty()) return;
  const std::string place = place_of(output);
  struct stat status {};
  const bool there = ::stat(output.c_str(), &status) == 0;
  for (const File& file : files_) {
    if (file.place != place && !(there && same_bytes(status, file.name))) continue;
    const std::string which = file.name == output ? "is read" : "is " + file.name + ", which is read";
    throw InputError(output + ": " + which + " (" + file.reader + ") and would be overwritten; give another name");
  }
}

void ReadFiles::require_none_below(const std::string& folder) const {
  const std::string begin = place_of(folder) + "/";
  for (const File& file : files_)
    if (file.place.starts_with(begin))
      throw InputError(file.name + ": is read (" + file.reader + ") and lies in " + folder +
                       ", which is for unfinished work and will be removed; put it elsewhere");
}

Unwritten::Unwritten(const ReadFiles& files) : files_(&files) {
  const std::lock_guard lock(lists().mutex);
  lists().in_force.push_back(files_);
}

Unwritten::~Unwritten() {
  const std::lock_guard lock(lists().mutex);
  auto& all = lists().in_force;
  // The last of equal ones: a list may be in force twice.
  const auto found = std::find(all.rbegin(), all.rend(), files_);
  if (found != all.rend()) all.erase(std::next(found).base());
}

void require_unread(const std::string& output) {
  check_all([&](const ReadFiles& files) { files.require_not_written(output); });
}

void require_unread_below(const std::string& folder) {
  check_all([&](const ReadFiles& files) { files.require_none_below(folder); });
}

}  // namespace flank::internal
