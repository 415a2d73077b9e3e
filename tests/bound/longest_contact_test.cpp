#include "flank/bound/contact/longest_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "analytic_targets.h"
#include "flank/base/random.h"

namespace flank::internal {
namespace {

RadialFunction cylinder(double radius, double length) {
  return {ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius)};
}

RadialFunction barrel(double arc, double radius, double length) {
  return {ToolFamily::kBarrel, length, Eigen::Vector3d(arc, radius, 0.4 * length)};
}

/// A cylinder of radius r on a sphere of radius R: the distance from the axis may go from r - e in the middle to r + e at both ends,
/// and half of the contact is sqrt((R + r + e)^2 - (R + r - e)^2).
double on_sphere(double distance, double tolerance) { return 4.0 * std::sqrt(tolerance * distance); }

TEST(LongestContact, OfACylinderOnASphereIsThatOfTheFormula) {
  for (const double e : {0.002, 0.01, 0.05}) {
    const SphereTarget sphere(50.0, +1);
    const RadialFunction tool = cylinder(5.0, 60.0);
    const ContactQuestion question(sphere, tool, e);
    const LongestContact contact = longest_contact(question, ContactSite(question, Vec3(30, 40, 0)), {});
    EXPECT_GE(contact.bound_mm, on_sphere(55.0, e)) << e;
    EXPECT_LE(contact.bound_mm, 1.05 * on_sphere(55.0, e)) << e;
    EXPECT_LE(contact.found_mm, on_sphere(55.0, e) * 1.005) << e;
  }
}

TEST(LongestContact, OfACylinderInASphereIsThatOfTheFormula) {
  const SphereTarget sphere(50.0, -1);
  const RadialFunction tool = cylinder(5.0, 60.0);
  const ContactQuestion question(sphere, tool, 0.01);
  const LongestContact contact = longest_contact(question, ContactSite(question, Vec3(0, 0, 50)), {});
  EXPECT_GE(contact.bound_mm, on_sphere(45.0, 0.01));
  EXPECT_LE(contact.bound_mm, 1.05 * on_sphere(45.0, 0.01));
}

TEST(LongestContact, OnATorusRunsAlongTheLeastCurvedCircle) {
  const TorusTarget torus(40.0, 10.0);
  const RadialFunction tool = cylinder(5.0, 60.0);
  const ContactQuestion question(torus, tool, 0.01);
  // In the plane of the largest circle the torus is a circle of radius 50.
  const LongestContact contact = longest_contact(question, ContactSite(question, Vec3(50, 0, 0)), {});
  EXPECT_GE(contact.bound_mm, on_sphere(55.0, 0.01));
  EXPECT_LE(contact.bound_mm, 1.06 * on_sphere(55.0, 0.01));
  EXPECT_GT(std::abs(contact.pose.axis.y()), 0.99);
}

TEST(LongestContact, OnASaddleIsBetweenWhatAPoseReachesAndATenthMore) {
  const TorusTarget torus(40.0, 10.0);
  const RadialFunction tool = cylinder(5.0, 60.0);
  const ContactQuestion question(torus, tool, 0.01);
  const ContactSite site(question, Vec3(30, 0, 0));
  const LongestContact contact = longest_contact(question, site, {});
  // Many times what any direction but the two without curvature allows.
  EXPECT_GT(contact.found_mm, 15.0);
  EXPECT_LE(contact.bound_mm, 1.1 * contact.found_mm);
  EXPECT_GE(contact.bound_mm, contact.found_mm);
}

TEST(LongestContact, IsNoLongerThanTheTool) {
  const SphereTarget sphere(50.0, +1);
  const RadialFunction tool = cylinder(5.0, 2.0);
  const ContactQuestion question(sphere, tool, 0.01);
  const LongestContact contact = longest_contact(question, ContactSite(question, Vec3(50, 0, 0)), {});
  EXPECT_DOUBLE_EQ(contact.bound_mm, 2.0);
  EXPECT_NEAR(contact.found_mm, 2.0, 1e-9);
}

TEST(LongestContact, OfAToolThatIsTooThickForTheHollowIsNone) {
  const SphereTarget sphere(4.0, -1);
  const RadialFunction tool = cylinder(5.0, 20.0);
  const ContactQuestion question(sphere, tool, 0.01);
  const LongestContact contact = longest_contact(question, ContactSite(question, Vec3(4, 0, 0)), {});
  EXPECT_EQ(contact.bound_mm, 0.0);
  EXPECT_EQ(contact.found_mm, 0.0);
}

/// Poses near the best one and poses at random, each measured by itself: none may touch over more than the bound.
void expect_no_pose_exceeds(const Target& target, const RadialFunction& tool, const Vec3& near, std::uint64_t seed) {
  const ContactQuestion question(target, tool, 0.02);
  const ContactSite site(question, near);
  const LongestContact contact = longest_contact(question, site, {.gap = 0.05, .boxes = 400});
  ASSERT_GT(contact.found_mm, 0.0);
  Random random(seed);
  double best = 0.0;
  for (int k = 0; k < 1500; ++k) {
    // All of the tool's poses whose ball at the station touches the site: the ball, then the axis about its centre.
    const double station = random.uniform(0.0, question.length_mm);
    const Vec3 centre = site.point + (tool.at(station).r + random.uniform(-0.02, 0.02)) * site.normal;
    Vec3 axis = contact.pose.axis;
    const double spread = std::pow(10.0, random.uniform(-4.0, 0.0));
    axis += spread * Vec3(random.normal(), random.normal(), random.normal());
    axis.normalize();
    best = std::max(best, contact_of(question, {centre - station * axis, axis}, station, 0.1));
  }
  EXPECT_GT(best, 0.2 * contact.found_mm);  // else nothing was tried
  EXPECT_LE(best, contact.bound_mm);
}

TEST(LongestContact, IsReachedByNoPoseAtAll) {
  const TorusTarget torus(40.0, 10.0);
  const SphereTarget hollow(60.0, -1);
  const Vec3 inner(30, 0, 0), slanted(40.0 - 8.0, 0, 6.0);
  std::uint64_t seed = 1;
  for (const RadialFunction& tool : {cylinder(4.0, 30.0), barrel(70.0, 5.0, 20.0), barrel(200.0, 3.0, 30.0)}) {
    expect_no_pose_exceeds(torus, tool, inner, seed++);
    expect_no_pose_exceeds(torus, tool, slanted, seed++);
    expect_no_pose_exceeds(hollow, tool, Vec3(0, 60, 0), seed++);
  }
}

/// A barrel whose meridian has the radius of the hollow touches it along all of its length.
TEST(LongestContact, OfABarrelThatFitsTheHollowIsTheWholeTool) {
  const SphereTarget hollow(60.0, -1);
  const RadialFunction tool = barrel(60.0, 5.0, 20.0);
  const ContactQuestion question(hollow, tool, 0.01);
  const LongestContact contact = longest_contact(question, ContactSite(question, Vec3(0, 60, 0)), {});
  EXPECT_DOUBLE_EQ(contact.bound_mm, 20.0);
  EXPECT_GT(contact.found_mm, 19.0);
}

TEST(LongestContact, GrowsWithTheTolerance) {
  const TorusTarget torus(40.0, 10.0);
  const RadialFunction tool = barrel(100.0, 4.0, 30.0);
  double before = 0.0;
  for (const double e : {0.002, 0.008, 0.032}) {
    const ContactQuestion question(torus, tool, e);
    const LongestContact contact = longest_contact(question, ContactSite(question, Vec3(0, 30, 0)), {});
    EXPECT_GT(contact.bound_mm, before);
    before = contact.found_mm;
  }
}

}  // namespace
}  // namespace flank::internal
