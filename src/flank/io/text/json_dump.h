/// JSON as text, whatever bytes the names of files in it hold.
#pragma once

#include <string>

namespace flank::internal {

/// Bytes that are not UTF-8 become U+FFFD; what must read back as it was is encoded before (base/file_name.h).
template <class Json>
[[nodiscard]] std::string dumped(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace flank::internal
