/// Chip, force, power and deflection along a path, and feeds at which none of them is too large.
#pragma once

#include <string>
#include <vector>

#include "flank/machine/cutting/feed_load.h"
#include "flank/machine/cutting/materials.h"
#include "flank/path.h"
#include "flank/path/engaged_arcs.h"
#include "flank/tool.h"

namespace flank::internal {

/// How a tool is run.
struct CuttingRequest {
  Material material;
  int flutes = 2;
  double helix_rad = 0.0;
  double spindle_rpm = 0.0;
  double expected_chip_mm = 0.0;  ///< about which the coefficients hold
  LoadLimits limits = {};
  double feed = 0.0, most_feed = 0.0;  ///< mm/s: what was asked for, and never more than
};

/// A place of a path: 0-based.
struct PathPlace {
  std::size_t strip = 0, pose = 0;
};

/// A figure over the time of cutting, where the load is known.
struct LoadFigure {
  double peak = 0.0, p95 = 0.0;
};

struct PathLoads {
  /// Of each pose of each strip: the least time for a mm, s; so the inverse of its feed.
  std::vector<std::vector<double>> slowness;
  LoadFigure chip_mm, force_n, power_w, deflection_mm;  ///< at these feeds
  std::size_t engaged = 0;                              ///< poses at which anything is
  double share_of_constant = 1.0;  ///< of the time that the feed of the slowest place takes everywhere
  FeedBound slowest;               ///< where the feed is the least
  PathPlace slowest_at;
  std::size_t too_much = 0;  ///< poses at which the edges alone exceed a limit: run at kCrawlShare of the feed
};

/// Of the flank, mm.
[[nodiscard]] double largest_diameter(const Tool& tool);

/// What a material asks for: the middle of its speeds, the lower end of its chip, feeds up to kMostFeedFactor times that of the chip.
[[nodiscard]] CuttingRequest usual_cutting(const Material& material, int flutes, double helix_rad, double diameter_mm);

/// Where little is engaged the feed is so much faster at most: beyond, runout and the stock's own resolution of a few
/// degrees count for more than the chip. At an engagement of 60 degrees it is reached at 17.
inline constexpr double kMostFeedFactor = 3.0;

/// Of the feed: where no feed keeps a limit.
inline constexpr double kCrawlShare = 0.05;

/// The cutter at a pose: its rings with the arcs that are engaged, and its motion for every mm of the faster end of its axis.
struct PoseCutter {
  RotatingCutter cutter;
  CutterMotion per_mm;
};
[[nodiscard]] PoseCutter cutter_at(const Tool& tool, const CuttingRequest& request, const std::vector<double>& heights,
                                   const std::vector<EngagedArc>& arcs, const std::vector<Pose>& poses, std::size_t k);

/// Of every ring of a cutter how far one newton there moves the axis at height `moved_at`, mm.
[[nodiscard]] std::vector<double> compliances(const Tool& tool, const RotatingCutter& cutter, double moved_at);

/// Feeds along a path whose engagement is known, and what the tool feels then. The same bits for any number of threads.
[[nodiscard]] PathLoads path_loads(const Tool& tool, const Path& path, const PathArcs& arcs,
                                   const CuttingRequest& request);

/// Sentences for people: how large the load is, where and by what the feed is held.
[[nodiscard]] std::vector<std::string> load_notes(const PathLoads& loads, const Path& path,
                                                  const CuttingRequest& request);

}  // namespace flank::internal
