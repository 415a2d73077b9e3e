#include "flank/wheel/point/floor_passes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/wheel/point/channel_poses.h"
#include "flank/wheel/point/wall_passes.h"

namespace flank::internal {
namespace {

constexpr int kMostPasses = 1024;
constexpr double kLeastBeyond = 0.1;  ///< of the way from pass to pass: less room beside the outermost one is none

/// Between passes on a floor that bends like this across, mm.
double spacing(double tip_mm, double bend, const PointOptions& options) {
  if (options.apart_mm > 0.0) return options.apart_mm;
  const double open = std::max(1.0 / tip_mm - bend, 0.1 / tip_mm);
  return std::sqrt(8.0 * options.scallop_share * options.tolerance_mm / open);
}

struct Plan {
  const ChannelPoses& poses;
  std::vector<double> parts;  ///< of each row, that the scallop asks for at least; 0: no pass is there
};

Plan plan_of(const ChannelPoses& poses) {
  Plan plan{poses, {}};
  for (const ChannelRow& row : poses.rows()) {
    const std::optional<TipRoom::Rest> middle = row.open ? poses.channel().rest(row, 0.5) : std::nullopt;
    plan.parts.push_back(0.0);
    if (!middle) continue;
    const double wide = (row.high - row.low) * row.width * row.square;
    plan.parts.back() = std::clamp<double>(wide / spacing(poses.room().tip_mm(), middle->k1, poses.options()), 1.0,
                                           static_cast<double>(kMostPasses));
  }
  return plan;
}

/// Passes run beside both sides of the channel, each as far from its neighbour as the scallop allows, up to the middle. Where the channel
/// widens, the next one from the low side leaves the last one from the high side, or the other way round.
struct PassNumber {
  std::size_t from_side = 0;  ///< 0: the outermost one
  bool at_low = true;
  /// Whether a row of so many parts, at least 1, is wide enough for it.
  [[nodiscard]] bool is_needed(double parts) const {
    const double n = 2.0 * static_cast<double>(from_side);
    return from_side == 0 || (at_low ? parts > n - 1.0 : parts > n);
  }
  /// Its place across such a row, 0 to 1.
  [[nodiscard]] double share(double parts) const {
    const double share = static_cast<double>(from_side) / parts;
    return at_low ? share : 1.0 - share;
  }
};

/// From the low side to the high one.
std::vector<PassNumber> passes_across(const std::vector<double>& parts) {
  const double most = *std::max_element(parts.begin(), parts.end());
  std::vector<PassNumber> out, behind;
  for (PassNumber pass; pass.is_needed(most); ++pass.from_side) out.push_back(pass);
  for (PassNumber pass{.at_low = false}; pass.is_needed(most); ++pass.from_side) behind.push_back(pass);
  out.insert(out.end(), behind.rbegin(), behind.rend());
  return out;
}

/// A pass: what is not needed and what has no room is absent.
PoseRow floor_row(const Plan& plan, const PassNumber& pass) {
  const std::vector<double>& parts = plan.parts;
  const auto is_needed = [&](std::size_t i) { return parts[i] > 0.0 && pass.is_needed(parts[i]); };
  PoseRow out(parts.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    // A row beyond the last one that needs this pass is taken along: there it meets its neighbour.
    if (parts[i] > 0.0 && (is_needed(i) || (i > 0 && is_needed(i - 1)) || (i + 1 < out.size() && is_needed(i + 1))))
      out[i] = plan.poses.at(i, pass.share(parts[i]));
  return out;
}

/// Before and behind a blade: the j-th pass, from 1 on, beyond the outermost one of the channel, as far as the tip is free there. The last
/// one of each row is as far out as that.
PoseRow row_beyond(const Plan& plan, std::size_t j, bool at_low) {
  PoseRow out(plan.parts.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const ChannelRow& row = plan.poses.rows()[i];
    if (!row.open || !(plan.parts[i] > 0.0)) continue;
    const double room = (at_low ? row.low - row.free_low : row.free_high - row.high) / (row.high - row.low),
                 before = (static_cast<double>(j) - 1.0) / plan.parts[i];
    if (room - before < kLeastBeyond / plan.parts[i]) continue;
    const double beyond = std::min(room, before + 1.0 / plan.parts[i]);
    out[i] = plan.poses.at(i, at_low ? -beyond : 1.0 + beyond);
  }
  return out;
}

std::vector<PoseRow> floor_rows(const ChannelPoses& poses) {
  const Plan plan = plan_of(poses);
  const std::vector<PassNumber> passes = passes_across(plan.parts);
  std::vector<PoseRow> found(passes.size());
  parallel_for(found.size(), [&](std::size_t j) { found[j] = floor_row(plan, passes[j]); });
  for (const bool at_low : {true, false})
    for (int j = 1; j < kMostPasses; ++j) {
      PoseRow beyond = row_beyond(plan, static_cast<std::size_t>(j), at_low);
      if (std::none_of(beyond.begin(), beyond.end(), [](const auto& pose) { return pose.has_value(); })) break;
      found.push_back(std::move(beyond));
    }
  return found;
}

}  // namespace

std::vector<Strip> point_passes(const FloorChannel& channel, const RadialFunction& radial, const PointOptions& options,
                                const std::string& floor, const std::string& first, const std::string& second) {
  const TipRoom room(channel, radial, options);
  const ChannelLines lines(channel);
  const ChannelRows rows(channel, lines, room, options);
  if (rows.rows().size() < 3) return {};
  const ChannelPoses poses(rows, room, options);
  std::vector<Strip> out;
  add_strips(floor_rows(poses), room, radial, options, "floor", floor, out);
  for (const bool at_first : {true, false}) {
    const auto axis = [&](std::size_t row, double inwards) {
      return poses.axis(row, at_first ? inwards : 1.0 - inwards);
    };
    add_strips(wall_rows({channel, rows, room, options, axis, at_first}), room, radial, options, "wall",
               at_first ? first : second, out);
  }
  return out;
}

double channel_width(const FloorChannel& channel, const RadialFunction& radial) {
  const TipRoom room(channel, radial, {});
  const ChannelLines lines(channel);
  const ChannelRows rows(channel, lines, room, {});
  std::vector<double> widths;
  for (const ChannelRow& row : rows.rows()) widths.push_back(row.width);
  if (widths.size() < 3) return 0.0;
  std::sort(widths.begin(), widths.end());
  return widths[widths.size() / 10];
}

}  // namespace flank::internal
