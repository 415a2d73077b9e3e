/// What can be asked of `flank redesign`.
#pragma once

#include <optional>
#include <string>

#include "flank/job.h"

namespace flank::internal {

/// Change faces as little as possible so that one pass of a tool leaves them exactly.
struct RedesignJob {
  PartRequest part;
  ToolRequest tool{.spec = "free", .axis_length_mm = {}};
  RadiusRequest radius;
  std::optional<std::string> weight;  ///< "le=10,root=0.2,F7=3": of the deviation near these borders
  std::optional<double>
      thickness_min_mm;          ///< what lies between the face and the opposite one gets no thinner; none: any
  std::string nearest = "mean";  ///< "mean": least squares; "largest": the largest deviation counts
  std::string heights = "10,30,50,70,90";   ///< of sections, percent from root to tip
  std::string effort = "quick";             ///< of the search that the redesign starts from: quick, normal, thorough
  std::optional<std::string> check_faces;   ///< as in ObstacleRequest
  std::optional<std::string> ignore_faces;  ///< as in ObstacleRequest
  std::optional<double> tolerance_mm;  ///< none: a thousandth of the diagonal of the faces, rounded down to 1, 2 or 5
  bool operator==(const RedesignJob&) const = default;
};

}  // namespace flank::internal
