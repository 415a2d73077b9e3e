// Strips that go on into one another are one; others keep their own.
#include "flank/machine/links.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flank::internal {
namespace {

Pose at(double x, const Vec3& axis = Vec3::UnitZ()) { return {Vec3(x, 0.0, 0.0), axis}; }

TEST(Links, StripsThatGoOnIntoOneAnotherAreOne) {
  Path path;
  path.strips = {{1, "entry", "F1", {at(0.0), at(1.0)}},
                 {2, "front", "F1", {at(1.0), at(2.0), at(3.0)}},
                 {3, "back", "F2", {at(3.5), at(4.0)}},
                 {4, "front", "F2", {at(4.0, Vec3::UnitX()), at(5.0)}}};
  const KnownPath both = joined({path, {{1, 4}, {3, 5, 6}, {7, 8}, {}}});
  EXPECT_EQ(both.known, (std::vector<std::vector<double>>{{1, 4, 5, 6}, {7, 8}, {}}));
  EXPECT_TRUE(joined({path, {{1, 4}, {}, {7, 8}, {}}}).known[0].empty()) << "not known of all of it";
  const Path& chains = both.path;
  ASSERT_EQ(chains.strips.size(), 3U);
  EXPECT_EQ(chains.strips[0].kind, "entry");
  ASSERT_EQ(chains.strips[0].poses.size(), 4U);  // the common pose once
  EXPECT_EQ(chains.strips[0].poses[3].tip.x(), 3.0);
  EXPECT_EQ(chains.strips[1].id, 3) << "not from the same place";
  EXPECT_EQ(chains.strips[2].id, 4) << "not along the same axis";
  EXPECT_TRUE(joined({}).path.strips.empty());
}

// An arc of 60 degrees: tangent to the motion at the contact, `off` away from the surface at its end, the axis as it was.
TEST(Links, ALeadLeavesTangentToTheMotion) {
  const Pose contact{Vec3(1, 2, 3), Vec3::UnitZ()};
  const std::vector<Pose> arc = lead_out(contact, {Vec3(0, 2, 0), {Vec3::UnitX(), Vec3::Zero()}});
  ASSERT_GT(arc.size(), 6U);
  EXPECT_EQ(arc.front().tip, contact.tip);
  const Vec3 first = (arc[1].tip - arc[0].tip).normalized();
  EXPECT_GT(first.x(), std::cos(3.0 * M_PI / 180.0));
  EXPECT_NEAR(arc.back().tip.y() - contact.tip.y(), 2.0, 1e-12);
  EXPECT_NEAR(arc.back().tip.x() - contact.tip.x(), 4.0 * std::sin(M_PI / 3.0), 1e-12);
  for (std::size_t k = 1; k < arc.size(); ++k) {
    EXPECT_NEAR((arc[k].tip - Vec3(1, 6, 3)).norm(), 4.0, 1e-12);
    EXPECT_EQ(arc[k].axis, contact.axis);
  }
  EXPECT_EQ(lead_out(contact, {}).size(), 1U);
  EXPECT_EQ(lead_out(contact, {Vec3(0, 2, 0)}).back().tip, Vec3(1, 4, 3));
}

// A strip that turns the tool: the lead goes on turning it as fast, so that no rotary axis has to stop where they meet.
TEST(Links, ALeadGoesOnTurningAsTheMotionDoes) {
  const Pose contact{Vec3(1, 2, 3), Vec3(0.0, 0.6, 0.8)};
  const PoseVelocity motion{Vec3(0.9, 0.1, 0.0), Vec3(0.01, 0.02, -0.015)};
  const std::vector<Pose> arc = lead_out(contact, {Vec3(0, 0, 2), motion});
  const double way = 4.0 * std::sin(M_PI / 3.0 / 12.0), height = 4.0 * (1.0 - std::cos(M_PI / 3.0 / 12.0));
  EXPECT_NEAR((arc[1].tip - contact.tip - way * motion.tip - height * Vec3::UnitZ()).norm(), 0.0, 1e-12);
  const Vec3 turned = (arc[1].axis - contact.axis) / way,
             across = motion.axis - contact.axis.dot(motion.axis) * contact.axis;
  EXPECT_NEAR((turned - across).norm(), 0.0, 0.02 * across.norm());
  for (const Pose& pose : arc) EXPECT_NEAR(pose.axis.norm(), 1.0, 1e-12);
}

TEST(Links, StripsAreRunWhereTheWayToTheNextIsShort) {
  // Strips round a box, each a twelfth of the way, in an order that crosses it again and again.
  Path path;
  const std::vector<int> mixed = {0, 6, 3, 9, 1, 7, 4, 10, 2, 8, 5, 11};
  const auto place = [](double twelfths) {
    const double angle = M_PI / 6.0 * twelfths;
    return Pose{Vec3(10.0 * std::cos(angle), 10.0 * std::sin(angle), 0.0), Vec3::UnitZ()};
  };
  for (const int k : mixed) path.strips.push_back({k, "flank", "F1", {place(k), place(k + 0.9)}});
  Box3 box;
  box.add(Vec3(-10, -10, -10));
  box.add(Vec3(10, 10, 10));
  const std::vector<std::size_t> order = short_order(path, box);
  ASSERT_EQ(order.size(), mixed.size());
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(path.strips[order[k]].id, static_cast<int>(k));
  EXPECT_TRUE(short_order({}, box).empty());
}

}  // namespace
}  // namespace flank::internal
