/// What the strips of earlier operations have finished already.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/radial_function.h"

namespace flank::internal {

/// About: by poses on the way, so near to each other that little is left between them. The radial function must outlive it.
class FinishedPlaces {
 public:
  FinishedPlaces(const std::vector<Strip>& strips, const RadialFunction& radial, double within_mm);
  /// Those of the poses that can say anything of a box.
  [[nodiscard]] FinishedPlaces within(const Box3& box) const;
  /// Whether the flank of some pose comes so near to a place, or beyond it.
  [[nodiscard]] bool operator()(const Vec3& x) const;

 private:
  /// Neighbouring poses, and a sphere that holds their flanks.
  struct Group {
    std::vector<Pose> poses;
    Vec3 center = Vec3::Zero();
    double radius = 0.0;
  };
  FinishedPlaces(const RadialFunction& radial, double within_mm);
  void add(std::vector<Pose> poses);
  [[nodiscard]] double distance(const Vec3& d, const Vec3& axis) const;

  const RadialFunction& radial_;
  double within_mm_, reach_mm_;
  std::vector<Group> groups_;
};

}  // namespace flank::internal
