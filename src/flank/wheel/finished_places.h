/// What the strips of earlier operations have finished already, and what they have left there.
#pragma once

#include <optional>
#include <vector>

#include "flank/geom/bvh.h"
#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/wheel/point/channel.h"

namespace flank::internal {

/// By poses on the way, so near to each other that little is left between them. The radial function must outlive it.
class FinishedPlaces {
 public:
  FinishedPlaces(const std::vector<Strip>& strips, const RadialFunction& radial, double within_mm);
  /// About: whether the flank of some pose comes so near to a place, or beyond it.
  [[nodiscard]] bool operator()(const Vec3& x) const;
  /// Exactly, of the motion between the poses: what it leaves at a place. None where that is more than `within_mm`.
  [[nodiscard]] std::optional<SurfaceLeft> left(const Vec3& x) const;

 private:
  struct Near {
    double off = 1e300, s = 0.0;  ///< mm: of the flank from the place, and along the axis
  };
  struct Group {
    std::size_t begin = 0, end = 0;  ///< of `poses_`
  };
  [[nodiscard]] Near near(const Vec3& d, const Vec3& axis) const;
  [[nodiscard]] Pose between(std::size_t pose, double t) const;

  const RadialFunction& radial_;
  double within_mm_, reach_mm_;
  std::vector<Pose> poses_;            ///< of all strips
  std::vector<std::size_t> strip_of_;  ///< of each
  std::vector<Group> groups_;          ///< neighbours on one strip
  BoxTree tree_;                       ///< over their axes
};

}  // namespace flank::internal
