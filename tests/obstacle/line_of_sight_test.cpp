// Half lines and triangles: hits, near misses, and what lies behind the start or nearer than asked.
#include "flank/obstacle/line_of_sight.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(LineOfSight, MeetsWhatLiesAheadAndNothingElse) {
  TriangleMesh mesh;
  mesh.vertices = {{-1, -1, 5}, {1, -1, 5}, {0, 1, 5}};
  mesh.triangles = {{0, 1, 2}};
  const TriangleTree tree = tree_of(mesh);
  EXPECT_TRUE(meets(tree, Vec3::Zero(), Vec3::UnitZ(), 0.0));
  EXPECT_FALSE(meets(tree, Vec3::Zero(), -Vec3::UnitZ(), 0.0)) << "behind";
  EXPECT_FALSE(meets(tree, {2, 0, 0}, Vec3::UnitZ(), 0.0)) << "beside";
  EXPECT_FALSE(meets(tree, Vec3::Zero(), Vec3::UnitX(), 0.0)) << "along";
  EXPECT_FALSE(meets(tree, {0, 0, 5}, Vec3::UnitZ(), 1e-6)) << "where it begins";
  EXPECT_FALSE(meets(tree, Vec3::Zero(), Vec3::UnitZ(), 6.0)) << "nearer than asked";
}

TEST(LineOfSight, NothingIsMetOfNothing) { EXPECT_FALSE(meets(tree_of({}), Vec3::Zero(), Vec3::UnitZ(), 0.0)); }

}  // namespace
}  // namespace flank::internal
