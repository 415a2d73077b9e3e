#include "flank/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "flank/error.h"

namespace flank::internal {
namespace {

[[noreturn]] void refuse(const std::string& file, int error) {
  throw InputError(file + ": cannot be written (" + std::strerror(error) +
                   "); give a path in a folder that exists and is writable");
}

/// Unique within the process by the counter and between processes by the number of the process.
std::string temporary_name(const std::string& file) {
  static std::atomic<unsigned> counter{0};
  return file + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
}

/// write() may take fewer bytes than it is given, and a signal may interrupt it.
void write_all(int descriptor, std::string_view content, const std::string& file) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      ::close(descriptor);
      refuse(file, error);
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

// The file is made at once, so that a wrong folder is noticed before anything is computed for it.
AtomicFile::AtomicFile(std::string file) : file_(std::move(file)), temporary_(temporary_name(file_)) {
  std::error_code ignored;
  if (file_.empty()) throw InputError("cannot write a file without a name; give a path");
  if (std::filesystem::is_directory(file_, ignored)) refuse(file_, EISDIR);
  const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse(file_, errno);
  ::close(descriptor);
}

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
  if (std::rename(temporary_.c_str(), file_.c_str()) != 0) refuse(file_, errno);
  committed_ = true;
}

void write_file(const std::string& file, std::string_view content) {
  AtomicFile atomic(file);
  const int descriptor = ::open(atomic.temporary().c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (descriptor < 0) refuse(file, errno);
  write_all(descriptor, content, file);
  if (::close(descriptor) != 0) refuse(file, errno);
  atomic.commit();
}

}  // namespace flank::internal
