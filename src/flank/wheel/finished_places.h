/// What the strips of earlier operations have finished already.
#pragma once

#include <vector>

#include "flank/geom/bvh.h"
#include "flank/path.h"
#include "flank/radial_function.h"

namespace flank::internal {

/// About: by poses on the way, so near to each other that little is left between them. The radial function must outlive it.
class FinishedPlaces {
 public:
  FinishedPlaces(const std::vector<Strip>& strips, const RadialFunction& radial, double within_mm);
  /// Whether the flank of some pose comes so near to a place, or beyond it.
  [[nodiscard]] bool operator()(const Vec3& x) const;

 private:
  [[nodiscard]] double distance(const Vec3& d, const Vec3& axis) const;

  const RadialFunction& radial_;
  double within_mm_, reach_mm_;
  std::vector<std::vector<Pose>> groups_;  ///< neighbours
  BoxTree tree_;                           ///< over their axes
};

}  // namespace flank::internal
