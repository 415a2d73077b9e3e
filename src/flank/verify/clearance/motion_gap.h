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
  int segment = -1;           ///< -1: nothing nearer than the value asked for
  double tau = 0.0;           ///< on the segment
  int triangle = -1;          ///< number in the mesh
  Vec3 point = Vec3::Zero();  ///< of the triangle, in the part's frame
  double z = 0.0, rho = 0.0;  ///< of the nearest point of the body
};

/// A collision's depth is refined to this share of it, if that is more than the accuracy asked for.
inline constexpr double kDepthShare = 0.02;

/// How far below the value found the true minimum may lie.
[[nodiscard]] double gap_bound(double value, double accuracy_mm);

/// One body (a union of convex ones) along segments, against one tree.
class MotionGap {
 public:
  /// The arguments must outlive this.
  MotionGap(const std::vector<Revolved>& body, const ObstacleTree& tree, const std::vector<Segment>& segments);

  /// The least value over all segments: found.value - gap_bound(found.value, accuracy) <= truth <= found.value. Values
  /// of `limit` and above need not be told apart. Parallel; the same bits for any number of threads.
  [[nodiscard]] GapPlace least(double accuracy_mm, double limit_mm) const;
  /// The value at one place of one segment; `limit_mm` where it is not below that.
  [[nodiscard]] double at(int segment, double tau, double accuracy_mm, double limit_mm) const;

 private:
  friend class GapSearch;

  const std::vector<Revolved>& body_;
  const ObstacleTree& tree_;
  const std::vector<Segment>& segments_;
  double lowest_ = 0.0, highest_ = 0.0, widest_ = 0.0;  ///< of the body: z and radius
};

}  // namespace flank::internal::verify
