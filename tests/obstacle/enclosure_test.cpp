// How closed the space before and behind a surface is: closed forms of a cube, a plate and an open box.
#include "flank/obstacle/enclosure.h"

#include <gtest/gtest.h>

#include "flank/threads.h"

namespace flank::internal {
namespace {

/// The sides of a cube of 2 mm about the origin, normals outwards; the last `open` of its triangles left out.
TriangleMesh cube(std::size_t open = 0) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back((k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0, (k & 4) != 0 ? 1.0 : -1.0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                    {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {4, 5, 7}, {4, 7, 6}};
  mesh.triangles.resize(mesh.triangles.size() - open);
  return mesh;
}

TEST(Enclosure, ACubeIsClosedInsideAndOpenOutside) {
  const Enclosure found = enclosure(cube(), cube());
  EXPECT_EQ(found.before, 0.0);
  EXPECT_GT(found.behind, 0.99) << "a ray along an edge may slip through";
}

TEST(Enclosure, OneWithoutALidIsClosedByTheShareOfItsWalls) {
  // One opening of six: light leaves by a fifth of the five walls that are left.
  const Enclosure found = enclosure(cube(2), cube(2));
  EXPECT_EQ(found.before, 0.0);
  EXPECT_NEAR(found.behind, 0.8, 0.02);
}

TEST(Enclosure, IsTheSameForOneAndThreeThreads) {
  set_thread_count(1);
  const Enclosure one = enclosure(cube(2), cube(2));
  set_thread_count(3);
  const Enclosure three = enclosure(cube(2), cube(2));
  set_thread_count(0);
  EXPECT_EQ(one.behind, three.behind);
}

}  // namespace
}  // namespace flank::internal
