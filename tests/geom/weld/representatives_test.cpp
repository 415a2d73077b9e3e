#include "flank/geom/weld/representatives.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

/// By comparing each vertex with all that stay.
std::vector<int> brute(const std::vector<Vec3>& vertices, double tolerance) {
  std::vector<int> first, stay;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    int found = -1;
    for (std::size_t i = 0; i < stay.size() && found < 0; ++i)
      if ((vertices[static_cast<std::size_t>(stay[i])] - vertices[v]).squaredNorm() <= tolerance * tolerance)
        found = stay[i];
    first.push_back(found >= 0 ? found : static_cast<int>(v));
    if (found < 0) stay.push_back(static_cast<int>(v));
  }
  return first;
}

TEST(Representatives, TheFirstWithinTheToleranceIsFoundAsByBruteForce) {
  Random random(5);
  for (const double size : {3.0, 20.0, 300.0}) {
    std::vector<Vec3> vertices;
    for (int i = 0; i < 3000; ++i)
      vertices.push_back(i > 10 && i % 3 == 0 ? vertices[static_cast<std::size_t>(random.uniform(0.0, i - 1.0))]
                                              : Vec3(1e3 + random.uniform(0.0, size), -random.uniform(0.0, size),
                                                     random.uniform(0.0, i % 2 == 0 ? size : 0.0)));
    EXPECT_EQ(representatives(vertices, 1.0), brute(vertices, 1.0)) << size;
    EXPECT_EQ(representatives(vertices, 0.0), brute(vertices, 0.0)) << size;
  }
}

TEST(Representatives, ChainsOfVerticesAreNotWeldedToOne) {
  std::vector<Vec3> chain;
  for (int i = 0; i < 100; ++i) chain.emplace_back(0.0, 0.6 * i, 0.0);
  const std::vector<int> first = representatives(chain, 1.0);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(first[static_cast<std::size_t>(i)], i - i % 2);
}

TEST(Representatives, WithoutAToleranceZerosOfBothSignsAreOne) {
  EXPECT_EQ(representatives({Vec3(0, 0, 1), Vec3(-0.0, 0, 1), Vec3(1e-300, 0, 1)}, 0.0), (std::vector<int>{0, 0, 2}));
  EXPECT_TRUE(representatives({}, 1.0).empty());
}

}  // namespace
}  // namespace flank::internal
