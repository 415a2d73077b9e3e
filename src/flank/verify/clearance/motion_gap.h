/// The least distance that a body keeps from triangles along a path, continuous in time.
#pragma once

#include <vector>

#include "flank/verify/clearance/obstacle_tree.h"
#include "flank/verify/clearance/revolved.h"
#include "flank/verify/swept/segment.h"

namespace flank::internal::verify {

/// Where it is least.
struct GapPlace {
  double value = 1e300;       ///< signed: negative is the depth of the deepest point of a triangle in one convex body
  int segment = -1;           ///< index into the segments; -1: nothing is nearer than the limit
  double tau = 0.0;           ///< on the segment, in [0, 1]
  int triangle = -1;          ///< number in the mesh
  Vec3 point = Vec3::Zero();  ///< of the triangle, in the part's frame
  double z = 0.0, rho = 0.0;  ///< of the nearest point of the body, mm, in its own frame
};

/// A collision's depth is refined to this share of it, if that is more than the accuracy: how deep a collision is
/// matters less than that it is one, and only the first-order bound holds inside a body.
inline constexpr double kDepthShare = 0.02;

/// How far below the value found the true minimum may lie, mm: the larger one of accuracy and kDepthShare of the depth.
[[nodiscard]] double gap_bound(double value, double accuracy_mm);

/// One body (a union of convex ones) along segments, against one tree. Immutable; its functions may be called from many
/// threads.
class MotionGap {
 public:
  /// The arguments must outlive this.
  MotionGap(const std::vector<Revolved>& body, const ObstacleTree& tree, const std::vector<Segment>& segments);

  /// The least value over all segments: found.value - gap_bound(found.value, accuracy) <= truth <= found.value. Values
  /// of `limit` and above need not be told apart. Parallel; the same bits for any number of threads.
  [[nodiscard]] GapPlace least(double accuracy_mm, double limit_mm) const;
  /// Whether the least value is at least this: true is a proof, and where it is false the value is below
  /// least_mm + 2 gap_bound(least_mm, accuracy). Ends at the first place that says no, so that a collision is told in a moment whose depth is
  /// not asked.
  [[nodiscard]] bool stays_above(double least_mm, double accuracy_mm) const;
  /// The value at one place of one segment, to the same accuracy; `limit_mm` if it is not below that.
  [[nodiscard]] double at(int segment, double tau, double accuracy_mm, double limit_mm) const;

 private:
  friend class GapSearch;

  [[nodiscard]] GapPlace search(GapPlace start, double accuracy_mm, bool any) const;

  const std::vector<Revolved>& body_;
  const ObstacleTree& tree_;
  const std::vector<Segment>& segments_;
  double lowest_ = 0.0, highest_ = 0.0, widest_ = 0.0;  ///< of the body: z and radius
};

}  // namespace flank::internal::verify
