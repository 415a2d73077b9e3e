/// Where a tool has room in a channel: its tip sphere, its flank, and what comes above it.
#pragma once

#include <optional>
#include <vector>

#include "flank/radial_function.h"
#include "flank/wheel/point/channel.h"

namespace flank::internal {

/// The nearest of some targets; patch -1: none nearer than was asked.
[[nodiscard]] Footpoint nearest_foot(const std::vector<const Target*>& targets, const Vec3& p, double horizon_mm);

class TipRoom {
 public:
  TipRoom(const FloorChannel& channel, const RadialFunction& radial, const PointOptions& options);

  [[nodiscard]] double tip_mm() const { return tip_mm_; }
  /// How far the sphere's centre is from what it touches: its radius, a little of the tolerance, and the height of a layer.
  [[nodiscard]] double lift_mm() const { return lift_mm_; }
  /// How deep a pass may enter a wall; < 0: it keeps off so far.
  [[nodiscard]] double enter_mm() const { return enter_mm_; }
  /// The centre of the tip sphere that stands on the floor at the place nearest to p, and the floor's normal there.
  struct Rest {
    Vec3 center, normal;
    double k1 = 0.0;  ///< the less favourable bend of the floor, 1/mm
  };
  [[nodiscard]] std::optional<Rest> rest(const Vec3& p) const;
  /// Whether the tip sphere alone enters no wall deeper than a pass may, or `deeper_mm` more.
  [[nodiscard]] bool tip_is_free(const Vec3& center, double deeper_mm = 0.0) const;
  [[nodiscard]] const TiltCone& held() const { return held_; }
  /// How far the flank, and a shank as thick above it, are from walls and floor, mm, at least; < 0 inside one. Exact near zero. Where
  /// the rod in the axis above them enters the wheel (axis_rod.h), as far inside.
  [[nodiscard]] double room(const Pose& pose) const { return room(pose, enter_mm_); }
  /// The same by triangles, less a gap that grows along the axis, up to `kEnoughMm`: what directions are chosen by. Ends early below
  /// `least`. A direction that is not held lacks more room than any other.
  [[nodiscard]] double rough_room(const Pose& pose, double least) const;
  [[nodiscard]] bool is_free(const Pose& pose, double deeper_mm = 0.0) const {
    return held_.holds(pose.axis) && room(pose, enter_mm_ + deeper_mm) >= -enter_mm_ - deeper_mm;
  }
  static constexpr double kEnoughMm = 0.5;

 private:
  /// Ends early where it is below -enter_mm.
  [[nodiscard]] double room(const Pose& pose, double enter_mm) const;
  [[nodiscard]] double radius(double s) const { return radial_.at(s < length_ ? s : length_).r; }
  const FloorChannel& channel_;
  const RadialFunction& radial_;
  /// How far the rod in the axis above the flank is from the wheel, mm; exact where it is inside, else any number from 0 to `most`.
  [[nodiscard]] double rod_room(const Pose& pose, double most) const;
  double tip_mm_, lift_mm_, enter_mm_, length_, above_, rod_from_, rod_mm_;
  TiltCone held_;
};

}  // namespace flank::internal
