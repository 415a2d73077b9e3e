/// Which strips of a planned path a program runs, and where it leaves them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "flank/machine/backplot.h"
#include "flank/path.h"

namespace flank::internal {

struct FollowOptions {
  double axis_length = 0.0;  ///< of the flank, mm
  double room = 0.0;         ///< mm, > 0: both ends of the axis are this near to the path's, where it is followed
};

/// What a program does otherwise than its path.
struct FollowFinding {
  std::int32_t line = 0;  ///< 0: of no block
  std::string text;
};

struct FollowedPath {
  /// Of each pose of each strip of the backplot: the strip of the path along which the tool comes there, by index; -1: none.
  std::vector<std::vector<int>> strips;
  std::vector<FollowFinding> findings;
};

/// Strips that begin where the one before ends are followed as one. A strip is entered at its beginning, and left at its end; in
/// between the program stays on it and goes forward, at feed, and all of the path is as near to the program as the program is to
/// it. The order in which strips are run that are not joined is the program's, and so are the ways between them.
[[nodiscard]] FollowedPath follow_path(const Path& path, const Backplot& plot, const FollowOptions& options);

}  // namespace flank::internal
