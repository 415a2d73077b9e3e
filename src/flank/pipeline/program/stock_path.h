/// The motion of a program as strips that are replayed in a stock.
#pragma once

#include <cstdint>
#include <vector>

#include "flank/machine/backplot.h"
#include "flank/path.h"

namespace flank::internal {

/// Kinds of the strips that are none of the planned path.
inline constexpr const char* kRapidKind = "rapid";
inline constexpr const char* kFeedKind = "feed";

struct StockPath {
  Path path;
  std::vector<std::vector<std::int32_t>> lines;  ///< of each pose of each strip
};

/// A new strip where the program goes from one strip of `plan` to another, from feed to rapid, or turns sharply: the engagement of a
/// pose is that of the motion through it. `followed` says which strip of the plan a pose is on (follow_path); its kind is the
/// plan's, never what a comment of the program says: ramps and plunges are held to no limit.
/// `axis_length`: of the flank, mm.
[[nodiscard]] StockPath stock_path(const Backplot& plot, const Path& plan,
                                   const std::vector<std::vector<int>>& followed, double axis_length);

}  // namespace flank::internal
