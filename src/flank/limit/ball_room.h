/// The room for balls at a target: faces that they must not cut, and solids that they cannot be in.
#pragma once

#include <vector>

#include "flank/limit/least_error.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// Holds the solids that a scene points to.
class BallRoom {
 public:
  /// For balls of the radius near a box about some of the faces `own` of one solid, or of none. `faces` must not be cut, own ones among them.
  BallRoom(const Setup& setup, std::vector<const Target*> faces, const std::vector<int>& own, const Box3& near,
           double radius_mm);
  [[nodiscard]] const BallScene& scene() const { return scene_; }

 private:
  std::vector<verify::Winding> solids_;
  BallScene scene_;
};

}  // namespace flank::internal
