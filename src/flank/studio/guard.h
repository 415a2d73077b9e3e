/// Who may ask a studio: nobody but the page that it served itself, to this machine.
#pragma once

#include <string>
#include <string_view>

namespace flank::internal {

/// 128 bits of the system's random numbers, as 32 hexadecimal digits. Throws InternalError.
[[nodiscard]] std::string new_token();

/// What a request says of itself; empty: it says nothing.
struct Visitor {
  std::string path;                ///< "/TOKEN/state"
  std::string host, origin, site;  ///< headers Host, Origin, Sec-Fetch-Site
};

/// The path behind the token, "/state". Empty if the request is refused: its token is wrong, its host is not ours, or another page's
/// script made it. Compares in the same time for any token.
[[nodiscard]] std::string let_in(const Visitor& visitor, const std::string& token, int port);

}  // namespace flank::internal
