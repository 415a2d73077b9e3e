#include "flank/base/file_name.h"

#include <cctype>
#include <charconv>
#include <string_view>

#include "flank/printable.h"

namespace flank::internal {
namespace {

constexpr std::string_view kMark = "file:";

/// What an address holds as it is (RFC 3986, unreserved, and the slash).
bool is_plain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("/-._~").find(c) != std::string_view::npos;
}

}  // namespace

std::string text_of_name(const std::string& name) {
  if (is_utf8(name) && !name.starts_with(kMark)) return name;
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text(kMark);
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && is_plain(c))
      text += c;
    else
      (text += '%') += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return text;
}

std::string name_of_text(const std::string& text) {
  if (!text.starts_with(kMark)) return text;
  std::string name;
  for (std::size_t at = kMark.size(); at < text.size(); ++at) {
    unsigned byte = 0;
    const char* digits = text.data() + at + 1;
    const bool coded =
        text[at] == '%' && at + 2 < text.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
    name += coded ? static_cast<char>(byte) : text[at];
    if (coded) at += 2;
  }
  return name;
}

}  // namespace flank::internal
