/// Poses that keep clear of the other faces of the part, by sliding along the axis where that helps.
#pragma once

#include <memory>
#include <vector>

#include "flank/obstacle/pose_clearance.h"
#include "flank/target.h"
#include "flank/tool.h"

namespace flank::internal {

/// What the tool must not enter.
struct CoverObstacles {
  std::vector<CheckSurface> surfaces;  ///< triangles: faces of the target's own solid, neighbours, fixtures
  /// Closed solids that the target touches or runs into (a hub): by their exact signed distance, so that a tool that lies
  /// wholly within one is seen as well.
  std::vector<std::shared_ptr<const Target>> solids;
  [[nodiscard]] bool empty() const { return surfaces.empty() && solids.empty(); }
};

/// How clear a pose is.
struct LineClearance {
  double clearance_mm = 1e300;  ///< negative: depth
  double slide_gain = 0.0;      ///< its derivative by a slide of the tool along its axis, towards the holder
  Vec3 point = Vec3::Zero();    ///< of the obstacle
};

/// The planner's question, pose by pose, for one tool; immutable. Everything else must outlive it.
class LineGuard {
 public:
  LineGuard() = default;  ///< every pose is clear
  LineGuard(const Tool& tool, const CoverObstacles& obstacles, double floor_mm);

  /// Whether no obstacle is nearer than the floor.
  [[nodiscard]] bool clear(const Pose& pose) const;
  /// Exact up to `horizon_mm`, beyond it some value above.
  [[nodiscard]] LineClearance measure(const Pose& pose, double horizon_mm) const;
  /// Whether a ball of the tool's smallest radius is clear.
  [[nodiscard]] bool ball_is_clear(const Vec3& center) const;
  [[nodiscard]] double ball_radius() const { return ball_radius_; }
  /// The same with another floor.
  [[nodiscard]] LineGuard with_floor(double floor_mm) const {
    LineGuard other = *this;
    other.floor_mm_ = floor_mm;
    return other;
  }
  [[nodiscard]] double floor_mm() const { return floor_mm_; }  ///< negative: depth that the tolerance allows

 private:
  enum class Ask { kWhether, kLeast };
  void measure_solid(const Target& solid, const Pose& pose, double enough_mm, Ask ask, LineClearance& result) const;

  const CoverObstacles* obstacles_ = nullptr;
  std::shared_ptr<const PoseChecker> checker_, ball_checker_;
  double ball_radius_ = 0.0;
  RadialFunction radial_;
  double steepest_ = 0.0;  ///< largest |r'|
  double floor_mm_ = 0.0;
};

/// The pose slid along its own axis, by at most `reach_mm`, until it is clear; the best found if it never is.
[[nodiscard]] Pose slid_clear(const LineGuard& guard, const Pose& pose, double reach_mm);

}  // namespace flank::internal
