#include "flank/manifest/result_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/base/rest_of.h"
#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/manifest/journal_json.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// What is being written, and what is complete and only has to be moved into its place. The second is made of the first
/// by one rename: that is the moment from which the new result is there.
constexpr const char* kUnfinished = ".flank-unfinished";
constexpr const char* kComplete = ".flank-complete";
/// A process that was killed keeps its lock until the system has taken it down.
constexpr std::chrono::milliseconds kLockPatience{1000}, kLookAgain{20};

std::string content_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file + ": cannot be read (" + std::strerror(errno) + ")");
  std::string text = rest_of(stream);
  if (stream.bad()) throw InputError(file + ": cannot be read");
  return text;
}

bool is_file(const std::string& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

/// Names that a later result, or a report, may write over or remove; no other file of the folder is ever touched.
bool is_of_a_result(const std::string& name) {
  return name == kPageFile || std::find(result_names().begin(), result_names().end(), name) != result_names().end();
}

/// Whether a file says of itself that this program wrote it under this name: its schema, the generator of a page.
bool says_it_is_ours(const std::string& name, const std::string& content) {
  if (name == kPageFile) return content.find("name=\"generator\" content=\"OpenFlank ") != std::string::npos;
  const std::string stem = name.substr(0, name.find('.'));
  return content.find("\"openflank/" + stem + "/") != std::string::npos;
}

/// Of a folder whose tool and path other programs wrote, only what this one added is ours.
bool verify_writes(const std::string& name) {
  for (const char* own : {"verify.json", "view.json", "engagement.json", "motion.json", kPageFile, kManifestFile})
    if (name == own) return true;
  return false;
}

}  // namespace

const std::vector<std::string>& result_names() {
  static const std::vector<std::string> kNames{
      "job.json",  "tool.json",   "tool.dxf",        "tool.step",    "tool.fctb",   "strips.step", "path.json",
      "path.cls",  "path.csv",    "ranking.json",    "summary.json", "verify.json", "view.json",   "blank.json",
      "stock.stl", "motion.json", "engagement.json", kJournalFile,   kManifestFile,
  };
  return kNames;
}

ResultFolder::ResultFolder(std::string folder, Use use) : folder_(std::move(folder)) {
  std::error_code error;
  if (use == Use::kWrite) {
    made_ = fs::create_directories(folder_, error);
    if (error || !fs::is_directory(folder_))
      throw InputError(folder_ + ": cannot make this folder (" + (error ? error.message() : "a file is there") +
                       "); give a folder that can be written");
  }
  if (!fs::is_directory(folder_, error))
    throw InputError(folder_ + ": no such folder; give a folder written by `flank fit`");
  writable_ = use == Use::kWrite || ::access(folder_.c_str(), W_OK | X_OK) == 0;
  try {
    if (use != Use::kRead && writable_) {
      lock();
      require_plain_names();
      require_writable();
    }
    if (fs::exists(in(kComplete), error) && writable_) {
      if (lock_ < 0) lock();
      move_into_place();
    }
    read_manifest();
    if (use == Use::kWrite) require_no_strangers();
  } catch (...) {
    clean_up();
    throw;
  }
}

ResultFolder::~ResultFolder() { clean_up(); }

void ResultFolder::clean_up() const {
  // An empty folder only: rmdir refuses any other.
  if (made_) ::rmdir(folder_.c_str());
  if (lock_ >= 0) ::close(lock_);
}

std::string ResultFolder::in(const std::string& name) const { return (fs::path(folder_) / name).string(); }

void ResultFolder::lock() {
  lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // File systems without locks have none to offer; there, only the manifest tells a mixture.
  const auto begun = std::chrono::steady_clock::now();
  while (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    if (std::chrono::steady_clock::now() - begun > kLockPatience)
      throw InputError(folder_ + ": another flank is writing to this folder; wait for it, or give another folder");
    std::this_thread::sleep_for(kLookAgain);
  }
}

/// Anew: what a killed run left unfinished never was a result.
void ResultFolder::make_unfinished() const {
  const std::string unfinished = in(kUnfinished);
  require_unread_below(unfinished);
  std::error_code ignored;
  fs::remove_all(unfinished, ignored);
  if (::mkdir(unfinished.c_str(), 0777) != 0)
    throw InputError(folder_ + ": cannot be written (" + std::strerror(errno) + "); give a folder that is writable");
}

// Fail before the work, not after it.
void ResultFolder::require_writable() {
  make_unfinished();
  std::error_code ignored;
  fs::remove(in(kUnfinished), ignored);
}

void ResultFolder::require_plain(const std::string& name) const {
  std::error_code ignored;
  const auto status = fs::symlink_status(in(name), ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(in(name) + ": is a link or no file, and a result has a file of this name; remove it, or give " +
                     (name == kPageFile ? "the page another name" : "another folder"));
}

void ResultFolder::require_plain_names() const {
  for (const std::string& name : result_names()) require_plain(name);
}

bool ResultFolder::is_ours(const std::string& name) const {
  if (!manifest_ || !manifest_->files.contains(name)) return name == kManifestFile;
  return manifest_->made_by != kMadeByVerify || verify_writes(name);
}

void ResultFolder::require_no_strangers() const {
  // What is read is told as such, before what is only there.
  for (const std::string& name : result_names()) require_unread(in(name));
  for (const std::string& name : result_names()) {
    if (!is_file(in(name)) || is_ours(name)) continue;
    throw InputError(
        in(name) + ": would be overwritten, and " +
        (manifest_ ? std::string(kManifestFile) + " does not list it as a file of an earlier result"
                   : std::string("there is no ") + kManifestFile + " that lists it as a file of an earlier result") +
        "; move it away, or give another folder");
  }
}

void ResultFolder::require_own(const std::string& name) const {
  require_plain(name);
  require_unread(in(name));
  if (!is_file(in(name)) || is_ours(name) || says_it_is_ours(name, content_of(in(name)))) return;
  throw InputError(in(name) + ": would be overwritten, and was not written by flank; move it away" +
                   (name == kPageFile ? ", or give the page another name" : ""));
}

void ResultFolder::read_manifest() {
  manifest_.reset();
  const std::string file = in(kManifestFile);
  if (is_file(file)) manifest_ = manifest_from_json(content_of(file), file);
}

void ResultFolder::replace(const FileTexts& files, Manifest manifest) {
  manifest.files.clear();
  require_no_strangers();
  publish(files, std::move(manifest));
}

void ResultFolder::add(const FileTexts& files, Manifest manifest) {
  if (manifest_) manifest.files = manifest_->files;
  for (const auto& [name, content] : files) require_own(name);
  // What other programs wrote is taken as it is now.
  for (const std::string& name : result_names())
    if (name != kManifestFile && is_file(in(name)) &&
        (manifest.made_by == kMadeByVerify || !manifest.files.contains(name)))
      manifest.files[name] = sha256(content_of(in(name)));
  publish(files, std::move(manifest));
}

void ResultFolder::publish(const FileTexts& files, Manifest manifest) {
  const std::string unfinished = in(kUnfinished);
  // What is complete must have its place, or no later command could move it there.
  for (const auto& [name, content] : files) {
    require_plain(name);
    require_unread(in(name));
  }
  try {
    make_unfinished();
    for (const auto& [name, content] : files) {
      const std::string text = content.text();
      manifest.files[name] = sha256(text);
      write_new_file((fs::path(unfinished) / name).string(), text);
    }
    write_new_file((fs::path(unfinished) / kManifestFile).string(), manifest_to_json(manifest));
    sync_folder(unfinished);
    rename_file(unfinished, in(kComplete));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
    throw;
  }
  sync_folder(folder_);
  move_into_place();
  read_manifest();
}

// Whatever was done of this before is not done again, so it may end at any point and be taken up later. The manifest goes
// last: as long as the old one is there, it says which files are of the old result.
void ResultFolder::move_into_place() {
  const fs::path complete = in(kComplete);
  const std::string manifest = (complete / kManifestFile).string();
  if (is_file(manifest)) {
    read_manifest();
    remove_stale(manifest_from_json(content_of(manifest), manifest));
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(complete))
      if (entry.path().filename() != kManifestFile) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) rename_file((complete / name).string(), in(name));
    sync_folder(folder_);
    rename_file(manifest, in(kManifestFile));
  }
  if (::rmdir(complete.c_str()) != 0 && ::rmdir(complete.c_str()) != 0)
    throw InputError(complete.string() + ": cannot be removed (" + std::strerror(errno) + ")");
  sync_folder(folder_);
}

/// Files of the old result that the new one has not. Only what the old manifest names, and only under the names that results
/// have: a page that somebody has changed since is theirs.
void ResultFolder::remove_stale(const Manifest& next) const {
  if (!manifest_) return;
  for (const auto& [name, hash] : manifest_->files) {
    if (next.files.contains(name) || name == kManifestFile || !is_of_a_result(name) || !is_file(in(name))) continue;
    if (name == kPageFile && sha256(content_of(in(name))) != hash) continue;
    require_unread(in(name));
    if (::unlink(in(name).c_str()) != 0 && ::unlink(in(name).c_str()) != 0)
      throw InputError(in(name) + ": cannot be removed (" + std::strerror(errno) + ")");
  }
}

void ResultFolder::require_whole(const std::vector<std::string>& but) const {
  if (!manifest_) return;
  for (const std::string& name : result_names()) {
    if (name == kManifestFile || std::find(but.begin(), but.end(), name) != but.end() || !is_file(in(name))) continue;
    const auto found = manifest_->files.find(name);
    if (found != manifest_->files.end() && sha256(content_of(in(name))) == found->second) continue;
    throw InputError(in(name) + ": is not of the same result as the other files (" + kManifestFile + " of `flank " +
                     manifest_->made_by + "` says so); make the result again, or, if the change is intended, remove " +
                     kManifestFile + " and run `flank verify`");
  }
}

void ResultFolder::require_there(const std::vector<std::string>& names) const {
  if (!manifest_) return;
  for (const std::string& name : names)
    if (manifest_->files.count(name) != 0 && !is_file(in(name)))
      throw InputError(in(name) + ": is gone, and " + kManifestFile + " of `flank " + manifest_->made_by +
                       "` names it; put it back or make the result again");
}

void ResultFolder::require_not_inputs(const ReadFiles& inputs) const {
  for (const std::string& name : result_names()) inputs.require_not_written(in(name));
  inputs.require_not_written(in(kPageFile));
  for (const char* name : {kUnfinished, kComplete}) inputs.require_none_below(in(name));
}

void require_not_a_result(const std::string& folder, const std::string& output) {
  std::error_code error;
  const auto clean = [&](const std::string& name) { return fs::weakly_canonical(fs::absolute(name), error); };
  for (const std::string& name : result_names()) {
    const std::string result = (fs::path(folder) / name).string();
    // The same file, by whatever name, or the same name to be.
    if (fs::equivalent(result, output, error) || clean(result) == clean(output))
      throw InputError(output + ": is a file of the result; give another name");
  }
}

void require_no_result_there(const std::string& output) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(output, error), error);
  const std::string folder = place.parent_path().string(), manifest = (fs::path(folder) / kManifestFile).string();
  if (error || !is_file(manifest)) return;
  Manifest found;
  try {
    found = manifest_from_json(content_of(manifest), manifest);
  } catch (const InputError&) {
    return;  // of another program, whose files are none of a result
  }
  // Tools and paths that came from elsewhere may come from there again.
  const std::string name = place.filename().string();
  if (name == kManifestFile || (found.made_by != kMadeByVerify && name != kPageFile && found.files.contains(name)))
    throw InputError(output + ": is a file of the result in " + folder + "; give another name");
}

}  // namespace flank::internal
