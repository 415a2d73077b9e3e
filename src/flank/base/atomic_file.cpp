#include "flank/base/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "flank/base/kept/read_files.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// Between the name of a file, and the numbers of who writes it.
constexpr std::string_view kPart = ".part-";

[[noreturn]] void refuse(const std::string& file, int error) {
  const char* advice =
      error == ENAMETOOLONG ? "give a shorter name" : "give a path in a folder that exists and is writable";
  throw InputError(file + ": cannot be written (" + std::strerror(error) + "); " + advice);
}

/// The first bytes of a name, at most so many, without half a character at their end (UTF-8).
std::string cut_name(const std::string& name, std::size_t most) {
  if (name.size() <= most) return name;
  constexpr unsigned char kMask = 0xC0, kFollows = 0x80;
  while (most > 0 && (static_cast<unsigned char>(name[most]) & kMask) == kFollows) --most;
  return name.substr(0, most);
}

/// Unique within the process by the counter and between processes by the number of the process. A name may be as long as
/// the file system lets it be: the temporary one is cut where it would be longer.
std::string temporary_name(const std::string& file) {
  static std::atomic<unsigned> counter{0};
  const std::string ending = std::string(kPart) + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  const fs::path path = file;
  return (path.parent_path() / (cut_name(path.filename().string(), NAME_MAX - ending.size()) + ending)).string();
}

/// Whether temporary_name has made this name for the file, in whatever process.
bool is_temporary_of(const std::string& name, const std::string& file) {
  const std::size_t at = name.rfind(kPart);
  if (at == std::string::npos) return false;
  const std::string numbers = name.substr(at + kPart.size());
  return name.substr(0, at) == cut_name(file, NAME_MAX - (name.size() - at)) &&
         std::count(numbers.begin(), numbers.end(), '-') == 1 &&
         numbers.find_first_not_of("0123456789-") == std::string::npos;
}

/// Removes what writers of this file have left that were killed. The system takes the lock from a process with its life, on whatever machine
/// it ran.
void remove_left(const fs::path& file) {
  std::vector<std::string> left;
  std::error_code ignored;
  const std::string folder = file.parent_path().empty() ? "." : file.parent_path().string();
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (is_temporary_of(entry.path().filename().string(), file.filename().string())) left.push_back(entry.path());
  for (const std::string& name : left) {
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(name.c_str());
    ::close(descriptor);
  }
}

/// Whether a name still leads to an open file.
bool leads_to(const std::string& name, int descriptor) {
  struct stat named = {}, open = {};
  return ::lstat(name.c_str(), &named) == 0 && ::fstat(descriptor, &open) == 0 && named.st_ino == open.st_ino &&
         named.st_dev == open.st_dev;
}

/// Where a link leads, even if nothing is there yet.
std::string followed(const std::string& file) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  fs::path at = file;
  for (int k = 0; k < kMostLinks; ++k) {
    if (!fs::is_symlink(at, error)) return at.string();
    at = at.parent_path() / fs::read_symlink(at, error);
    if (error) refuse(file, error.value());
  }
  refuse(file, ELOOP);
}

void require_place(const std::string& file) {
  if (file.empty()) throw InputError("cannot write a file without a name; give a path");
  std::error_code ignored;
  const auto status = fs::status(file, ignored);
  if (fs::is_directory(status)) refuse(file, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(file + ": is a device or a pipe; give the path of a file");
}

/// An open file; closed at the end of its life. Messages call it `shown`.
class Descriptor {
 public:
  Descriptor(const std::string& file, int flags, const std::string& shown)
      : file_(shown), number_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) refuse(shown, errno);
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  /// write() may take fewer bytes than it is given, and a signal may interrupt it.
  void write(std::string_view content) const {
    while (!content.empty()) {
      const ssize_t written = ::write(number_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) refuse(file_, errno);
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  /// Down to the disk. Some file systems have nothing to do then, and say so.
  void sync() const {
    while (::fsync(number_) != 0) {
      if (errno == EINVAL || errno == ENOTSUP || errno == EROFS) return;
      if (errno != EINTR) refuse(file_, errno);
    }
  }
  void close() {
    if (::close(std::exchange(number_, -1)) != 0 && errno != EINTR) refuse(file_, errno);
  }

 private:
  const std::string file_;
  int number_;
};

void write_open(Descriptor& descriptor, std::string_view content) {
  descriptor.write(content);
  descriptor.sync();
  descriptor.close();
}

std::string folder_of(const std::string& file) {
  const std::string folder = fs::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace

// The file is made at once, so that a wrong folder is noticed before anything is computed for it.
AtomicFile::AtomicFile(const std::string& file) : file_(followed(file)) {
  require_place(file_);
  require_unread(file_);
  // A name that is too long is told now, and not by the last step.
  if (fs::path(file_).filename().string().size() > NAME_MAX) refuse(file, ENAMETOOLONG);
  remove_left(file_);
  constexpr int kMostTries = 5;
  for (int k = 0; k < kMostTries; ++k) {
    if (lock_ >= 0) ::close(lock_);
    temporary_ = temporary_name(file_);
    lock_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (lock_ < 0) refuse(file, errno);
    // Another writer may have met it before it was locked, and taken it away.
    (void)::flock(lock_, LOCK_EX);
    if (leads_to(temporary_, lock_)) return;
  }
}

AtomicFile::~AtomicFile() {
  if (!committed_ && ::unlink(temporary_.c_str()) != 0) ::unlink(temporary_.c_str());
  ::close(lock_);
}

void AtomicFile::commit() {
  Descriptor(temporary_, O_RDONLY, file_).sync();
  rename_file(temporary_, file_);
  committed_ = true;
  sync_folder(folder_of(file_));
}

void write_file(const std::string& file, std::string_view content) {
  AtomicFile atomic(file);
  Descriptor descriptor(atomic.temporary(), O_WRONLY | O_TRUNC, file);
  write_open(descriptor, content);
  atomic.commit();
}

void write_new_file(const std::string& file, std::string_view content) {
  Descriptor descriptor(file, O_WRONLY | O_CREAT | O_EXCL, file);
  write_open(descriptor, content);
}

void sync_folder(const std::string& folder) { Descriptor(folder, O_RDONLY | O_DIRECTORY, folder).sync(); }

void rename_file(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) == 0) return;
  if (std::rename(from.c_str(), to.c_str()) != 0) refuse(to, errno);
}

}  // namespace flank::internal
