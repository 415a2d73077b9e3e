/// A layer of a channel as a net of poses, on which cycles are laid.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "flank/wheel/point/channel_poses.h"

namespace flank::internal {

/// On the straight way from one pose to another, at a share of it.
[[nodiscard]] Pose pose_between(const Pose& a, const Pose& b, double t);

/// A stretch of a channel at one height, by two numbers: the way along its middle from 0 to `length`, mm, and the share across it from 0 to 1, between the
/// outermost places that have room. Places of the same way lie square across the channel. Where it is open to the air it goes on straight
/// beyond its end. Immutable.
class ChannelLayer {
 public:
  /// Poses from the first side to the second, evenly; a row of the channel, which goes round the wheel and lies aslant where it winds.
  using Row = std::vector<Pose>;
  /// `rows`: seven at least, of the same number of poses. `over_mm`: so far it goes on where it is open. Several, where an end of the lines
  /// square across jumps.
  [[nodiscard]] static std::vector<ChannelLayer> stretches(const std::vector<Row>& rows, bool open_before,
                                                           bool open_behind, double over_mm);
  [[nodiscard]] double length() const { return lines_.empty() ? 0.0 : lines_.back().along; }
  [[nodiscard]] bool open_before() const { return open_before_; }
  [[nodiscard]] bool open_behind() const { return open_behind_; }
  /// Between the outermost places, mm.
  [[nodiscard]] double width(double along) const;
  [[nodiscard]] Pose at(double along, double share) const;
  /// Whether a tool that turns right, seen from above, climb mills what lies ahead while it goes from the first side to the second.
  [[nodiscard]] bool climbs_from_first() const;
  /// Square across, one after the other.
  [[nodiscard]] std::vector<Row> lines() const;

 private:
  struct Line {
    double along = 0.0, width = 0.0;
    Row poses;
  };
  /// The line before a way, and how far it is to the next one: 0 to 1.
  [[nodiscard]] std::pair<std::size_t, double> place(double along) const;
  bool open_before_ = false, open_behind_ = false;
  std::vector<Line> lines_;  ///< evenly along the middle
};

/// The stretches of a channel without a row on which no place has room. `poses` is asked at once and not kept.
[[nodiscard]] std::vector<ChannelLayer> layers_of(const ChannelPoses& poses, double over_mm);

}  // namespace flank::internal
