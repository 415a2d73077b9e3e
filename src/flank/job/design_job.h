/// What can be asked of `flank design`.
#pragma once

#include <optional>
#include <string>

#include "flank/job.h"

namespace flank::internal {

/// Find the set of tools that finishes several faces, each face by one of them.
struct DesignJob {
  /// Each of its `faces` is a target of its own, and must be named; `skin` is not used.
  PartRequest part{.file = {}, .unit = {}, .faces = {}, .skin = {}, .side = {}};
  int tools = 0;                         ///< most tools; 0: the smallest set
  std::string source = "fit";            ///< of candidates: "fit", "catalogue" or "both"
  std::string shape = "free";            ///< of fitted tools: "free", or a family of which parameters are open
  std::optional<double> axis_length_mm;  ///< of fitted tools
  bool avoid = true;                     ///< fits keep clear of the other faces; covers and the judge always do
  RadiusRequest radius;                  ///< of free tools
  ChoiceRequest choice;                  ///< catalogue, and the rates of the machining time
  ObstacleRequest obstacles;
  /// One reach_radius for all tools, or the widest would have the least to do; none: by the smallest face and
  /// RadiusRequest::slenderness_max.
  JudgeRequest judge{.least_coverage = 0.99, .sample_mm = {}, .reach_radius_mm = {}};
  double tolerance_mm = 0.01;
  double tool_change_min = 0.0;  ///< time that each tool of the set costs
  bool operator==(const DesignJob&) const = default;
};

}  // namespace flank::internal
