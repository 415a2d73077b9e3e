#include "flank/setup/closed_mesh.h"

#include <gtest/gtest.h>

#include <array>

namespace flank::internal {
namespace {

/// A cube of 10 mm, shifted along x, as two faces: its first two triangles and the others.
void add_cube(Part& part, double x, std::size_t triangles = 12) {
  constexpr std::array<std::array<int, 3>, 12> kSides = {{{0, 2, 1},
                                                          {0, 3, 2},
                                                          {4, 5, 6},
                                                          {4, 6, 7},
                                                          {0, 1, 5},
                                                          {0, 5, 4},
                                                          {1, 2, 6},
                                                          {1, 6, 5},
                                                          {2, 3, 7},
                                                          {2, 7, 6},
                                                          {3, 0, 4},
                                                          {3, 4, 7}}};
  const int base = static_cast<int>(part.mesh.vertices.size());
  for (const double z : {0.0, 10.0})
    for (const Vec2& p : {Vec2(0, 0), Vec2(10, 0), Vec2(10, 10), Vec2(0, 10)})
      part.mesh.vertices.emplace_back(x + p.x(), p.y(), z);
  part.mesh_faces.resize(part.mesh_faces.size() + 2);
  for (std::size_t k = 0; k < triangles; ++k) {
    auto& face = part.mesh_faces[part.mesh_faces.size() - (k < 2 ? 2 : 1)];
    face.push_back(static_cast<int>(part.mesh.triangles.size()));
    part.mesh.triangles.push_back({base + kSides[k][0], base + kSides[k][1], base + kSides[k][2]});
  }
}

TEST(ClosedMesh, ASideIsKnownWhereTheComponentOfTheTargetIsClosed) {
  Part part;
  add_cube(part, 0.0);
  add_cube(part, 50.0, 11);
  EXPECT_TRUE(bound_a_solid(part, {0})) << "another component is open";
  EXPECT_TRUE(bound_a_solid(part, {1}));
  EXPECT_FALSE(bound_a_solid(part, {2})) << "its own is, far from the target";
  EXPECT_FALSE(bound_a_solid(part, {0, 3}));
}

TEST(ClosedMesh, FacesOfAFileKnowItThemselves) {
  Part part;
  part.faces.resize(1);
  EXPECT_FALSE(bound_a_solid(part, {0}));
}

}  // namespace
}  // namespace flank::internal
