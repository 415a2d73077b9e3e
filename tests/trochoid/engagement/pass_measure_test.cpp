// What a pass engages and takes, and what a link between two passes would engage.
#include "flank/trochoid/engagement/engagement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kRadius = 3.0, kLength = 12.0, kDegree = std::numbers::pi / 180.0;
const RadialFunction kTool(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));

/// Upright, along x from -far to far, so far across.
std::vector<Pose> across(double y, double far = 8.0, int steps = 10) {
  std::vector<Pose> poses;
  for (int k = 0; k <= steps; ++k) poses.push_back({Vec3((2.0 * k / steps - 1.0) * far, y, 0.0), Vec3::UnitZ()});
  return poses;
}

SweptStock with_slot() {
  SweptStock stock(kTool, {{Vec3::UnitZ(), 8.0}});
  stock.add(Sweep::of(across(0.0, 12.0, 120), kLength));
  return stock;
}

TEST(PassMeasure, ALinkInWhatIsClearedEngagesNothing) {
  const SweptStock stock = with_slot();
  // On both sides a scallop is left between two poses of the slot.
  constexpr double kApart = 0.2, kScallop = kApart * kApart / (8.0 * kRadius);
  EXPECT_LT(largest_engagement(across(0.0), stock), 2.1 * std::acos(1.0 - kScallop / kRadius));
  std::vector<Pose> above = across(5.0);
  for (Pose& pose : above) pose.tip.z() += 8.0 + kRadius;
  EXPECT_EQ(largest_engagement(above, stock), 0.0);
}

TEST(PassMeasure, ALinkBesideWhatIsClearedEngagesAsAPassDoes) {
  const SweptStock stock = with_slot();
  for (const double beside : {0.5, 2.0, 5.0}) {
    const double expected = std::acos(1.0 - beside / kRadius), most = largest_engagement(across(beside), stock);
    EXPECT_NEAR(most, expected, 1.0 * kDegree) << beside;
  }
  EXPECT_EQ(stock.sweeps().size(), 1u) << "nothing is taken";
}

TEST(PassMeasure, OneDeepPlaceOfALinkIsSeen) {
  // It leaves the slot for a tenth of its way.
  std::vector<Pose> poses = across(0.0);
  poses[5].tip.y() = 2.5;
  EXPECT_GT(largest_engagement(poses, with_slot()), 30.0 * kDegree);
}

}  // namespace
}  // namespace flank::internal
