// A mesh as values: its box.
#include "flank/triangle_mesh.h"

#include <gtest/gtest.h>

#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

TEST(TriangleMesh, BoxHoldsEveryVertex) {
  const TriangleMesh torus = shapes::torus(20, 8, 40, 40);
  const Box3 box = torus.box();
  EXPECT_LT((box.low - Vec3(-28, -28, -8)).norm(), 1e-12);
  EXPECT_LT((box.high - Vec3(28, 28, 8)).norm(), 1e-12);
  for (const Vec3& x : torus.vertices) EXPECT_EQ(box.squared_distance(x), 0.0);
}

TEST(TriangleMesh, BoxOfNoVerticesIsEmpty) { EXPECT_TRUE(TriangleMesh{}.box().empty()); }

TEST(TriangleMesh, BoxCountsVerticesWithoutTriangles) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(mesh.box().high, Vec3(9, 9, 9)) << "repair_mesh is what removes them";
}

}  // namespace
}  // namespace flank::internal
