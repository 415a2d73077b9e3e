/// Poses that keep clear of the other faces of the part, by sliding along the axis if that helps.
#pragma once

#include <memory>
#include <vector>

#include "flank/obstacle/pose_clearance.h"
#include "flank/target.h"
#include "flank/tool.h"

namespace flank::internal {

/// How clear a pose is.
struct SlideClearance {
  double clearance_mm = 1e300;  ///< negative: depth
  double slide_gain = 0.0;    ///< its derivative by a slide of the tool along its axis, towards the holder, in [-1, 1]
  Vec3 point = Vec3::Zero();  ///< of the obstacle: the one that is entered most, or nearest
};

/// Answers for one tool whether a pose is clear of obstacles. Immutable, and safe to use from many threads. It keeps a
/// pointer to the obstacles, which must outlive it and its copies; the tool is copied.
class PoseGuard {
 public:
  PoseGuard() = default;  ///< every pose is clear
  /// floor_mm: least clearance that counts as clear; negative: a depth that the tolerance allows.
  PoseGuard(const Tool& tool, const Obstacles& obstacles, double floor_mm);

  /// Whether no obstacle is nearer than the floor: flank against solids and surfaces, shank and holder against
  /// surfaces. Solids are asked at points of the axis no closer than a 32nd of it, so a spike of a solid between two
  /// may be missed by up to a 64th of the axis.
  [[nodiscard]] bool clear(const Pose& pose) const;
  /// The least clearance, if it is below `horizon_mm`; else some value above that. The same accuracy as clear().
  [[nodiscard]] SlideClearance measure(const Pose& pose, double horizon_mm) const;
  /// Whether a ball of the tool's smallest radius is clear. Where it is not, no pose of the tool can touch (MATH
  /// section 9).
  [[nodiscard]] bool ball_is_clear(const Vec3& center) const;
  [[nodiscard]] double ball_radius() const { return ball_radius_; }  ///< smallest radius of the tool, mm
  /// A guard against the same obstacles with another floor; cheap.
  [[nodiscard]] PoseGuard with_floor(double floor_mm) const {
    PoseGuard other = *this;
    other.floor_mm_ = floor_mm;
    return other;
  }
  [[nodiscard]] double floor_mm() const { return floor_mm_; }  ///< negative: depth that the tolerance allows

 private:
  enum class Ask { kWhether, kLeast };
  void measure_solid(const Target& solid, const Pose& pose, double enough_mm, Ask ask, SlideClearance& result) const;

  const Obstacles* obstacles_ = nullptr;
  std::shared_ptr<const PoseChecker> checker_, ball_checker_;
  double ball_radius_ = 0.0;
  RadialFunction radial_;
  double steepest_ = 0.0;  ///< largest |r'|
  double floor_mm_ = 0.0;
};

/// The pose slid along its own axis, by at most `reach_mm` either way, until it is clear: returned as it is if it is
/// clear already. If six steps of Newton do not clear it, the last of them is returned: ask guard.clear() of the
/// result.
[[nodiscard]] Pose slid_clear(const PoseGuard& guard, const Pose& pose, double reach_mm);

}  // namespace flank::internal
