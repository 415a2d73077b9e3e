/// What can be asked of `flank correct`.
#pragma once

#include <optional>
#include <string>

#include "flank/job.h"

namespace flank::internal {

/// Correct the motion of a result from what was measured.
struct CorrectJob {
  std::string folder;                   ///< of the result
  std::optional<std::string> profile;   ///< of the tool as ground
  std::optional<std::string> measured;  ///< points of the face as cut
  std::string datum = "fit";            ///< of measured points: "fit" or "keep"
  std::optional<double> limit_mm;       ///< of a correction; none: 20 times the tolerance
  bool operator==(const CorrectJob&) const = default;
};

}  // namespace flank::internal
