/// Poses of the tip sphere over a channel at one height, with the axis that has room there.
#pragma once

#include <optional>

#include "flank/wheel/point/axis_field.h"
#include "flank/wheel/point/channel_rows.h"

namespace flank::internal {

class ChannelPoses {
 public:
  /// The first three must outlive it; `channel` has three rows at least. `below`: the field of the same channel at another height, whose
  /// directions are taken where they have room here, too; null: none.
  ChannelPoses(const ChannelRows& channel, const TipRoom& room, const PointOptions& options,
               const AxisField* below = nullptr);
  [[nodiscard]] const std::vector<ChannelRow>& rows() const { return channel_.rows(); }
  [[nodiscard]] const ChannelRows& channel() const { return channel_; }
  [[nodiscard]] const TipRoom& room() const { return room_; }
  [[nodiscard]] const AxisField& field() const { return field_; }
  [[nodiscard]] const PointOptions& options() const { return options_; }
  /// At a share from `low` to `high` of a row. None where there is no floor or no room, and where the tip is in the air.
  [[nodiscard]] std::optional<Pose> at(std::size_t row, double share) const;
  /// The direction of the net there; it need not have room.
  [[nodiscard]] Vec3 axis(std::size_t row, double share) const;

 private:
  [[nodiscard]] AxisField field_of(const AxisField* below) const;
  const ChannelRows& channel_;
  const TipRoom& room_;
  const PointOptions& options_;
  AxisField field_;
};

}  // namespace flank::internal
