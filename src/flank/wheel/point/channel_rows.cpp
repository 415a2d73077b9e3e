#include "flank/wheel/point/channel_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"
#include "flank/wheel/point/gentle_line.h"

namespace flank::internal {
namespace {

constexpr double kStepMm = 0.5;                                      ///< between rows along the channel
constexpr std::array<double, 5> kStarts{0.5, 0.35, 0.65, 0.2, 0.8};  ///< of the search for that, across the channel
constexpr double kMarchMm = 0.5;
constexpr int kHalvings = 10;        ///< of the search for the outermost free place
constexpr double kMostSlope = 0.15;  ///< of the outermost pass against the channel
constexpr double kBeyondShare =
    0.6;  ///< of a blade's thickness, that the floor is taken beyond a side's line where no blade stands
constexpr double kLeastSquare = 0.2;
constexpr double kRounder = 1.25;  ///< than a pass may turn: nothing of that is left to rounding

/// The least radius of a pass that turns no more than it may, mm. The window is one of both ends of the axis.
double least_radius(const PointOptions& options) {
  return kRounder * options.turn_window_mm / (std::numbers::sqrt2 * options.most_turn_rad);
}

}  // namespace

ChannelLines::ChannelLines(const FloorChannel& channel)
    : map(channel.floor, channel.axis),
      first(channel.first, channel.floor, map, 1.0),
      second(channel.second, channel.floor, map, -1.0) {
  if (!known()) return;
  const double middle = 0.5 * (std::max(first.from(), second.from()) + std::min(first.to(), second.to()));
  const double whole = 2.0 * std::numbers::pi;
  second.turn(-whole * std::floor((second.angle(middle) - first.angle(middle)) / whole));
}

ChannelRows::ChannelRows(const FloorChannel& channel, const ChannelLines& lines, const TipRoom& room,
                         const PointOptions& options)
    : channel_(channel), lines_(lines), room_(room), radius_mm_(least_radius(options)) {
  if (!lines.known()) return;
  place_rows();
  square_up();
  parallel_for(rows_.size(), [&](std::size_t k) { bound(rows_[k]); });
  even_out();
}

void ChannelRows::place_rows() {
  const FloorMap& map = lines_.map;
  const GentleLine one(lines_.first, lines_.second, map, radius_mm_),
      other(lines_.second, lines_.first, map, radius_mm_);
  constexpr double kFineMm = 0.1;
  double along = 0.0, next = 0.0;
  std::optional<Vec3> last;
  for (int k = 0; k * kFineMm <= map.length(); ++k) {
    ChannelRow row;
    row.way = k * kFineMm;
    row.first = one.angle(row.way), row.second = other.angle(row.way);
    row.off = std::max(one.off(row.way), other.off(row.way)) * map.radius(row.way);
    row.width = (row.second - row.first) * map.radius(row.way);
    const Vec3 middle = map.place(row.way, 0.5 * (row.first + row.second));
    if (last) along += (middle - *last).norm();
    last = middle;
    if (along < next || !(row.width > 0.0)) continue;
    row.along = along, next = along + kStepMm;
    rows_.push_back(row);
  }
}

/// By both lines and the middle: the channel is no narrower than where it winds least.
void ChannelRows::square_up() {
  for (std::size_t k = 0; k < rows_.size() && rows_.size() > 1; ++k) {
    const ChannelRow &before = rows_[k - std::min<std::size_t>(k, 1)],
                     &after = rows_[std::min(k + 1, rows_.size() - 1)];
    double most = 0.0;
    for (const double across : {0.0, 0.5, 1.0}) {
      const auto place = [&](const ChannelRow& row) {
        return lines_.map.place(row.way, row.first + across * (row.second - row.first));
      };
      const Vec3 here = place(rows_[k]), along = place(after) - place(before);
      most = std::max(most, channel_.axis.around(here).cross(along.normalized()).norm());
    }
    rows_[k].square = most;
  }
}

std::optional<TipRoom::Rest> ChannelRows::at(const ChannelRow& row, double across) const {
  return room_.rest(lines_.map.place(row.way, row.first + across * (row.second - row.first)));
}

void ChannelRows::bound(ChannelRow& row) const {
  const double beyond = (kBeyondShare * channel_.blade_mm / std::max(row.square, kLeastSquare) + row.off) / row.width;
  const auto is_free = [&](double across) {
    const std::optional<TipRoom::Rest> here = at(row, across);
    return here && room_.tip_is_free(here->center);
  };
  // Over the floor blades lean: the middle of the channel is not that of its foot.
  const auto start = std::find_if(kStarts.begin(), kStarts.end(), is_free);
  if (start == kStarts.end()) return;
  const auto outermost = [&](double to) {
    double good = *start, bad = to;
    // In steps that no blade fits between: behind it there is the next channel.
    const double step = std::copysign(kMarchMm / row.width, to - good);
    while (std::abs(to - good) > std::abs(step) && is_free(good + step)) good += step;
    if (std::abs(to - good) <= std::abs(step) && is_free(to)) return to;
    bad = std::abs(to - good) <= std::abs(step) ? to : good + step;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (bad + good);
      (is_free(middle) ? good : bad) = middle;
    }
    return good;
  };
  row.low = row.free_low = outermost(-beyond), row.high = row.free_high = outermost(1.0 + beyond);
  row.open = true;
}

/// The outermost passes would jump sideways where a blade begins: they swing out before it instead, round at first.
void ChannelRows::even_out() {
  const auto swing = [&](double along) {
    const double bent = kMostSlope * radius_mm_;
    return along < bent ? 0.5 * along * along / radius_mm_ : kMostSlope * (along - 0.5 * bent);
  };
  std::vector<double> low(rows_.size()), high(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ChannelRow& row = rows_[i];
    if (!row.open) continue;
    low[i] = row.low * row.width, high[i] = (1.0 - row.high) * row.width;
    for (const ChannelRow& other : rows_) {
      const double off = swing(std::abs(other.along - row.along));
      if (!other.open) continue;
      low[i] = std::max(low[i], other.low * other.width - off);
      high[i] = std::max(high[i], (1.0 - other.high) * other.width - off);
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i].open) continue;
    rows_[i].low = low[i] / rows_[i].width, rows_[i].high = 1.0 - high[i] / rows_[i].width;
    rows_[i].open = rows_[i].low < rows_[i].high;
  }
}

}  // namespace flank::internal
