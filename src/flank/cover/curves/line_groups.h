/// Groups of lines in the order of a motion (paper B, section 4.4): which lines follow each other as the tool moves on?
#pragma once

#include <vector>

#include "flank/cover/curves/straight_lines.h"

namespace flank::internal {

/// The lines are those of clusters, so their spacing is uneven; lengths are therefore relative to it. Settings that
/// work on the faces of docs/algorithms/curves.md.
struct LineGroupOptions {
  /// Farthest distance to the next line, > 0, in median distances of a line to its nearest other. Raise it if groups
  /// end at gaps between lines; lower it if motions jump across places without any.
  double reach = 4.0;
  /// How far the next line may lie from where the best tangential velocity takes the last one, as a share of the
  /// distance to it, > 0. A half admits turns of about 27 degrees from step to step: raise it for targets that bend
  /// more between two lines.
  double most_deviation = 0.5;
  /// The next line is the one of least distance^2 + weight * deviation^2; >= 0. 0: the nearest, whatever its direction;
  /// larger: straighter.
  double deviation_weight = 4.0;
  /// No group starts at a line that is in so many groups already, >= 1; more groups, and more alike.
  int most_uses = 2;
  int least_lines = 5;      ///< of a group, >= 5: motion_through needs them
  bool ends_alike = false;  ///< lines may be turned round (line_clusters.h)
};

/// A group: poses of a motion in their order, and the indices of their lines; each line occurs once.
struct LineGroup {
  std::vector<int> lines;
  std::vector<Pose> poses;
};

/// Groups grown from the lines of least error first, each both ways: from line to line along the best tangential
/// velocity, until no line lies that way. Groups may share lines: which are used is chosen later. Distances are those
/// of line_clusters.h.
[[nodiscard]] std::vector<LineGroup> group_lines(const std::vector<StraightLine>& lines, double axis_length,
                                                 const LineGroupOptions& options);

}  // namespace flank::internal
