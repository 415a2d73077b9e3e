/// Faces that are the same up to a rigid motion, as the blades of a wheel are: what machines one machines the others.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "flank/part.h"
#include "flank/path.h"

namespace flank::internal {

/// The rotation and translation (mm) that takes `from` to `to`; nothing if there is none. What their surfaces have in
/// common, most of both, must be equal within `tolerance_mm` in every knot span, up to the direction, the exchange and a
/// linear change of their parameters; the machined side must be the same, and the borders must run along one another
/// within kBorderShare. No mirror images.
[[nodiscard]] std::optional<Eigen::Isometry3d> motion_between(const Face& from, const Face& to, double tolerance_mm);

/// Of the size of a face: neighbours that are cut off a little differently leave their blades the same.
inline constexpr double kBorderShare = 0.05;

/// A face and the first of those that it is equal to: itself, if there is none before it.
struct EqualFace {
  int face = 0;           ///< index into Part::faces (or mesh_faces)
  std::size_t first = 0;  ///< index into the list of these
  Eigen::Isometry3d from_first = Eigen::Isometry3d::Identity();
};
/// Faces of a mesh are equal to none.
[[nodiscard]] std::vector<EqualFace> equal_faces(const Part& part, const std::vector<int>& faces, double tolerance_mm);

/// The strips that are about a face ("F3"), moved, and about `to` alone.
[[nodiscard]] Path carried(const Path& path, const std::string& from, const std::string& to,
                           const Eigen::Isometry3d& motion);

}  // namespace flank::internal
