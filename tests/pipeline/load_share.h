/// How much longer a path takes at one feed than by its load, at the same thickest chip.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "flank/pipeline/load/path_loads.h"

namespace flank::internal::test {

/// The ways of the faster end of the axis at their feeds, s.
inline double seconds_of(const Path& path, double axis_length, const std::vector<std::vector<double>>& slowness) {
  double seconds = 0.0;
  for (std::size_t s = 0; s < path.strips.size(); ++s) {
    const std::vector<Pose>& poses = path.strips[s].poses;
    for (std::size_t k = 1; k < poses.size(); ++k) {
      const double way = std::max((poses[k].at(0.0) - poses[k - 1].at(0.0)).norm(),
                                  (poses[k].at(axis_length) - poses[k - 1].at(axis_length)).norm());
      seconds += way * std::max(slowness[s][k - 1], slowness[s][k]);
    }
  }
  return seconds;
}

/// By the load the thickest chip is what is asked for; at the one feed with the same peak everywhere the path takes longer.
inline void expect_shorter_by_load(const Tool& tool, const Path& path, const PathArcs& arcs, double share) {
  CuttingRequest asked = usual_cutting(find_material("steel-c45"), 4, std::numbers::pi / 6.0, largest_diameter(tool));
  asked.most_feed = 20000.0 / 60.0;
  const PathLoads by_load = path_loads(tool, path, arcs, asked);
  double slowest = 0.0;
  for (const std::vector<double>& strip : by_load.slowness)
    for (const double at : strip) slowest = std::max(slowest, at);
  CuttingRequest even = asked;
  even.feed = even.most_feed = 1.0 / slowest;
  const PathLoads constant = path_loads(tool, path, arcs, even);
  EXPECT_NEAR(constant.chip_mm.peak, by_load.chip_mm.peak, 1e-3 * by_load.chip_mm.peak);
  const double length = tool.radial.axis_length(), mine = seconds_of(path, length, by_load.slowness),
               theirs = seconds_of(path, length, constant.slowness);
  EXPECT_LT(mine, share * theirs);
  EXPECT_NEAR(mine / theirs, by_load.share_of_constant, 0.02) << "what the notes tell";
  ::testing::Test::RecordProperty("share_of_constant", std::to_string(mine / theirs));
}

}  // namespace flank::internal::test
