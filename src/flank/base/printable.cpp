#include "flank/printable.h"

#include <cstdint>

namespace flank {
namespace {

/// Bytes of the character that the text begins with; 0 if it is none. Its number goes to `code`.
std::size_t character(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t k) { return std::uint32_t{static_cast<unsigned char>(text[k])}; };
  const std::uint32_t first = byte(0);
  code = first;
  if (first < 0x80) return 1;
  const std::size_t size = first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (size == 0 || text.size() < size) return 0;
  code = first & (0xffu >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    if (byte(k) >> 6 != 2) return 0;
    code = code << 6 | (byte(k) & 63);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code >= kLeast[size] && code <= 0x10ffff && !surrogate ? size : 0;
}

bool is_control(std::uint32_t code) { return code < 0x20 || (code >= 0x7f && code < 0xa0); }

}  // namespace

std::string printable(std::string_view text, bool lines) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string shown;
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t size = character(text, code);
    const bool plain = size > 0 && (!is_control(code) || (lines && code == '\n'));
    const std::size_t taken = size > 0 ? size : 1;
    for (const char c : text.substr(0, taken)) {
      const auto byte = static_cast<unsigned char>(c);
      shown += plain ? std::string(1, c) : std::string("\\x") + kDigits[byte >> 4] + kDigits[byte & 15];
    }
    text.remove_prefix(taken);
  }
  return shown;
}

bool is_utf8(std::string_view text) {
  std::uint32_t code = 0;
  while (!text.empty()) {
    const std::size_t size = character(text, code);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

}  // namespace flank
