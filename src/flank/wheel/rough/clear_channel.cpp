#include "flank/wheel/rough/clear_channel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flank/wheel/rough/blank_section.h"
#include "flank/wheel/rough/channel_section.h"
#include "flank/wheel/rough/cycles.h"

namespace flank::internal {
namespace {

constexpr double kCellShare = 0.2;    ///< of it, of the planner's stock
constexpr double kMostCells = 8e6;    ///< of that
constexpr double kSpareShare = 0.95;  ///< of the engagement that is allowed: the stock is a grid

/// The stretches of a layer.
using Layer = std::vector<ChannelLayer>;

/// The lowest first.
std::vector<Layer> layers_over(const FloorChannel& channel, const RadialFunction& radial, const PointOptions& options,
                               const ClearingRequest& request, const Cutter& cutter) {
  const ChannelLines lines(channel);
  const int count = layer_count(channel, request.outline, request.layer_mm);
  std::vector<Layer> out;
  std::optional<AxisField> below;
  for (int layer = 0; layer < count; ++layer) {
    PointOptions here = options;
    here.height_mm = request.keep_mm + layer * request.layer_mm;
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

/// As much of the blank as the tool comes to on any layer; nothing where it comes to none.
std::optional<StockGrid> stock_around(const std::vector<Layer>& layers, const BlankSection& section,
                                      const Cutter& cutter) {
  std::vector<Pose> all;
  for (const Layer& layer : layers)
    for (const ChannelLayer& stretch : layer) stretch.add_to(all);
  Box3 box;
  const Vec3 around = Vec3::Constant(cutter.largest());
  for (const Pose& pose : all)
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
  const std::vector<Layer> layers = layers_over(channel, radial, options, request, cutter);
  std::optional<StockGrid> stock = stock_around(layers, BlankSection(channel.axis, request.outline), cutter);
  if (!stock) return {};
  const CycleLimits limits{.most_engagement_rad = kSpareShare * request.most_engagement_rad};
  std::vector<Strip> out;
  for (std::size_t k = layers.size(); k-- > 0;)
    for (const ChannelLayer& stretch : layers[k])
      for (Strip& strip : layer_cycles(stretch, cutter, limits, request.face, *stock)) {
        strip.layer = request.layers - static_cast<int>(k);
        out.push_back(std::move(strip));
      }
  return out;
}

}  // namespace flank::internal
