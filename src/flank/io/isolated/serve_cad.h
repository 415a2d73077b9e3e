/// The child's side of read_isolated.h.
#pragma once

namespace flank::internal {

/// Sets the limits of this process, reads, writes the part to descriptor 3 and ends the process; returns, with an exit
/// code, only if the words are wrong: FILE FORMAT UNIT SECONDS BYTES, those after the command's own.
[[nodiscard]] int serve_cad(int count, const char* const* words);

}  // namespace flank::internal
