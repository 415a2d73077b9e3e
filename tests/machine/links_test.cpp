// Strips that go on into one another are one; others keep their own.
#include "flank/machine/links.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

Pose at(double x, const Vec3& axis = Vec3::UnitZ()) { return {Vec3(x, 0.0, 0.0), axis}; }

TEST(Links, StripsThatGoOnIntoOneAnotherAreOne) {
  Path path;
  path.strips = {{1, "entry", "F1", {at(0.0), at(1.0)}},
                 {2, "front", "F1", {at(1.0), at(2.0), at(3.0)}},
                 {3, "back", "F2", {at(3.5), at(4.0)}},
                 {4, "front", "F2", {at(4.0, Vec3::UnitX()), at(5.0)}}};
  const Path chains = joined(path);
  ASSERT_EQ(chains.strips.size(), 3U);
  EXPECT_EQ(chains.strips[0].kind, "entry");
  ASSERT_EQ(chains.strips[0].poses.size(), 4U);  // the common pose once
  EXPECT_EQ(chains.strips[0].poses[3].tip.x(), 3.0);
  EXPECT_EQ(chains.strips[1].id, 3) << "not from the same place";
  EXPECT_EQ(chains.strips[2].id, 4) << "not along the same axis";
  EXPECT_TRUE(joined({}).strips.empty());
}

}  // namespace
}  // namespace flank::internal
