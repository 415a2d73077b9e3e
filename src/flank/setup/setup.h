/// A part with the faces that are machined and those that must not be entered: what every command begins with.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/judge.h"
#include "flank/part.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

struct Setup {
  Part part;                 ///< the targets' normals point to the side that is machined
  std::vector<int> targets;  ///< indices of faces
  std::vector<int> checks;   ///< of the faces that must not be entered, ascending
  double tolerance_mm = 0.01;
  std::vector<Part> fixtures;
  std::vector<int> unread = {};  ///< faces that are in the file and could not be read, but for those ignored by name
  std::vector<SheetSide> sides = {};  ///< of the targets that bound no material
  double allowance_mm = 0.0;          ///< left on the faces of the part on purpose, >= 0
  /// Of a target that stands for equal ones, such as a side of a wheel's blade: how many there are, itself among them.
  std::map<int, int> copies = {};
  [[nodiscard]] int copies_of(int target) const {
    const auto found = copies.find(target);
    return found != copies.end() ? found->second : 1;
  }
  /// Bodies that stand on the part where all is there, such as blades that a piece of a wheel lacks: what they cover is not accessible.
  /// They may be open where they stand.
  std::vector<TriangleMesh> standing = {};
};

}  // namespace flank::internal
