/// Feeds of a path's poses, by what is known of what they cut: the load, the engagement, or nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/io/path/engagement_json.h"
#include "flank/job.h"
#include "flank/setup/setup.h"
#include "flank/tool.h"

namespace flank::internal {

/// What a folder says of the engagement of its path.
struct FolderEngagement {
  PathEngagement largest;  ///< empty: not known
  PathArcs arcs;           ///< without heights: not known
  double limit_rad = 0.0;  ///< of a cavity's cycles; 0: no cavity
};

struct KnownFeeds {
  double feed = 0.0;  ///< mm/s, where nothing is known
  /// Of each pose of each strip the least time for a mm, s; empty lists where it is not known.
  std::vector<std::vector<double>> slowness = {};
  std::vector<std::string> notes = {};
};

/// With a material the feed follows the load: by the arcs of the folder, or by the stock that the path is said to take. Without one it
/// follows the engagement of a cavity. `request` has its spindle and feed.
[[nodiscard]] KnownFeeds known_feeds(const PostJob& request, const Setup& setup, const Tool& tool, const Path& path,
                                     const FolderEngagement& engagement);

/// What a path engages: as it is known, else that of stock of even thickness on the targets, else nothing, without heights.
[[nodiscard]] PathArcs engaged_arcs(const PathArcs& known, std::optional<double> finish_stock_mm, const Setup& setup,
                                    const Tool& tool, const Path& path);

/// Throws UsageError for what needs a material and has none.
void refuse_loads(const PostJob& request);

}  // namespace flank::internal
