/// Where the flank of a path is at all: which faces it may meet.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/vec.h"

namespace flank::internal {

class SweptBoxes {
 public:
  /// Boxes that hold the flank on a few poses of a strip each, and on its way between them.
  SweptBoxes(const Path& path, const RadialFunction& radial);
  [[nodiscard]] bool meet(const Box3& box) const;

 private:
  std::vector<Box3> boxes_;
};

}  // namespace flank::internal
