// Motions that move a target along itself: found where there is one, refused where there is none or more than one.
#include "flank/seed/self_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "seed/exact_targets.h"
#include "seed/screw_sheet.h"

namespace flank::internal {
namespace {

using testing::sheet;

std::optional<SelfMotion> motion_of(const Target& target) {
  return self_motion(target.samples(std::sqrt(target.area() / 900.0)));
}

TEST(SelfMotion, OfAScrewIsItsScrew) {
  const auto found = motion_of(*testing::screw_target());
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::abs(found->turn.normalized().z()), 1.0, 1e-6);
  EXPECT_NEAR(found->centre.head<2>().norm(), 0.0, 1e-3);
  EXPECT_NEAR(found->slide.dot(found->turn) / found->turn.squaredNorm(), testing::kScrewLead / testing::kScrewTurn,
              1e-3);
  EXPECT_LT(found->sine, 1e-5);
  EXPECT_TRUE(found->is_screw_at(testing::on_screw(0.5, 0.5)));
}

TEST(SelfMotion, OfAPrismIsASlide) {
  const auto target =
      make_target({sheet([](double u, double v) { return Vec3(40.0 * u, 30.0 * u * u * (1.0 - 0.3 * u), 60.0 * v); })});
  const auto found = motion_of(*target);
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::abs(found->slide.normalized().z()), 1.0, 1e-6);
  EXPECT_LT(found->turn.norm() * target->diagonal(), 1e-2 * found->slide.norm());
  EXPECT_FALSE(found->is_screw_at(target->box().center()));
}

TEST(SelfMotion, OfASurfaceOfRevolutionIsATurn) {
  const auto found = motion_of(*make_target({sheet([](double u, double v) {
    const double radius = 20.0 + 8.0 * u + 6.0 * u * u, angle = 1.4 * v;
    return Vec3(5.0 + radius * std::cos(angle), radius * std::sin(angle), 30.0 * u);
  })}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::abs(found->turn.normalized().z()), 1.0, 1e-6);
  EXPECT_NEAR((found->centre.head<2>() - Vec2(5.0, 0.0)).norm(), 0.0, 1e-3);
  EXPECT_LT(found->slide.norm(), 1e-4 * found->turn.norm() * 25.0);
  EXPECT_FALSE(found->is_screw_at(Vec3(30.0, 0.0, 5.0)));
}

TEST(SelfMotion, NothingTellsWhichOfSeveralIsMeant) {
  EXPECT_FALSE(motion_of(*make_target({testing::rectangle(0.0, 0.0, 30.0, 20.0)})));
  EXPECT_FALSE(motion_of(*make_target(
      {sheet([](double u, double v) { return Vec3(20.0 * std::cos(u), 20.0 * std::sin(u), 30.0 * v); })})));
}

TEST(SelfMotion, ABladeHasNone) {
  const auto blade = testing::exact_target(testing::bent_motion(50.0),
                                           RadialFunction(ToolFamily::kCone, 50.0, Eigen::Vector2d(4.0, 0.1)));
  EXPECT_FALSE(motion_of(*blade.target));
  EXPECT_FALSE(self_motion({}));
}

TEST(SelfMotion, MovedPointsHaveItsVelocity) {
  const SelfMotion motion = testing::screw_motion();
  const Vec3 p(31.0, -4.0, 7.0);
  constexpr double kTime = 0.3, kStep = 1e-6;
  const Vec3 slope = (motion.moved(p, kTime + kStep) - motion.moved(p, kTime - kStep)) / (2.0 * kStep);
  EXPECT_NEAR((slope - motion.velocity(motion.moved(p, kTime))).norm(), 0.0, 1e-6);
  EXPECT_NEAR((motion.moved(motion.moved(p, kTime), -kTime) - p).norm(), 0.0, 1e-12);
  EXPECT_NEAR((motion.turned(motion.velocity(p), kTime) - motion.velocity(motion.moved(p, kTime))).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace flank::internal
