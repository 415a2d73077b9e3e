/// Where balls that touch the targets come: nothing else of a part needs to be known closely.
#pragma once

#include <array>
#include <cstddef>
#include <unordered_set>
#include <vector>

#include "flank/judge.h"
#include "flank/triangle_mesh.h"
#include "flank/vec.h"

namespace flank::internal {

/// Cubes of space that hold every ball of a radius that touches a target, with all that it could enter. Immutable.
class BallPlaces {
 public:
  /// `samples`: of the faces that are judged; only targets count.
  BallPlaces(const std::vector<FaceSamples>& samples, double radius_mm);
  /// Whether a box may hold a place of them.
  [[nodiscard]] bool meet(const Box3& box) const;

 private:
  using Cube = std::array<long, 3>;
  struct Hash {
    std::size_t operator()(const Cube& c) const;
  };
  [[nodiscard]] Cube cube_of(const Vec3& p) const;
  double edge_mm_ = 1.0;
  std::unordered_set<Cube, Hash> cubes_;
};

/// The triangles of a mesh whose boxes such places meet, in their order.
[[nodiscard]] TriangleMesh near_part(const TriangleMesh& mesh, const BallPlaces& places);

}  // namespace flank::internal
