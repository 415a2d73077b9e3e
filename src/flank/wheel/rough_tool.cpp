#include "flank/wheel/rough_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/tool_file.h"
#include "flank/wheel/floor_operation.h"
#include "flank/wheel/perform.h"
#include "flank/wheel/point/axis_rod.h"
#include "flank/wheel/point/channel_rows.h"
#include "flank/wheel/point/floor_passes.h"

namespace flank::internal {
namespace {

constexpr double kWidthShare =
    0.2;  ///< of a channel's width round the axis, that the tip's radius takes: channels run aslant
constexpr double kFloorShare = 0.5;  ///< of the floor that the finishing tool's tip comes to
constexpr double kSmaller = 0.8;     ///< the next tip that is tried
constexpr double kRoughTaperDeg = 5.0;
constexpr double kSmallestGain = 1.2;  ///< a tool that is no larger is not worth a change

/// How wide the tip has room on the floors of a sector's channels, mm, summed over their rows, which lie evenly.
double floor_room(WheelWork& work, const Tool& tool) {
  const PointOptions options = rough_options(work, tool);
  double out = 0.0;
  for (const SectorChannel& one : work.sector.channels) {
    const FloorChannel channel = floor_channel(work, one);
    const ChannelLines lines(channel);
    const TipRoom room(channel, tool.radial, options);
    const ChannelRows rows(channel, lines, room, options);
    for (const ChannelRow& row : rows.rows())
      if (row.open) out += (row.high - row.low) * row.width;
  }
  return out;
}

Tool rough_cone(double radius, double height) {
  Tool tool;
  tool.name = fmt::format("roughing cone, tip {:.2f} mm, {} degrees", radius, kRoughTaperDeg);
  tool.radial =
      RadialFunction(ToolFamily::kCone, height + radius, Eigen::Vector2d(radius, kRoughTaperDeg * M_PI / 180.0));
  return tool;
}

}  // namespace

double rough_allowance(const WheelWork& work) { return kRoughAllowanceMm + (work.equal() ? 0.0 : work.difference_mm); }

PointOptions rough_options(WheelWork& work, const Tool& tool) {
  const double keep = rough_allowance(work);
  PointOptions options = work.point_options(work.roles.hub);
  options.enter_share = -keep / work.job.tolerance_mm;
  options.height_mm = keep;
  options.shank_mm = shank_radius(tool);
  return options;
}

std::string choose_rough_tool(WheelWork& work) {
  if (work.job.most_tools < 2) return "T1";
  double width = 1e300, height = 0.0;
  for (const SectorChannel& channel : work.sector.channels)
    width = std::min(width, channel_width(floor_channel(work, channel), work.tool->radial));
  for (const WheelBlade& blade : work.sector.blades) height = std::max(height, blade.height_mm);
  const double all = floor_room(work, *work.tool), least = kSmallestGain * work.tool->radial.at(0.0).r;
  double radius = kWidthShare * width;
  const auto rounded = [&] { return std::floor(radius * 20.0) / 20.0; };
  while (rounded() >= least && floor_room(work, rough_cone(rounded(), height)) < kFloorShare * all) radius *= kSmaller;
  if (rounded() < least) return "T1";
  const Tool tool = rough_cone(rounded(), height);
  work.rough_tool = tool;
  write_tool(tool, tool_file(work, "T2"));
  return "T2";
}

}  // namespace flank::internal
