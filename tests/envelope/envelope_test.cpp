#include "flank/envelope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "flank/threads.h"
#include "motion/sample_motions.h"

namespace flank::internal {
namespace {

using testing::random_motion;
using testing::translation;

const RadialFunction& cone() {
  static const RadialFunction radial(ToolFamily::kCone, 40.0, Eigen::Vector2d(4.0, 0.15));
  return radial;
}

TEST(Characteristic, IsOneRowOfTheEnvelope) {
  const RuledMotion motion = random_motion(8);
  const std::vector<ContactPoint> grid = sample_envelope(motion, cone(), +1, 11, 7);
  const std::vector<ContactPoint> row = characteristic(motion, cone(), 0.4, +1, 7);
  ASSERT_EQ(grid.size(), 77u);
  ASSERT_EQ(row.size(), 7u);
  for (std::size_t j = 0; j < row.size(); ++j) {
    EXPECT_LT((row[j].point - grid[4 * 7 + j].point).norm(), 1e-12);
    const double s = 40.0 * static_cast<double>(j) / 6.0;
    EXPECT_LT((row[j].point - contact_point(motion, cone(), s, 0.4, +1).point).norm(), 1e-12);
  }
}

TEST(Regularity, IsWellBelowOneForASidewaysSweep) {
  const Regularity found = regularity(random_motion(1), cone(), 50, 20);
  EXPECT_EQ(found.failures, 0);
  EXPECT_LT(found.largest_c, 0.5);
  EXPECT_GT(found.largest_c, 0.0);
  EXPECT_NEAR(std::abs(contact_point(random_motion(1), cone(), found.s, found.t, 1).c), found.largest_c, 1e-12);
}

TEST(Regularity, ReportsAPlungingMotion) {
  const RuledMotion steep = translation({0, 0, 0}, {5, 0, -60}, {0, 0, 1}, 40.0);
  const Regularity found = regularity(steep, cone(), 10, 8);
  EXPECT_EQ(found.failures, 80);
  EXPECT_NEAR(found.largest_c, std::tan(0.15) * 60.0 / 5.0, 1e-6);
}

TEST(Regularity, ReportsThePartThatPlunges) {
  // The path turns from sideways to along the axis: the first half is regular, the end is not.
  RuledMotion motion = translation({0, 0, 0}, {60, 0, 0}, {0, 0, 1}, 40.0);
  for (int i = 0; i < 6; ++i)
    motion.tip.poles.col(i) = Vec3(40.0 * std::sin(0.34 * i), 0.0, -40.0 * (1.0 - std::cos(0.34 * i)));
  const Regularity found = regularity(motion, cone(), 101, 5);
  EXPECT_GT(found.failures, 0);
  EXPECT_LT(found.failures, 200);
  EXPECT_GT(found.t, 0.9);
}

TEST(Regularity, ReportsAMotionAtRest) {
  const RuledMotion still = translation({0, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
  const RadialFunction cylinder(ToolFamily::kCylinder, 40.0, Eigen::VectorXd::Constant(1, 5.0));
  const Regularity found = regularity(still, cylinder, 5, 4);
  EXPECT_GE(found.largest_c, 1.0);
}

TEST(EnvelopeDeviation, MeasuresAgainstAPlane) {
  // A cylinder along x touches the plane y = 5; measured from y = 5.25 + 0.01 z the contact lies -0.25 - 0.01 s away.
  const RuledMotion motion = translation({0, 0, 0}, {60, 0, 0}, {0, 0, 1}, 40.0);
  const RadialFunction cylinder(ToolFamily::kCylinder, 40.0, Eigen::VectorXd::Constant(1, 5.0));
  const EnvelopeDeviation found = envelope_deviation(motion, cylinder, +1, 31, 21, [](const Vec3& p) {
    return p.x() > 59.0 ? std::numeric_limits<double>::quiet_NaN() : p.y() - 5.25 - 0.01 * p.z();
  });
  EXPECT_EQ(found.counted, 30 * 21);
  EXPECT_EQ(found.not_counted, 21);
  EXPECT_EQ(found.missing, 0);
  EXPECT_NEAR(found.largest_mm, -0.25, 1e-8);
  EXPECT_NEAR(found.smallest_mm, -0.65, 1e-8);
  EXPECT_EQ(found.smallest_s, 40.0);
  EXPECT_EQ(found.largest_s, 0.0);
  EXPECT_NEAR(found.largest_magnitude_mm(), 0.65, 1e-8);
  double sum = 0.0;
  for (int j = 0; j <= 20; ++j) sum += std::pow(0.25 + 0.02 * j, 2);
  EXPECT_NEAR(found.rms_mm, std::sqrt(sum / 21), 1e-8);
}

TEST(EnvelopeDeviation, CountsPointsWithoutContact) {
  const RuledMotion steep = translation({0, 0, 0}, {5, 0, -60}, {0, 0, 1}, 40.0);
  const EnvelopeDeviation found = envelope_deviation(steep, cone(), 1, 6, 5, [](const Vec3&) { return 0.0; });
  EXPECT_EQ(found.missing, 30);
  EXPECT_EQ(found.counted, 0);
}

TEST(EnvelopeDeviation, DoesNotDependOnTheThreads) {
  const auto measure = [](int threads) {
    set_thread_count(threads);
    return envelope_deviation(random_motion(3), cone(), 1, 60, 40, [](const Vec3& p) { return std::sin(p.sum()); });
  };
  const EnvelopeDeviation one = measure(1), two = measure(2);
  set_thread_count(0);
  EXPECT_EQ(one.largest_mm, two.largest_mm);
  EXPECT_EQ(one.rms_mm, two.rms_mm);
  EXPECT_EQ(one.smallest_t, two.smallest_t);
}

}  // namespace
}  // namespace flank::internal
