// What covers a place of a row's discs is never left out, and what is far away is: against every pose of the stock.
#include "flank/trochoid/stock/near_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "flank/trochoid/paths/half_path.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

constexpr double kLength = 30.0;

/// A tool that is thick in the middle and tapers.
RadialFunction barrel() { return {ToolFamily::kBarrel, kLength, Eigen::Vector3d(60.0, 6.0, 18.0)}; }

AxisPlace place(const Vec3& tip, const Vec3& u, const Vec3& tip_dx, const Vec3& u_dx) {
  return {tip, u.normalized(), tip_dx, u_dx - u_dx.dot(u.normalized()) * u.normalized()};
}

/// Front halves of a twisted cavity, one `step` farther on than the other, `down` below.
RuledMotion half(double step, double down) {
  const AxisPlace from = place({step, 0.3 * step, -down}, {0.05, 0.12, 1.0}, {1.0, 0.05, 0.0}, {0.001, 0.004, 0.0});
  const AxisPlace to =
      place({step + 1.0, 14.0, 1.0 - down}, {-0.06, -0.1, 1.0}, {1.0, -0.04, 0.01}, {0.0, -0.003, 0.0});
  return half_path(kLength, from, to.reversed(), {2.5, 2.0, 2.0, 0.0});
}

/// Two layers of halves.
SweptStock many_sweeps() {
  SweptStock stock(barrel(), {});
  for (const double down : {0.0, 32.0})
    for (int k = 0; k < 40; ++k) stock.add(Sweep::of(half(0.7 * k - 26.0, down), 48));
  return stock;
}

RowFrame frame_of(const RuledMotion& motion, double t) {
  RowFrame frame{motion.jet(t), {}, {}};
  frame.x = frame.axis.u.unitOrthogonal();
  frame.y = frame.axis.u.cross(frame.x);
  return frame;
}

using Poses = std::set<std::pair<int, int>>;

/// The poses of the stock that hold some of the places of a disc, seen from the axis.
Poses covering(const SweptStock& stock, const RowFrame& frame, const RowDisc& disc) {
  Poses out;
  for (std::size_t k = 0; k < stock.sweeps().size(); ++k)
    for (std::size_t p = 0; p < stock.sweeps()[k].poses.size(); ++p)
      for (int j = 0; j < 7 * 9 * 12; j += kSanitized ? 5 : 1) {
        const double z = std::lerp(disc.low, disc.high, (j % 7) / 6.0), r = disc.radius * ((j / 7) % 9) / 8.0;
        const double angle = 2.0 * std::numbers::pi * (j / 63) / 12.0;
        const Vec3 x =
            frame.axis.at(z) + (disc.x + r * std::cos(angle)) * frame.x + (disc.y + r * std::sin(angle)) * frame.y;
        if (gap_at(stock.profile(), stock.sweeps()[k].poses[p], x).gap > 0.0) continue;
        out.insert({static_cast<int>(k), static_cast<int>(p)});
        break;
      }
  return out;
}

Poses found(const std::vector<NearPose>& poses) {
  Poses out;
  for (const NearPose& pose : poses)
    if (pose.sweep != kOwnSweep) out.insert({pose.sweep, pose.pose});
  return out;
}

Poses found(const SeenPoses& poses) {
  Poses out;
  for (std::size_t k = 0; k < poses.count(); ++k)
    if (poses[k].sweep != kOwnSweep && poses[k].h0 > -1e6) out.insert({poses[k].sweep, poses[k].pose});
  return out;
}

TEST(NearPoses, LeaveNothingOutThatCovers) {
  const SweptStock stock = many_sweeps();
  NearPoses near(stock);
  for (const double down : {0.0, 20.0}) {
    const RuledMotion motion = half(2.1, down);
    near.begin(motion);
    for (const double t : {0.4, 0.05, 0.8}) {
      if (kSanitized && t != 0.4) break;
      const RowFrame frame = frame_of(motion, t);
      const RowDisc whole{0.0, 0.0, stock.profile().largest(), stock.profile().low(), stock.profile().high()};
      const std::vector<RowDisc> parts = {{4.0, 3.0, 0.8, 0.0, 30.0}, {5.0, 0.0, 0.6, 10.0, 12.0}};
      std::vector<NearPose> all, some;
      NearScratch scratch;
      near.add(frame, whole, {}, -1.0, scratch, all);
      near.add(frame, whole, parts, -1.0, scratch, some);
      SeenPoses seen;
      near.see(frame, whole, parts, -1.0, scratch, seen);
      const Poses in_seen = found(seen);
      EXPECT_LT(in_seen.size(), stock.sweeps().size() * 49 * 2 / 3) << "what is far away is not seen";
      const Poses in_all = found(all), in_some = found(some);
      const Poses needed = covering(stock, frame, whole);
      EXPECT_FALSE(needed.empty());
      for (const auto& pose : needed) EXPECT_TRUE(in_all.contains(pose)) << pose.first << " " << pose.second;
      for (const RowDisc& part : parts)
        for (const auto& pose : covering(stock, frame, part))
          EXPECT_TRUE(in_some.contains(pose) && in_seen.contains(pose)) << pose.first << " " << pose.second;
      EXPECT_TRUE(std::includes(in_all.begin(), in_all.end(), in_some.begin(), in_some.end()));
      EXPECT_LT(in_all.size(), stock.sweeps().size() * 49 / 2) << "what is far away is left out";
    }
  }
}

TEST(NearPoses, AskFewerPosesOfFewerSweepsAtAFirstLook) {
  const SweptStock stock = many_sweeps();
  NearPoses near(stock);
  const RuledMotion motion = half(2.1, 32.0);
  near.begin(motion);
  const RowFrame frame = frame_of(motion, 0.5);
  const RowDisc whole{0.0, 0.0, stock.profile().largest(), stock.profile().low(), stock.profile().high()};
  std::vector<NearPose> first;
  NearScratch scratch;
  near.add_roughly(frame, whole, 20.0, 3, scratch, first);
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(first.front().sweep, kOwnSweep) << "the newest first";
  for (const NearPose& pose : first) {
    EXPECT_EQ(pose.pose % 4, 0);
    if (pose.sweep == kOwnSweep)
      EXPECT_LE(pose.pose, 20);
    else
      EXPECT_GE(pose.sweep, 77);
  }
  const Poses asked = found(first);
  for (const auto& pose : covering(stock, frame, whole))
    EXPECT_TRUE(pose.first < 77 || pose.second % 4 != 0 || asked.contains(pose)) << pose.first << " " << pose.second;
}

}  // namespace
}  // namespace flank::internal
