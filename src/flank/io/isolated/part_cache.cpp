#include "flank/io/isolated/part_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "flank/base/atomic_file.h"
#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/isolated/part_bytes.h"
#include "flank/io/text/read_bytes.h"
#include "flank/version.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kDigest = 64;  ///< digits of a SHA-256
/// Where the running program is: its time and size tell one build from the next of the same version.
constexpr const char* kProgram = "/proc/self/exe";

/// What the part depends on; notes name the file. Empty: the program does not know itself.
std::string key_of(const CadFile& file) {
  struct stat program {};
  if (::stat(kProgram, &program) != 0) return {};
  return sha256(fmt::format("{}\n{} {} {}\n{}\n{}\n{}\n{}", kVersion, program.st_size, program.st_mtim.tv_sec,
                            program.st_mtim.tv_nsec, file.sha256, file.format, file.unit.value_or(""), file.name));
}

/// The bytes of a regular file of this user that nobody else may write; empty: it is none, or longer than `most`.
std::string bytes_of_own(const std::string& file, std::uint64_t most) {
  const int in = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (in < 0) return {};
  struct stat status {};
  std::string bytes;
  if (::fstat(in, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() &&
      (status.st_mode & S_IWOTH) == 0 && static_cast<std::uint64_t>(status.st_size) <= most)
    bytes.resize(static_cast<std::size_t>(status.st_size));
  std::size_t got = 0;
  while (got < bytes.size()) {
    const ssize_t count = ::read(in, bytes.data() + got, bytes.size() - got);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    got += static_cast<std::size_t>(count);
  }
  ::close(in);
  bytes.resize(got);
  return bytes;
}

/// Digest of all that follows, key, part.
std::string sealed(const std::string& key, const Part& part) {
  const std::string content = key + encode_part(part);
  return sha256(content) + content;
}

std::optional<Part> unsealed(const std::string& key, std::string_view bytes) {
  if (bytes.size() < 2 * kDigest || bytes.substr(kDigest, kDigest) != key) return std::nullopt;
  if (sha256(bytes.substr(kDigest)) != bytes.substr(0, kDigest)) return std::nullopt;
  try {
    return decode_part(bytes.substr(2 * kDigest));
  } catch (const InternalError&) {
    return std::nullopt;  // another layout of Part under the same name: nothing that this program wrote
  }
}

/// Makes room: what was not used for longest goes, until all that is left has `most` bytes.
void drop_oldest(const std::string& folder, std::uint64_t most) {
  struct Kept {
    fs::file_time_type used;
    fs::path path;
    std::uint64_t bytes;
  };
  std::vector<Kept> all;
  std::uint64_t sum = 0;
  std::error_code ignored;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end; it.increment(ignored)) {
    std::error_code gone;  // another command may have dropped it
    if (!it->is_regular_file(gone)) continue;
    const Kept kept{it->last_write_time(gone), it->path(), it->file_size(gone)};
    if (gone) continue;
    sum += kept.bytes;
    all.push_back(kept);
  }
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (const Kept& kept : all) {
    if (sum <= most) return;
    fs::remove(kept.path, ignored);
    sum -= kept.bytes;
  }
}

/// The child opened the file by its name: the part is that of these bytes only if they are there still.
void keep(const PartCache& cache, const CadFile& file, const std::string& name, const std::string& key,
          const Part& part) {
  try {
    const std::string bytes = sealed(key, part);
    if (bytes.size() > cache.most_bytes / 4 || sha256(read_bytes(file.name)) != file.sha256) return;
    const fs::path above = fs::path(cache.folder).parent_path();
    if (!above.empty()) fs::create_directories(above);
    if (::mkdir(cache.folder.c_str(), 0700) != 0 && errno != EEXIST) return;
    write_file(name, bytes);
    drop_oldest(cache.folder, cache.most_bytes);
  } catch (const InputError&) {  // a full disk, a folder that cannot be written: it is read again next time
  } catch (const std::bad_alloc&) {
  } catch (const fs::filesystem_error&) {
  }
}

}  // namespace

PartCache user_part_cache() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  PartCache cache;
  if (variable("FLANK_CACHE") == "off") return cache;
  std::string above = variable("XDG_CACHE_HOME");
  if (above.empty() && !variable("HOME").empty()) above = variable("HOME") + "/.cache";
  // Relative ones mean nothing, says the rule that names the variable.
  if (fs::path(above).is_absolute()) cache.folder = above + "/openflank/parts";
  return cache;
}

Part read_or_take(const PartCache& cache, const CadFile& file, const std::function<Part()>& read) {
  const std::string key = cache.folder.empty() ? "" : key_of(file);
  if (key.empty()) return read();
  const std::string name = cache.folder + "/" + key;
  if (std::optional<Part> kept = unsealed(key, bytes_of_own(name, cache.most_bytes))) {
    std::error_code ignored;
    fs::last_write_time(name, fs::file_time_type::clock::now(), ignored);
    return *std::move(kept);
  }
  const auto begin = Clock::now();
  Part part = read();
  if (std::chrono::duration<double>(Clock::now() - begin).count() >= cache.least_seconds)
    keep(cache, file, name, key, part);
  return part;
}

}  // namespace flank::internal
