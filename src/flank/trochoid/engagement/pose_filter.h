/// A quick look at all candidates of a ring, several at a time: which of them may reach into what is still open of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "flank/trochoid/engagement/near_poses.h"

namespace flank::internal {

/// In the plane of a ring, in the frame of its row, mm: an axis farther from (x, y) than `reach` does not matter.
struct ReachDisc {
  double x = 0.0, y = 0.0, reach = 0.0;
};

/// Where the candidates of one row meet the planes of its rings, in single precision. Not for several threads at once: it
/// keeps scratch memory.
class PoseFilter {
 public:
  /// The candidates of a row. The first ones may be those of the call before: only what is new is then taken over.
  void take(std::span<const NearPose> candidates, bool first_look);
  /// Indices of the candidates, in their order, that come nearer to one of the discs than its reach at the height z over the
  /// tip, mm; single precision may add some, and leaves none out. Valid until the next call.
  [[nodiscard]] const std::vector<std::size_t>& reaching(double z, std::span<const ReachDisc> discs);

 private:
  std::vector<float> x_, y_, dx_, dy_;  ///< as NearPose has them
  std::vector<float> excess_;           ///< squared distance less squared reach: the least of all discs, mm^2
  std::vector<std::size_t> reaching_;
};

}  // namespace flank::internal
