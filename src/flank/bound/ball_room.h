/// The room for balls at a target: faces that they must not cut, and solids that they cannot be in.
#pragma once

#include <vector>

#include "flank/bound/bound_setup.h"
#include "flank/limit/least_error.h"

namespace flank::internal {

/// Holds what a scene points to; the setup must live longer.
class BallRoom {
 public:
  /// For balls of the radius at the faces of one group.
  BallRoom(const BoundSetup& setup, std::size_t group, double radius_mm);
  [[nodiscard]] const BallScene& scene() const { return scene_; }

 private:
  std::vector<verify::Winding> solids_;
  BallScene scene_;
};

}  // namespace flank::internal
