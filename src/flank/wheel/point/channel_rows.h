/// Where a channel begins and ends on its floor: places along it, and at each how far the tip may go to either side.
#pragma once

#include <vector>

#include "flank/wheel/point/floor_map.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {

/// A place along the channel. Across it counts from 0, the first side's line, to 1.
struct ChannelRow {
  double way = 0.0;                  ///< on the floor's meridian, mm
  double first = 0.0, second = 0.0;  ///< angles of the two sides' lines
  double width = 0.0;                ///< between them round the axis, mm
  double square = 1.0;           ///< of a millimetre round the axis, what is across the channel: less where it winds
  double off = 0.0;              ///< of the sides themselves beside their lines, at most, round the axis, mm
  double along = 0.0;            ///< along the middle of the channel, mm
  double low = 0.0, high = 1.0;  ///< from pass to pass, evenly along the channel
  double free_low = 0.0,
         free_high = 1.0;  ///< between which the tip is free: beyond `low` and `high` before and behind a blade
  bool open = false;
};

/// The floor, and where the two sides of a channel stand on it: the same for every tool and at every height.
struct ChannelLines {
  explicit ChannelLines(const FloorChannel& channel);
  /// Whether both sides stand on the floor.
  [[nodiscard]] bool known() const { return !first.empty() && !second.empty() && map.length() > 0.0; }
  FloorMap map;
  SideLine first, second;  ///< the second one is the next in a right-handed turn
};

class ChannelRows {
 public:
  /// The first three must outlive it.
  ChannelRows(const FloorChannel& channel, const ChannelLines& lines, const TipRoom& room, const PointOptions& options);
  [[nodiscard]] const std::vector<ChannelRow>& rows() const { return rows_; }
  /// The tip's place at a share from `low` to `high` of a row; none beside the floor.
  [[nodiscard]] std::optional<TipRoom::Rest> rest(const ChannelRow& row, double share) const {
    return at(row, row.low + share * (row.high - row.low));
  }

 private:
  [[nodiscard]] std::optional<TipRoom::Rest> at(const ChannelRow& row, double across) const;
  void place_rows();
  void square_up();
  void bound(ChannelRow& row) const;
  void even_out();

  const FloorChannel& channel_;
  const ChannelLines& lines_;
  const TipRoom& room_;
  double radius_mm_;  ///< that a pass turns with at least
  std::vector<ChannelRow> rows_;
};

}  // namespace flank::internal
