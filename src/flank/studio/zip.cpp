#include "flank/studio/zip.h"

#include <array>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// Little-endian, `bytes` of them.
void put(std::string& out, std::uint32_t value, int bytes) {
  for (int k = 0; k < bytes; ++k) out += static_cast<char>(value >> (8 * k) & 255U);
}

constexpr std::uint32_t kLocal = 0x04034b50, kCentral = 0x02014b50, kEnd = 0x06054b50;
constexpr std::uint32_t kVersion = 20, kUtf8 = 1U << 11, kFirstDay = 0x21;  // 1 January 1980

/// What the header of a file and its entry in the directory share.
void put_entry(std::string& out, std::uint32_t crc, std::size_t size, std::size_t name) {
  put(out, kVersion, 2);
  put(out, kUtf8, 2);
  put(out, 0, 2);  // stored
  put(out, 0, 2);
  put(out, kFirstDay, 2);
  put(out, crc, 4);
  for (int k = 0; k < 2; ++k) put(out, static_cast<std::uint32_t>(size), 4);
  put(out, static_cast<std::uint32_t>(name), 2);
  put(out, 0, 2);
}

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t k = 0; k < table.size(); ++k) {
      std::uint32_t value = k;
      for (int bit = 0; bit < 8; ++bit) value = (value & 1U) != 0 ? 0xEDB88320U ^ value >> 1 : value >> 1;
      table[k] = value;
    }
    return table;
  }();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 255U] ^ crc >> 8;
  return ~crc;
}

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files) {
  constexpr std::size_t kMost = 0xFFFF0000U;
  std::string out, directory;
  for (const auto& file : files) {
    const std::string &name = file.first, &content = file.second;
    if (out.size() + content.size() > kMost) throw InputError("zip: more than 4 GB");
    const std::uint32_t crc = crc32(content), at = static_cast<std::uint32_t>(out.size());
    put(out, kLocal, 4);
    put_entry(out, crc, content.size(), name.size());
    out += name + content;
    put(directory, kCentral, 4);
    put(directory, kVersion, 2);
    put_entry(directory, crc, content.size(), name.size());
    // No comment, first disk, no attributes.
    for (const int bytes : {2, 2, 2, 4}) put(directory, 0, bytes);
    put(directory, at, 4);
    directory += name;
  }
  const std::size_t begin = out.size();
  out += directory;
  put(out, kEnd, 4);
  put(out, 0, 4);
  for (int k = 0; k < 2; ++k) put(out, static_cast<std::uint32_t>(files.size()), 2);
  put(out, static_cast<std::uint32_t>(directory.size()), 4);
  put(out, static_cast<std::uint32_t>(begin), 4);
  put(out, 0, 2);
  return out;
}

}  // namespace flank::internal
