/// CAD files that took long to read, kept as they were read: the next command takes them from there.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "flank/io/isolated/cad_reader.h"

namespace flank::internal {

/// A folder of parts, each under a name made of the file's name, format, unit and bytes and of the program that read it.
struct PartCache {
  std::string folder;                      ///< empty: nothing is kept
  double least_seconds = 0.3;              ///< by the clock: what is read faster is not kept
  std::uint64_t most_bytes = 256'000'000;  ///< of all parts together; those that were not used for longest go first
};

/// `parts` below $XDG_CACHE_HOME/openflank, or ~/.cache/openflank. None, where the environment names neither, or has FLANK_CACHE=off.
[[nodiscard]] PartCache user_part_cache();

/// The part as it was kept, or as `read` reads it. What was kept counts only if its bytes are those that were written, and were written
/// by this program and this user. What cannot be kept is not, without a word. Throws what `read` throws.
[[nodiscard]] Part read_or_take(const PartCache& cache, const CadFile& file, const std::function<Part()>& read);

}  // namespace flank::internal
