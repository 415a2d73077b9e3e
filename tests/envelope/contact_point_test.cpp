#include <gtest/gtest.h>

#include <cmath>

#include "flank/envelope.h"
#include "motion/sample_motions.h"

namespace flank::internal {
namespace {

using testing::random_motion;
using testing::translation;

/// A barrel of arc radius 60 mm whose largest radius lies off the middle: r' of both signs.
RadialFunction barrel(double axis_length = 40.0) {
  return RadialFunction(ToolFamily::kBarrel, axis_length, Eigen::Vector3d(60.0, 6.0, 0.4 * axis_length));
}

/// The same motion run backwards.
RuledMotion reversed_in_time(const RuledMotion& motion) {
  RuledMotion back = motion;
  for (BSplineCurve3* rail : {&back.tip, &back.direction}) {
    rail->poles = rail->poles.rowwise().reverse().eval();
    std::reverse(rail->knots.begin(), rail->knots.end());
    for (double& knot : rail->knots) knot = 1.0 - knot;
  }
  return back;
}

TEST(ContactPoint, CylinderUnderTranslationTouchesAPlane) {
  const RuledMotion motion = translation({0, 0, 0}, {60, 0, 25}, {0, 0, 1}, 40.0);
  const RadialFunction radial(ToolFamily::kCylinder, 40.0, Eigen::VectorXd::Constant(1, 5.0));
  for (const double s : {0.0, 17.0, 40.0}) {
    const ContactPoint contact = contact_point(motion, radial, s, 0.3, +1);
    EXPECT_TRUE(contact.exists);
    EXPECT_NEAR(contact.c, 0.0, 1e-12);
    EXPECT_LT((contact.normal - Vec3(0, 1, 0)).norm(), 1e-9);
    EXPECT_LT((contact.point - Vec3(18, 5, 7.5 + s)).norm(), 1e-8);
  }
}

TEST(ContactPoint, ConeUnderTranslationTouchesAPlane) {
  // The plane holds the travel and the meridian line: its normal has -sin(angle) along u.
  const double angle = 0.2;
  const RuledMotion motion = translation({0, 0, 0}, {70, 0, 0}, {0, 0, 1}, 40.0);
  const RadialFunction radial(ToolFamily::kCone, 40.0, Eigen::Vector2d(4.0, angle));
  const Vec3 normal(0, std::cos(angle), -std::sin(angle));
  for (const double s : {0.0, 17.0, 40.0}) {
    const ContactPoint contact = contact_point(motion, radial, s, 0.6, +1);
    EXPECT_LT((contact.normal - normal).norm(), 1e-9);
    EXPECT_NEAR(contact.point.dot(normal), 4.0, 1e-9);
  }
}

TEST(ContactPoint, SphereSweepsACylinderAboutItsLine) {
  AxisJet axis{{1, 2, 3}, Vec3(1, 1, 1).normalized(), {5, -2, 1}, Vec3::Zero()};
  for (const int side : {-1, 1}) {
    const ContactPoint contact = contact_point(axis, {7.0, 0.0, 0.0}, 0.0, side);
    const Vec3 offset = contact.point - axis.tip;
    EXPECT_NEAR(offset.norm(), 7.0, 1e-14);
    EXPECT_NEAR(offset.dot(axis.tip_d1), 0.0, 1e-13);
  }
}

TEST(ContactPoint, ToolTurningAboutAParallelAxisSweepsCylinders) {
  // Axis at distance 30 from the turning axis z: outer and inner envelope of radius 30 +- 4.
  const double phi = 0.7;
  const Vec3 out(std::cos(phi), std::sin(phi), 0), along(-std::sin(phi), std::cos(phi), 0);
  const AxisJet axis{30.0 * out, Vec3::UnitZ(), 30.0 * along, Vec3::Zero()};
  for (const int side : {-1, 1}) {
    const ContactPoint contact = contact_point(axis, {4.0, 0.0, 0.0}, 11.0, side);
    EXPECT_LT((contact.point - ((30.0 - 4.0 * side) * out + 11.0 * Vec3::UnitZ())).norm(), 1e-13);
  }
}

TEST(ContactPoint, SatisfiesTheEnvelopeConditions) {
  const RadialFunction radial = barrel();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RuledMotion motion = random_motion(seed);
    for (int k = 0; k < 200; ++k) {
      const double t = (k + 0.5) / 200.0, s = 40.0 * std::fmod(0.618034 * k, 1.0);
      const ContactPoint contact = contact_point(motion, radial, s, t, k % 2 == 0 ? 1 : -1);
      const AxisJet axis = motion.jet(t);
      ASSERT_TRUE(contact.exists);
      EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-14);
      EXPECT_NEAR(contact.normal.dot(axis.u), -radial.at(s).d1, 1e-14);
      EXPECT_NEAR(contact.normal.dot(axis.velocity(s)), 0.0, 1e-12 * axis.velocity(s).norm());
      EXPECT_NEAR((contact.point - axis.at(s)).norm(), radial.at(s).r, 1e-13);
    }
  }
}

TEST(ContactPoint, NormalIsNormalToTheSurfaceOfContactPoints) {
  const RadialFunction radial = barrel();
  const RuledMotion motion = random_motion(2);
  const double h = 1e-5;
  for (const double t : {0.2, 0.5, 0.83}) {
    for (const double s : {4.0, 16.0, 33.0}) {
      const auto at = [&](double ds, double dt) { return contact_point(motion, radial, s + ds, t + dt, -1).point; };
      const Vec3 normal = contact_point(motion, radial, s, t, -1).normal;
      const Vec3 by_s = (at(h, 0) - at(-h, 0)) / (2 * h), by_t = (at(0, h) - at(0, -h)) / (2 * h);
      EXPECT_NEAR(normal.dot(by_s), 0.0, 1e-8 * by_s.norm());
      EXPECT_NEAR(normal.dot(by_t), 0.0, 1e-8 * by_t.norm());
    }
  }
}

TEST(ContactPoint, ReversingTimeOnlySwapsTheSides) {
  const RadialFunction radial = barrel();
  const RuledMotion motion = random_motion(4), back = reversed_in_time(motion);
  for (const double t : {0.0, 0.21, 0.5, 0.9}) {
    const ContactPoint forth = contact_point(motion, radial, 9.0, t, +1);
    const ContactPoint other = contact_point(back, radial, 9.0, 1.0 - t, -1);
    EXPECT_LT((forth.point - other.point).norm(), 1e-11);
    EXPECT_NEAR(forth.c, -other.c, 1e-12);
  }
}

TEST(ContactPoint, ReversingBothRailsAndTheToolLeavesTheEnvelope) {
  const double length = 40.0;
  const RadialFunction radial = barrel(length);
  const RuledMotion motion = random_motion(5);
  for (const double t : {0.1, 0.45, 0.8}) {
    const AxisJet axis = motion.jet(t);
    const AxisJet turned{axis.at(length), -axis.u, axis.velocity(length), -axis.u_d1};
    for (const double s : {2.0, 20.0, 37.0}) {
      const RadialJet jet = radial.at(s);
      const Vec3 before = contact_point(axis, jet, s, +1).point;
      // Turning the axis alone swaps the sides; turning time as well swaps them back.
      EXPECT_LT((contact_point(turned, {jet.r, -jet.d1, jet.d2}, length - s, -1).point - before).norm(), 1e-12);
      const AxisJet back{turned.tip, turned.u, -turned.tip_d1, -turned.u_d1};
      EXPECT_LT((contact_point(back, {jet.r, -jet.d1, jet.d2}, length - s, +1).point - before).norm(), 1e-12);
    }
  }
}

TEST(ContactPoint, EndsWhereThePlungeIsSteeperThanTheTool) {
  // Travel at the angle beta to the axis: c = tan(angle) / tan(beta).
  const double angle = 0.3;
  for (const double beta : {0.29, 0.31, 1.2}) {
    const AxisJet axis{Vec3::Zero(), Vec3::UnitZ(), {std::sin(beta), 0, std::cos(beta)}, Vec3::Zero()};
    const ContactPoint contact = contact_point(axis, {5.0, std::sin(angle), 0.0}, 3.0, 1);
    EXPECT_NEAR(contact.c, std::tan(angle) / std::tan(beta), 1e-13);
    EXPECT_EQ(contact.exists, beta > angle);
    EXPECT_TRUE(contact.point.allFinite());
  }
}

TEST(ContactPoint, DoesNotExistAtRest) {
  const AxisJet axis{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), Vec3::Zero()};
  EXPECT_FALSE(contact_point(axis, {5.0, 0.0, 0.0}, 3.0, 1).exists);
  EXPECT_TRUE(contact_point(axis, {5.0, 0.0, 0.0}, 3.0, 1).point.allFinite());
}

TEST(ContactSide, LooksTheWayItIsAsked) {
  const RuledMotion motion = random_motion(1);
  const RadialFunction radial = barrel();
  for (const Vec3& towards : {Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    const int side = contact_side(motion, radial, towards);
    EXPECT_GT(contact_point(motion, radial, 20.0, 0.5, side).normal.dot(towards), 0.0);
  }
}

}  // namespace
}  // namespace flank::internal
