#include "flank/wheel/rough/clear_channel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flank/wheel/rough/blank_section.h"
#include "flank/wheel/rough/channel_section.h"
#include "flank/wheel/rough/cycles.h"
#include "flank/wheel/rough/side_passes.h"

namespace flank::internal {
namespace {

constexpr int kLevels = 3;            ///< of a layer: along the sides the tool goes at each
constexpr double kCellShare = 0.2;    ///< of it, of the planner's stock
constexpr double kMostCells = 8e6;    ///< of that
constexpr double kSpareShare = 0.95;  ///< of the engagement that is allowed: the stock is a grid

/// The stretches of a layer.
using Layer = std::vector<ChannelLayer>;

/// Of all levels, the lowest first.
std::vector<Layer> levels_over(const FloorChannel& channel, const RadialFunction& radial, const PointOptions& options,
                               const ClearingRequest& request, const Cutter& cutter) {
  const ChannelLines lines(channel);
  const int count = kLevels * layer_count(channel, request.outline, request.layer_mm);
  std::vector<Layer> out;
  std::optional<AxisField> below;
  for (int level = 0; level < count; ++level) {
    PointOptions here = options;
    here.height_mm = request.keep_mm + level * request.layer_mm / kLevels;
    const TipRoom room(channel, radial, here);
    const ChannelRows rows(channel, lines, room, here);
    out.emplace_back();
    if (rows.rows().size() < 3) continue;
    const ChannelPoses poses(rows, room, here, below ? &*below : nullptr);
    out.back() = layers_of(poses, loop_length(cutter));
    below = poses.field();
  }
  return out;
}

/// Every pose of all levels, in a strip of each line across.
Path all_lines(const std::vector<Layer>& levels, const std::string& face) {
  Path out;
  for (const Layer& layer : levels)
    for (const ChannelLayer& stretch : layer)
      for (std::vector<Pose>& line : stretch.lines())
        out.strips.push_back({.id = 1, .kind = "rough", .face = face, .poses = std::move(line)});
  return out;
}

/// As much of the blank as the tool comes to on any layer; nothing where it comes to none.
std::optional<StockGrid> stock_around(const Path& lines, const BlankSection& section, const Cutter& cutter) {
  Box3 box;
  const Vec3 around = Vec3::Constant(cutter.largest());
  for (const Strip& line : lines.strips)
    for (const Pose& pose : line.poses)
      for (const Cutter::Circle& circle : cutter.circles()) {
        const Vec3 p = pose.at(circle.s);
        if (section.depth(p) < -cutter.largest()) continue;
        box.add(p - around), box.add(p + around);
      }
  if (box.empty()) return {};
  const double cell = std::max(kCellShare * cutter.tip(), std::cbrt((box.high - box.low).prod() / kMostCells));
  return StockGrid(box, cell, [&](const Vec3& p) { return section.depth(p); });
}

}  // namespace

int layer_count(const FloorChannel& channel, const std::vector<Vec2>& outline, double layer_mm) {
  return 1 + static_cast<int>(std::ceil(ChannelSection(channel, outline).height() / layer_mm));
}

std::vector<Strip> clear_channel(const FloorChannel& channel, const RadialFunction& radial, const PointOptions& options,
                                 const ClearingRequest& request) {
  const Cutter cutter(radial);
  const std::vector<Layer> levels = levels_over(channel, radial, options, request, cutter);
  const Path lines = all_lines(levels, request.face);
  std::optional<StockGrid> stock = stock_around(lines, BlankSection(channel.axis, request.outline), cutter);
  if (!stock) return {};
  const CycleLimits limits{.most_engagement_rad = kSpareShare * request.most_engagement_rad,
                           .is_free = request.guard(lines)};
  std::vector<Strip> out;
  const auto clear = [&](std::size_t level, const auto& passes) {
    for (const ChannelLayer& stretch : levels[level])
      for (Strip& strip : passes(stretch, cutter, limits, request.face, *stock)) {
        strip.layer = request.layers - static_cast<int>(level) / kLevels;
        out.push_back(std::move(strip));
      }
  };
  // A layer is cleared first: what its flank has left at the sides above is taken after that.
  for (std::size_t lowest = levels.size(); lowest > 0;) {
    lowest -= kLevels;
    clear(lowest, layer_cycles);
    for (std::size_t level = lowest + kLevels; --level > lowest;) clear(level, side_passes);
  }
  return out;
}

}  // namespace flank::internal
