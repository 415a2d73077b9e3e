/// A wheel's path is one sector's, turned: it is searched once, by the points turned back.
#pragma once

#include <cstddef>
#include <vector>

#include "flank/path.h"

namespace flank::internal::verify {

/// A rigid motion, and its inverse.
struct Turn {
  Eigen::Isometry3d forth = Eigen::Isometry3d::Identity(), back = Eigen::Isometry3d::Identity();
};

/// The path is its first `strips` strips, moved by each of `turns`, the first of which moves nothing.
struct PathCopies {
  std::size_t strips = 0;
  std::vector<Turn> turns;
};

/// As many copies as there are. Poses are equal if tip and upper end of the axis agree as far as rounding lets them; poses that are no
/// numbers are equal to none.
[[nodiscard]] PathCopies find_copies(const Path& path, double axis_length_mm);

}  // namespace flank::internal::verify
