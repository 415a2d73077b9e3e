#include "flank/studio/guard.h"

#include <sys/random.h>

#include <array>

#include "flank/error.h"

namespace flank::internal {
namespace {

bool is_same(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    different |= static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k]);
  return different == 0;
}

}  // namespace

std::string new_token() {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw InternalError("the system's random numbers cannot be read");
  std::string token;
  for (const unsigned char byte : bytes) {
    token += kDigits[byte >> 4];
    token += kDigits[byte & 15];
  }
  return token;
}

std::string let_in(const Visitor& visitor, const std::string& token, int port) {
  const std::string number = std::to_string(port);
  // A name of a stranger that leads here would make his page of the same origin as ours.
  if (visitor.host != "127.0.0.1:" + number && visitor.host != "localhost:" + number) return "";
  if (!visitor.origin.empty() && visitor.origin != "http://" + visitor.host) return "";
  if (!visitor.site.empty() && visitor.site != "same-origin" && visitor.site != "none") return "";
  const std::size_t end = visitor.path.find('/', 1);
  if (visitor.path.empty() || end == std::string::npos) return "";
  if (!is_same(std::string_view(visitor.path).substr(1, end - 1), token)) return "";
  return visitor.path.substr(end);
}

}  // namespace flank::internal
