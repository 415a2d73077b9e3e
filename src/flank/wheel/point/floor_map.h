/// The floor of a channel by two numbers: the way along its meridian and the angle about the axis.
#pragma once

#include <vector>

#include "flank/feature/wheel_axis.h"
#include "flank/target.h"

namespace flank::internal {

class FloorMap {
 public:
  /// Of a floor that is turned about the axis, and whose meridian rises along the axis or away from it all the way.
  FloorMap(const std::vector<const Target*>& floor, const WheelAxis& axis);

  [[nodiscard]] double length() const { return ways_.empty() ? 0.0 : ways_.back(); }  ///< of the meridian, mm
  /// The way at which the meridian is nearest to a place, mm.
  [[nodiscard]] double way(const Vec3& p) const;
  /// Radians about the axis, from -pi to pi.
  [[nodiscard]] double angle(const Vec3& p) const { return axis_.angle(p) - zero_; }
  /// How far a direction at a place leads the way of a right-handed turn: -1 to 1.
  [[nodiscard]] double ahead(const Vec3& p, const Vec3& direction) const { return direction.dot(axis_.around(p)); }
  [[nodiscard]] double radius(double way) const { return meridian(way).y(); }  ///< mm
  /// On the meridian's chords; the floor itself is beside it.
  [[nodiscard]] Vec3 place(double way, double angle) const;

 private:
  [[nodiscard]] Vec2 meridian(double way) const;  ///< along the axis and away from it
  WheelAxis axis_;
  Vec3 out_;  ///< unit vector across the axis, at the angle 0
  double zero_ = 0.0;
  std::vector<Vec2> points_;
  std::vector<double> ways_;
};

/// Where a side stands on the floor: its angle over the way. Beyond its ends it is not known.
class SideLine {
 public:
  /// `looks`: 1 for a side that bounds the channel which a right-handed turn comes to next, -1 for the one before. Of a face that goes all
  /// round a blade the places count that look into the channel.
  SideLine(const std::vector<const Target*>& side, const std::vector<const Target*>& floor, const FloorMap& map,
           double looks);
  [[nodiscard]] bool empty() const { return ways_.size() < 2; }
  [[nodiscard]] double from() const { return ways_.front(); }
  [[nodiscard]] double to() const { return ways_.back(); }
  /// Between its ends; beyond them that of the end.
  [[nodiscard]] double angle(double way) const;
  void turn(double radians) {
    for (double& angle : angles_) angle += radians;
  }

 private:
  std::vector<double> ways_, angles_;
};

}  // namespace flank::internal
