/// CAD files read in a child process with limits of time and memory: a damaged file can bring down the CAD kernel, or keep
/// it busy for ever, but not this program (docs/decisions/0017-cad-files-in-a-child-process.md).
#pragma once

#include <optional>
#include <string>

#include "flank/part.h"

namespace flank::internal {

/// What a child may use.
struct ReadLimits {
  std::optional<double> seconds;  ///< of processor time; none: by the size of the file, see default_seconds
};

/// Seconds for a file of so many bytes: many times what a sound file takes.
[[nodiscard]] double default_seconds(double bytes);

/// First word of the command line of a child; its program must call serve_cad (serve_cad.h) then, and do nothing else.
inline constexpr const char* kReadCadCommand = "read-cad-file";

/// Runs this very program (/proc/self/exe) as `flank read-cad-file FILE FORMAT UNIT SECONDS BYTES` and returns what it
/// read. Throws InputError, naming the file, for what read_cad refuses, and where the child crashed, took longer or
/// needed more memory than it may.
[[nodiscard]] Part read_cad_isolated(const std::string& file, const std::string& format,
                                     const std::optional<std::string>& unit, const ReadLimits& limits);

}  // namespace flank::internal
