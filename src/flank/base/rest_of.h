/// What is left of a stream, as one text.
#pragma once

#include <istream>
#include <string>

namespace flank::internal {

/// From where the stream stands to its end, in blocks: character by character it takes longer than the hash of what was read. Empty if
/// the stream is not open; its state stays as it is.
[[nodiscard]] inline std::string rest_of(std::istream& in) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  std::string text;
  for (std::size_t had = 0; in; had = text.size()) {
    text.resize(had + kBlock);
    const std::streamsize got = in.rdbuf()->sgetn(text.data() + had, static_cast<std::streamsize>(kBlock));
    text.resize(had + static_cast<std::size_t>(got));
    if (got == 0) break;
  }
  return text;
}

}  // namespace flank::internal
