#include "flank/wheel/point/floor_passes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/wheel/point/axis_field.h"
#include "flank/wheel/point/channel_rows.h"
#include "flank/wheel/point/wall_passes.h"

namespace flank::internal {
namespace {

constexpr int kMostPasses = 1024;
constexpr int kColumns = 9;     ///< of the net of directions, across
constexpr double kNetMm = 2.5;  ///< and along

/// Between passes on a floor that bends like this across, mm.
double spacing(double tip_mm, double bend, const PointOptions& options) {
  if (options.apart_mm > 0.0) return options.apart_mm;
  const double open = std::max(1.0 / tip_mm - bend, 0.1 / tip_mm);
  return std::sqrt(8.0 * options.scallop_share * options.tolerance_mm / open);
}

/// Every so many rows of the channel the net has one.
int net_stride(const std::vector<ChannelRow>& rows) {
  const double step =
      rows.size() > 1 ? (rows.back().along - rows.front().along) / (static_cast<double>(rows.size()) - 1.0) : kNetMm;
  return std::max(1, static_cast<int>(kNetMm / step));
}

struct Plan {
  const ChannelRows& channel;
  const TipRoom& room;
  const PointOptions& options;
  std::vector<double> steps;  ///< between passes, of each row, mm; 0: none there
  std::size_t passes = 0;
};

/// As many passes as the widest row needs. In narrow rows each second, fourth ... is left out.
void count_passes(Plan& plan) {
  const std::vector<ChannelRow>& rows = plan.channel.rows();
  double most = 1.0;
  for (const ChannelRow& row : rows) {
    const std::optional<TipRoom::Rest> middle = row.open ? plan.channel.rest(row, 0.5) : std::nullopt;
    plan.steps.push_back(middle ? spacing(plan.room.tip_mm(), middle->k1, plan.options) : 0.0);
    if (middle) most = std::max(most, std::ceil((row.high - row.low) * row.width / plan.steps.back()));
  }
  plan.passes = static_cast<std::size_t>(std::min<double>(most, kMostPasses)) + 1;
}

/// Whether pass j is needed in a row. Those whose number has more factors of two are left out last.
bool is_needed(const Plan& plan, std::size_t row, std::size_t j) {
  const ChannelRow& here = plan.channel.rows()[row];
  if (!here.open || !(plan.steps[row] > 0.0)) return false;
  if (j == 0 || j + 1 == plan.passes) return true;
  const double apart = (here.high - here.low) * here.width / (static_cast<double>(plan.passes) - 1.0);
  std::size_t stride = 1;
  while (2.0 * static_cast<double>(stride) * apart <= plan.steps[row]) stride *= 2;
  return j % stride == 0;
}

AxisField field_of(const ChannelRows& channel, const TipRoom& room) {
  const std::vector<ChannelRow>& rows = channel.rows();
  const int stride = net_stride(rows), count = (static_cast<int>(rows.size()) - 1) / stride + 1;
  std::vector<std::optional<TipRoom::Rest>> places(static_cast<std::size_t>(count * kColumns));
  parallel_for(places.size(), [&](std::size_t k) {
    const ChannelRow& row = rows[k / kColumns * static_cast<std::size_t>(stride)];
    if (row.open) places[k] = channel.rest(row, static_cast<double>(k % kColumns) / (kColumns - 1));
  });
  return {room, places, count, kColumns};
}

/// A pass: what is not needed and what has no room is absent.
PoseRow floor_row(const Plan& plan, const AxisField& field, double stride, std::size_t j) {
  const std::vector<ChannelRow>& rows = plan.channel.rows();
  const double share = static_cast<double>(j) / std::max(1.0, static_cast<double>(plan.passes) - 1.0);
  PoseRow out(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // A row beyond the last one that needs this pass is taken along: neighbours change over between rows.
    const bool needed = is_needed(plan, i, j) || (i > 0 && is_needed(plan, i - 1, j)) ||
                        (i + 1 < rows.size() && is_needed(plan, i + 1, j));
    if (!needed || !rows[i].open) continue;
    const std::optional<TipRoom::Rest> rest = plan.channel.rest(rows[i], share);
    if (!rest || (plan.options.is_air && plan.options.is_air(rest->center))) continue;
    const Pose pose{rest->center, field.at(static_cast<double>(i) / stride, share * (kColumns - 1))};
    if (plan.room.is_free(pose)) out[i] = pose;
  }
  return out;
}

std::vector<PoseRow> floor_rows(const ChannelRows& rows, const TipRoom& room, const PointOptions& options,
                                const AxisField& field) {
  const double stride = net_stride(rows.rows());
  Plan plan{rows, room, options, {}, 0};
  count_passes(plan);
  std::vector<PoseRow> found(plan.passes);
  parallel_for(found.size(), [&](std::size_t j) { found[j] = floor_row(plan, field, stride, j); });
  return found;
}

}  // namespace

std::vector<Strip> point_passes(const FloorChannel& channel, const RadialFunction& radial, const PointOptions& options,
                                const std::string& floor, const std::string& first, const std::string& second) {
  const TipRoom room(channel, radial, options);
  const ChannelRows rows(channel, room);
  if (rows.rows().size() < 3) return {};
  const AxisField field = field_of(rows, room);
  std::vector<Strip> out;
  add_strips(floor_rows(rows, room, options, field), radial, options, "floor", floor, out);
  const double stride = net_stride(rows.rows());
  for (const bool at_first : {true, false}) {
    const auto axis = [&](std::size_t row, double inwards) {
      const double column = (kColumns - 1) * inwards;
      return field.at(static_cast<double>(row) / stride, at_first ? column : kColumns - 1 - column);
    };
    add_strips(wall_rows({channel, rows, room, options, axis, at_first}), radial, options, "wall",
               at_first ? first : second, out);
  }
  return out;
}

std::vector<Strip> layer_passes(const FloorChannel& channel, const RadialFunction& radial, const PointOptions& options,
                                const std::string& floor) {
  const TipRoom room(channel, radial, options);
  const ChannelRows rows(channel, room);
  if (rows.rows().size() < 3) return {};
  std::vector<Strip> out;
  add_strips(floor_rows(rows, room, options, field_of(rows, room)), radial, options, "rough", floor, out);
  return out;
}

double channel_width(const FloorChannel& channel, const RadialFunction& radial) {
  const TipRoom room(channel, radial, {});
  const ChannelRows rows(channel, room);
  std::vector<double> widths;
  for (const ChannelRow& row : rows.rows()) widths.push_back(row.width);
  if (widths.size() < 3) return 0.0;
  std::sort(widths.begin(), widths.end());
  return widths[widths.size() / 10];
}

}  // namespace flank::internal
