/// What can be asked of `flank bound`.
#pragma once

#include <optional>

#include "flank/job.h"

namespace flank::internal {

/// Prove what a tool cannot do on a face: a given one, or any whose radii are large enough.
struct BoundJob {
  PartRequest part;
  ToolRequest tool{.spec = "free", .axis_length_mm = {}};
  std::optional<double> radius_min_mm;      ///< of a free tool; none: 1 % of the target's diagonal
  std::optional<std::string> check_faces;   ///< as in ObstacleRequest
  std::optional<std::string> ignore_faces;  ///< as in ObstacleRequest
  std::optional<double> tolerance_mm;  ///< none: a thousandth of the diagonal of the faces, rounded down to 1, 2 or 5
  bool map = false;                    ///< every face of the part by itself, whatever `part.faces` says
  int points = 300;                    ///< of a face, about
  double gap = 0.05;                   ///< a bound is close enough at most this share above what a pose reaches
  bool operator==(const BoundJob&) const = default;
};

}  // namespace flank::internal
