#include "flank/base/own_code.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>

#include "flank/base/sha256.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// A place in this object's code.
const void* here() { return reinterpret_cast<const void*>(&own_code_file); }

std::string hex_of(const unsigned char* bytes, std::size_t count) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out;
  for (std::size_t k = 0; k < count; ++k) out += {kDigits[bytes[k] >> 4U], kDigits[bytes[k] & 15U]};
  return out;
}

/// The build id among the notes of a segment; empty: none.
std::string id_of_notes(const unsigned char* at, std::size_t size, std::size_t align) {
  const auto padded = [&](std::size_t n) { return (n + align - 1) / align * align; };
  ElfW(Nhdr) note{};
  while (size >= sizeof note) {
    std::memcpy(&note, at, sizeof note);
    const std::size_t name = sizeof note, content = padded(name + note.n_namesz), end = padded(content + note.n_descsz);
    if (content + note.n_descsz > size) return {};
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(at + name, "GNU", 4) == 0)
      return hex_of(at + content, note.n_descsz);
    if (end >= size) return {};
    at += end, size -= end;
  }
  return {};
}

/// Fills a std::string with the build id of the object that holds here(), and stops there.
int look_at_object(dl_phdr_info* object, std::size_t /*size*/, void* out) {
  const auto address = reinterpret_cast<std::uintptr_t>(here());
  bool holds = false;
  std::string id;
  for (int k = 0; k < object->dlpi_phnum; ++k) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[k];
    const std::uintptr_t begin = object->dlpi_addr + segment.p_vaddr;
    if (segment.p_type == PT_LOAD) holds = holds || (address >= begin && address < begin + segment.p_memsz);
    // Segments of notes are padded to four bytes, those of larger ones to eight.
    if (segment.p_type == PT_NOTE && id.empty())
      // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader tells addresses as numbers
      id = id_of_notes(reinterpret_cast<const unsigned char*>(begin), segment.p_filesz, segment.p_align == 8 ? 8 : 4);
  }
  if (holds) *static_cast<std::string*>(out) = id;
  return holds ? 1 : 0;
}

std::string find_id() {
  std::string id;
  dl_iterate_phdr(look_at_object, &id);
  if (!id.empty()) return id;
  std::ifstream file(own_code_file(), std::ios::binary);
  return sha256(std::string(std::istreambuf_iterator<char>(file), {}));
}

}  // namespace

fs::path own_code_file() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  Dl_info info{};
  if (dladdr(here(), &info) == 0 || info.dli_fname == nullptr) return program;
  // A program may have been called by a name that is no path; a library's is what it was loaded by.
  const fs::path loaded = info.dli_fname;
  return loaded.is_absolute() && !fs::equivalent(loaded, program, error) ? loaded : program;
}

const std::string& own_code_id() {
  static const std::string id = find_id();
  return id;
}

}  // namespace flank::internal
