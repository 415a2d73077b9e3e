#include "flank/io/kernel/plain_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "flank/error.h"
#include "flank/io/text/read_bytes.h"

namespace flank::internal {
namespace {

bool begins_with_mark(const std::string& file) {
  std::array<char, 3> begin{};
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), begin.size());
  return std::string_view(begin.data(), static_cast<std::size_t>(in.gcount())) == kByteOrderMark;
}

}  // namespace

PlainFile::PlainFile(std::string file) : name_(std::move(file)) {
  if (!begins_with_mark(name_)) return;
  const std::string content = read_bytes(name_);
  std::string_view rest = std::string_view(content).substr(kByteOrderMark.size());
  copy_ = ::memfd_create("part", MFD_CLOEXEC);
  while (copy_ >= 0 && !rest.empty()) {
    const ssize_t written = ::write(copy_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  if (!rest.empty())
    throw InputError(name_ + ": its byte order mark cannot be removed (" + std::strerror(errno) +
                     "); save the file without one");
  name_ = fmt::format("/proc/self/fd/{}", copy_);
}

PlainFile::~PlainFile() {
  if (copy_ >= 0) ::close(copy_);
}

}  // namespace flank::internal
