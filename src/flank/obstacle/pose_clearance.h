/// The planner's question: is this pose free of these surfaces, by how much, and which way is freer? The judge has code
/// of its own (decision 0003).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "flank/obstacles.h"
#include "flank/target.h"
#include "flank/tool.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

/// The samples of a target as points. Its slack is one and a half spacings: about the farthest that a cell reaches from
/// its sample.
[[nodiscard]] ObstacleMesh obstacle_points(const Target& target, double spacing_mm, bool flank_may_touch);

/// One pose, measured.
struct PoseClearance {
  double clearance_mm =
      0.0;           ///< least distance, less slack and clearance of the mesh; negative: depth of the deepest point
  int surface = -1;  ///< index of the ObstacleMesh; -1: nothing nearer than the horizon, and all else is zero
  Vec3 point = Vec3::Zero();       ///< on that surface
  Vec3 tool_point = Vec3::Zero();  ///< of the tool, nearest to it
  /// d clearance / d tip: the tip moves and the axis keeps its direction. A unit vector: the way that frees fastest.
  Vec3 tip_gradient = Vec3::Zero();
  /// d clearance / d axis: the axis tilts about the tip; across the axis, mm a radian.
  Vec3 axis_gradient = Vec3::Zero();
};

/// Answers for one tool and one set of surfaces; immutable, for many threads at once.
class PoseChecker {
 public:
  PoseChecker(const Tool& tool, std::span<const ObstacleMesh> surfaces);
  ~PoseChecker();
  PoseChecker(PoseChecker&&) noexcept;

  /// Whether the clearance is at least `margin_mm`; faster than measuring it.
  [[nodiscard]] bool is_free(const Pose& pose, double margin_mm = 0.0) const;
  /// The clearance and its gradients, exact to 1e-6 mm (depths: to a thousandth of them besides, and the depth is that
  /// in one of the convex bodies of the tool; the flank as a polyline within kPlannedFlankErrorMm). Where two places
  /// are equally near the gradients are those of one of them.
  [[nodiscard]] PoseClearance measure(const Pose& pose, double horizon_mm = 1e300) const;

  /// The same for many poses into out[i], in parallel; the same bits for any number of threads.
  void free_batch(std::span<const Pose> poses, double margin_mm, std::span<char> out) const;
  void measure_batch(std::span<const Pose> poses, double horizon_mm, std::span<PoseClearance> out) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

inline constexpr double kPlannedFlankErrorMm = 2e-3;

}  // namespace flank::internal
