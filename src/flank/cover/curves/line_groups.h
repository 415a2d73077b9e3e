/// Groups of lines in the order of a motion (paper B, section 4.4): which lines follow each other as the tool moves on?
#pragma once

#include <vector>

#include "flank/cover/curves/straight_lines.h"

namespace flank::internal {

struct LineGroupOptions {
  double reach = 4.0;  ///< farthest way to the next line, in median distances of a line to its nearest other
  /// Of the way to the next line: how far that line may lie from where the best tangential velocity takes the last one.
  double most_deviation = 0.5;
  double deviation_weight = 4.0;  ///< the next line is the one of least way^2 + weight deviation^2
  int most_uses = 2;              ///< no group starts at a line that is in so many groups already
  int least_lines = 5;            ///< of a group; motion_through needs them
  bool ends_alike = false;        ///< lines may be turned round (line_clusters.h)
};

/// A group: poses of a motion in their order, each of `lines` once, and their indices.
struct LineGroup {
  std::vector<int> lines;
  std::vector<Pose> poses;
};

/// Groups grown from the lines of least error first, each both ways: from line to line along the best tangential velocity,
/// until no line lies that way. Groups may share lines: which are used is chosen later. Distances are those of
/// line_clusters.h.
[[nodiscard]] std::vector<LineGroup> group_lines(const std::vector<StraightLine>& lines, double axis_length,
                                                 const LineGroupOptions& options);

}  // namespace flank::internal
