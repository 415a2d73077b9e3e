// The published adjustment stage: a front that engages too far is moved back there, and stays put at its ends.
#include "flank/trochoid/front_adjustment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "flank/trochoid/paths/half_path.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kLength = 12.0, kRadius = 4.0, kGap = 9.0;

/// Across a slot along x, from y = 0 to y = kGap.
RuledMotion front(double x) {
  const AxisPlace from{Vec3(x, 0, 0), Vec3::UnitZ(), Vec3::UnitX(), Vec3::Zero()};
  const AxisPlace to{Vec3(x, kGap, 0), Vec3::UnitZ(), -Vec3::UnitX(), Vec3::Zero()};
  return half_path(kLength, from, to, {1.4, 1.4, 1.0, 0.0});
}

SweptStock stock_after(double x) {
  SweptStock stock({ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius)}, {{-Vec3::UnitX(), 0.0}});
  for (double at = -2.0 * kRadius; at <= x; at += 0.5) stock.add(Sweep::of(front(at), 48));
  return stock;
}

double largest(const RuledMotion& motion, const SweptStock& stock) {
  EngagementMeter meter(stock);
  const std::vector<ToolRing> rings = tool_rings(stock.radial(), 21, 0);
  return meter.measure(motion, rings, 101).peak.angle_rad;
}

TEST(FrontAdjustment, MovesAFrontBackWhereItEngagesTooFar) {
  const SweptStock stock = stock_after(10.0);
  const RuledMotion far = front(11.0);
  const double limit = 0.93 * largest(far, stock);
  EngagementMeter meter(stock);
  const std::optional<RuledMotion> adjusted = adjusted_front(far, meter, stock, limit);
  ASSERT_TRUE(adjusted);
  EXPECT_LE(largest(*adjusted, stock), limit);
  for (const double t : {0.0, 1.0}) {
    EXPECT_LT((adjusted->pose(t).tip - far.pose(t).tip).norm(), 1e-12);
    const AxisJet a = adjusted->jet(t), b = far.jet(t);
    EXPECT_LT((a.velocity(0.0) - b.velocity(0.0)).norm(), 1e-9) << "tangents stay";
  }
  EXPECT_LT(adjusted->pose(0.5).tip.x(), far.pose(0.5).tip.x()) << "backwards";
}

TEST(FrontAdjustment, LeavesAFrontAloneThatKeepsTheLimit) {
  const SweptStock stock = stock_after(10.0);
  const RuledMotion near = front(10.6);
  EngagementMeter meter(stock);
  const std::optional<RuledMotion> adjusted = adjusted_front(near, meter, stock, 1.01 * largest(near, stock));
  ASSERT_TRUE(adjusted);
  EXPECT_EQ(adjusted->tip.poles, near.tip.poles);
}

TEST(FrontAdjustment, GivesUpWhereTheEndsThemselvesEngageTooFar) {
  const SweptStock stock = stock_after(10.0);
  EngagementMeter meter(stock);
  EXPECT_FALSE(adjusted_front(front(18.0), meter, stock, 5.0 * kDegree));
}

TEST(FrontAdjustment, RingsAddUpToTheRows) {
  const SweptStock stock = stock_after(10.0);
  EngagementMeter meter(stock);
  const std::vector<ToolRing> rings = tool_rings(stock.radial(), 5, 0);
  const RuledMotion motion = front(11.0);
  std::vector<double> angles(33 * rings.size());
  meter.measure_rings(motion, rings, 33, angles);
  const Engagement whole = meter.measure(motion, rings, 33);
  for (std::size_t i = 0; i < whole.rows.size(); ++i) {
    double most = 0.0;
    for (std::size_t r = 0; r < rings.size(); ++r) most = std::max(most, angles[i * rings.size() + r]);
    EXPECT_DOUBLE_EQ(most, whole.rows[i].angle_rad) << "row " << i;
  }
}

}  // namespace
}  // namespace flank::internal
