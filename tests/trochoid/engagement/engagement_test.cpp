// Engagement and removed volume: against closed forms, and against a dense search that shares nothing with the intervals.
#include "flank/trochoid/engagement/engagement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/base/random.h"
#include "flank/trochoid/paths/half_path.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180.0;

/// The tip on a circle about the origin from one angle to another, the axis upright.
RuledMotion on_circle(double axis_length, double radius, double from, double to) {
  constexpr int kPoses = 241;
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k < kPoses; ++k) {
    t.push_back(k / (kPoses - 1.0));
    const double angle = std::lerp(from, to, t.back());
    poses.push_back({Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0), Vec3::UnitZ()});
  }
  return fit_motion(poses, t, axis_length, 60);
}

RadialFunction cylinder(double radius, double length) {
  return {ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius)};
}

/// A tool that is thick in the middle and tapers.
RadialFunction barrel() { return {ToolFamily::kBarrel, 30.0, Eigen::Vector3d(60.0, 6.0, 18.0)}; }

AxisPlace place(const Vec3& tip, const Vec3& u, const Vec3& tip_dx, const Vec3& u_dx) {
  return {tip, u.normalized(), tip_dx, u_dx - u_dx.dot(u.normalized()) * u.normalized()};
}

/// Front halves of a twisted cavity, one `step` farther on than the other.
RuledMotion twisted_half(double step) {
  const AxisPlace from = place({step, 0.3 * step, 0.0}, {0.05, 0.12, 1.0}, {1.0, 0.05, 0.0}, {0.001, 0.004, 0.0});
  const AxisPlace to = place({step + 1.0, 14.0, 1.0}, {-0.06, -0.1, 1.0}, {1.0, -0.04, 0.01}, {0.0, -0.003, 0.0});
  return half_path(30.0, from, to.reversed(), {2.5, 2.0, 2.0, 0.0});
}

/// Straight along x, from one tip to another.
RuledMotion straight(const Vec3& tip, const Vec3& axis, double way, double length) {
  constexpr int kPoses = 13;
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k < kPoses; ++k) {
    t.push_back(k / (kPoses - 1.0));
    poses.push_back({tip + t.back() * way * Vec3::UnitX(), axis});
  }
  return fit_motion(poses, t, length, 4);
}

/// Engagement of a ring by scanning its front and halving where the answer changes: no intervals, no hints.
double scanned(const SweptStock& stock, const RuledMotion& motion, double t, const ToolRing& ring) {
  constexpr int kAngles = 720, kHalvings = 16;
  const AxisJet axis = motion.jet(t);
  const Vec3 v = axis.velocity(ring.s), across = v - v.dot(axis.u) * axis.u;
  const Vec3 e1 = across.normalized(), e2 = axis.u.cross(e1);
  const auto engaged = [&](double angle) {
    const Vec3 out = std::cos(angle) * e1 + std::sin(angle) * e2;
    return (ring.sine * axis.u + ring.cosine * out).dot(v) > 0.0 &&
           stock.is_material(axis.at(ring.z) + ring.radius * out);
  };
  double sum = 0.0, from = 0.0;
  bool before = engaged(-kPi);
  for (int k = 1; k <= kAngles; ++k) {
    double low = -kPi + 2.0 * kPi * (k - 1.0) / kAngles, high = -kPi + 2.0 * kPi * k / kAngles;
    const bool in = engaged(high);
    if (in == before) continue;
    for (int n = 0; n < kHalvings; ++n) (engaged(0.5 * (low + high)) == in ? high : low) = 0.5 * (low + high);
    if (in)
      from = high;
    else
      sum += high - from;
    before = in;
  }
  return sum;
}

TEST(Engagement, OfACylinderOnAnArcIsTheClosedForm) {
  const double radius = 5.0, length = 20.0;
  for (const double way : {4.0, 12.0, 60.0}) {
    for (const double step : {0.3, 1.0, 1.8}) {
      SweptStock stock(cylinder(radius, length), {});
      stock.add(Sweep::of(on_circle(length, way, -1.5, 1.5), 228));
      EngagementMeter meter(stock);
      const double outer = way + step, edge = way + radius;
      const double cosine = (edge * edge - outer * outer - radius * radius) / (2.0 * outer * radius);
      const double angle = meter.angle(on_circle(length, outer, -0.5, 0.5), 0.5, ring_at(stock.radial(), 8.0));
      EXPECT_NEAR(angle / kDegree, std::acos(cosine) / kDegree, 1e-3) << way << " " << step;
    }
  }
}

TEST(Engagement, VolumeOfAnArcIsThatOfTheRing) {
  const double radius = 5.0, length = 20.0, way = 12.0, step = 1.0, half = 0.5;
  SweptStock stock(cylinder(radius, length), {});
  stock.add(Sweep::of(on_circle(length, way, -1.5, 1.5), 228));
  EngagementMeter meter(stock);
  const Engagement e = meter.measure(on_circle(length, way + step, -half, half), tool_rings(stock.radial(), 5, 0), 33);
  const double outer = way + step + radius, inner = way + radius;
  EXPECT_NEAR(e.volume_mm3 / (length * half * (outer * outer - inner * inner)), 1.0, 1e-5);
}

TEST(Engagement, WhatGoesOnWhereAnotherHasEndedCutsFromItsVeryStart) {
  // All of the first pose is swept, and right after it half of the ring is engaged.
  constexpr double kRadius = 5.0, kAxis = 20.0, kWay = 10.0;
  const RuledMotion first = straight(Vec3(-kWay, 0.0, 0.0), Vec3::UnitZ(), kWay, kAxis);
  SweptStock stock(cylinder(kRadius, kAxis), {});
  stock.add(Sweep::of(first, 48));
  EngagementMeter meter(stock);
  const RuledMotion next = straight(Vec3::Zero(), Vec3::UnitZ(), kWay, kAxis);
  const Engagement e = meter.measure(next, tool_rings(stock.radial(), 5, 0), 33);
  EXPECT_NEAR(e.volume_mm3 / (2.0 * kRadius * kWay * kAxis), 1.0, 1e-3);
  EXPECT_NEAR(e.rows.front().angle_rad / kDegree, 180.0, 0.1);
}

TEST(Engagement, FewRowsSeeWhatRisesAndFallsJustBeforeTheEnd) {
  // A plate right before the tool's last place, which it breaks through in the last hundredth of its way.
  constexpr double kRadius = 5.0, kAxis = 20.0, kWay = 10.0, kPlate = 0.34, kThrough = 0.06;
  const double back = kWay + kRadius - kThrough;
  SweptStock stock(cylinder(kRadius, kAxis), {{Vec3::UnitX(), back}, {-Vec3::UnitX(), kPlate - back}});
  EngagementMeter meter(stock);
  const RuledMotion motion = straight(Vec3::Zero(), Vec3::UnitZ(), kWay, kAxis);
  const Engagement e = meter.measure(motion, tool_rings(stock.radial(), 5, 0), 34);
  const auto within = [](double depth) { return 2.0 * std::acos((kRadius - depth) / kRadius) / kDegree; };
  EXPECT_NEAR(e.peak.angle_rad / kDegree, within(kPlate), 0.5);
  EXPECT_NEAR(e.rows.back().angle_rad / kDegree, within(kPlate + kThrough) - within(kThrough), 0.01);
}

TEST(Engagement, VolumeUnderATopThatLiesBetweenTwoRings) {
  // The top of the blank is at one height of the tool all along the way: its flank's end, or a little off it, or across a round end.
  constexpr double kRadius = 5.0, kAxis = 20.0, kWay = 10.0;
  const RuledMotion motion = straight(Vec3::Zero(), Vec3::UnitZ(), kWay, kAxis);
  const RowRings rings(cylinder(kRadius, kAxis), 7, 9);
  for (const double top : {kAxis - 7.3, kAxis - 0.4, kAxis - 0.05, kAxis, kAxis + 0.05, kAxis + 0.4, kAxis + 2.0}) {
    // Below the tip nothing is there; a slice at z of the round end is as wide as its chord.
    SweptStock stock(cylinder(kRadius, kAxis), {{Vec3::UnitZ(), top}, {-Vec3::UnitZ(), 0.0}});
    EngagementMeter meter(stock);
    const double over = std::max(0.0, top - kAxis);
    const double area = 2.0 * kRadius * std::min(top, kAxis) + over * std::sqrt(kRadius * kRadius - over * over) +
                        kRadius * kRadius * std::asin(over / kRadius);
    EXPECT_NEAR(meter.measure(motion, rings, 101).volume_mm3 / (area * kWay), 1.0, 2e-3) << top;
  }
}

TEST(Engagement, AgreesWithADenseScan) {
  SweptStock stock(barrel(), {{-Vec3::UnitX(), 6.0}, {Vec3(0.1, 0.0, 1.0).normalized(), 29.0}});
  stock.add(Sweep::of(twisted_half(-1.4), 48));
  stock.add(Sweep::of(twisted_half(0.0), 48));
  EngagementMeter meter(stock);
  const RuledMotion next = twisted_half(1.1);
  for (const double t : {0.1, 0.35, 0.6, 0.85}) {
    for (const double s : {0.0, 11.0, 30.0}) {
      const ToolRing ring = ring_at(stock.radial(), s);
      EXPECT_NEAR(meter.angle(next, t, ring) / kDegree, scanned(stock, next, t, ring) / kDegree, 0.01) << t << " " << s;
    }
  }
}

TEST(Engagement, WhatALeaningToolLeavesBesideItsRoundEndIsMaterial) {
  // Strokes of the layer above, whose axes lean against this one's: as circles in the plane of a ring they would cover much
  // that their round ends never reach.
  constexpr double kRadius = 6.0, kLength = 22.0;
  Random random(5);
  const RuledMotion next = straight(Vec3(0, 0, 0), Vec3::UnitZ(), 10.0, kLength);
  const int scenes = kSanitized ? 15 : 100;
  int partly = 0, scallops = 0;
  for (int k = 0; k < scenes; ++k) {
    SweptStock stock(cylinder(kRadius, kLength), {});
    const double lean = (k % 2 == 0 ? random.uniform(0.0, 4.0) : random.uniform(4.0, 40.0)) * kDegree;
    const double about = random.uniform(-kPi, kPi), across = random.uniform(-14.0, 14.0),
                 up = random.uniform(0.0, 24.0);
    const Vec3 axis(std::sin(lean) * std::cos(about), std::sin(lean) * std::sin(about), std::cos(lean));
    stock.add(Sweep::of(straight(Vec3(-20, across, up), axis, 50.0, kLength), 48));
    EngagementMeter meter(stock);
    for (const double s : {2.0, 8.0, 14.0, 20.0}) {
      const ToolRing ring = ring_at(stock.radial(), s);
      const double angle = meter.angle(next, 0.5, ring) / kDegree, truth = scanned(stock, next, 0.5, ring) / kDegree;
      // A few degrees beside a pose are taken for a scallop between sampled poses.
      const bool scallop = angle < truth - 0.05 && truth - angle < 5.0;
      EXPECT_TRUE(scallop || std::abs(angle - truth) < 0.05) << k << " " << s << ": " << angle << ", scanned " << truth;
      scallops += scallop ? 1 : 0;
      partly += truth > 5.0 && truth < 175.0 ? 1 : 0;
    }
  }
  EXPECT_GE(partly, scenes / 4);
  EXPECT_LE(scallops, 4 * scenes / 100);
}

TEST(Engagement, BesideThePoleOfAToolThatHardlyLeansLittleIsCovered) {
  // Strokes of the layer above pass over a ring by so little that their round ends just touch it. As circles in its plane they
  // would cover stretches that they leave, and the ends of what is left beside these would be found twice.
  constexpr double kRadius = 4.5, kLength = 30.0, kRing = 12.0;
  Random random(11);
  const RuledMotion next = straight(Vec3(0, 0, 0), Vec3::UnitZ(), 10.0, kLength);
  const int scenes = kSanitized ? 10 : 60;
  int touched = 0;
  for (int k = 0; k < scenes; ++k) {
    SweptStock stock(cylinder(kRadius, kLength), {});
    const double lean = random.uniform(0.3, 2.8) * kDegree, about = random.uniform(-kPi, kPi);
    const Vec3 axis(std::sin(lean) * std::cos(about), std::sin(lean) * std::sin(about), std::cos(lean));
    const double deep = random.uniform(0.02, 0.3), across = random.uniform(-4.0, 4.0);
    for (int j = 0; j < 3; ++j)
      stock.add(Sweep::of(straight(Vec3(-20, across + 0.9 * j, kRing + kRadius - deep), axis, 50.0, kLength), 200));
    EngagementMeter meter(stock);
    const ToolRing ring = ring_at(stock.radial(), kRing);
    const double angle = meter.angle(next, 0.5, ring) / kDegree, truth = scanned(stock, next, 0.5, ring) / kDegree;
    EXPECT_NEAR(angle, truth, 0.05) << k << ", leaning by " << lean / kDegree << ", " << deep << " mm deep";
    touched += truth < 179.0 ? 1 : 0;
  }
  EXPECT_GE(touched, scenes / 4);
}

TEST(Engagement, WhereRoundEndsOnlyGrazeARingTheirSweepsCover) {
  // So little below the ring's plane that the discs of two poses do not meet, or lie between them: the way between covers.
  constexpr double kRadius = 4.5, kLength = 30.0, kRing = 12.0;
  Random random(21);
  const RuledMotion next = straight(Vec3(0, 0, 0), Vec3::UnitZ(), 10.0, kLength);
  const int scenes = kSanitized ? 8 : 40;
  int off = 0;
  for (int k = 0; k < scenes; ++k) {
    SweptStock stock(cylinder(kRadius, kLength), {});
    const double lean = random.uniform(0.3, k % 2 == 0 ? 12.0 : 2.8) * kDegree, about = random.uniform(-kPi, kPi);
    const Vec3 axis(std::sin(lean) * std::cos(about), std::sin(lean) * std::sin(about), std::cos(lean));
    const double deep = random.uniform(0.002, 0.03), across = random.uniform(-3.0, 3.0);
    for (int j = 0; j < 3; ++j)
      stock.add(Sweep::of(straight(Vec3(-20, across + 0.9 * j, kRing + kRadius - deep), axis, 50.0, kLength), 48));
    EngagementMeter meter(stock);
    const ToolRing ring = ring_at(stock.radial(), kRing);
    const double angle = meter.angle(next, 0.5, ring) / kDegree, truth = scanned(stock, next, 0.5, ring) / kDegree;
    EXPECT_NEAR(angle, truth, 0.5) << k << ", leaning by " << lean / kDegree << ", " << deep << " mm deep";
    off += std::abs(angle - truth) > 0.05 ? 1 : 0;
  }
  EXPECT_LE(off, scenes / 20);
}

TEST(Engagement, WhatASweepCoversBetweenTwoPosesMayBeginBehindTheBlanksEdge) {
  // The arcs of two poses end just behind the plane, and what is covered between them goes on into the blank.
  constexpr double kRadius = 5.0, kLength = 15.0, kRing = 8.0, kHalf = 1.5;
  struct Scene {
    double way, step;
    int poses;
    double turn, off, t, truth_deg;
  };
  for (const Scene& scene : {Scene{7.767, 0.834, 29, 1.6123, 7.0354, 0.7987, 41.90},
                             Scene{5.419, 0.806, 16, 2.5321, -2.7577, 0.7917, 43.98}}) {
    SweptStock stock(cylinder(kRadius, kLength), {{Vec3(std::cos(scene.turn), std::sin(scene.turn), 0.0), scene.off}});
    stock.add(Sweep::of(on_circle(kLength, scene.way, -kHalf, kHalf), scene.poses));
    EngagementMeter meter(stock);
    const RuledMotion next = on_circle(kLength, scene.way + scene.step, -0.6, 0.6);
    const ToolRing ring = ring_at(stock.radial(), kRing);
    EXPECT_NEAR(scanned(stock, next, scene.t, ring) / kDegree, scene.truth_deg, 0.02);
    EXPECT_NEAR(meter.angle(next, scene.t, ring) / kDegree, scene.truth_deg, 0.05) << scene.way;
  }
}

TEST(Engagement, DoesNotDependOnTheOrderInWhichLeaningToolsCut) {
  constexpr double kRadius = 6.0, kLength = 22.0;
  Random random(7);
  const RuledMotion next = straight(Vec3(0, 0, 0), Vec3::UnitZ(), 10.0, kLength);
  int partly = 0;
  for (int k = 0; k < 20; ++k) {
    std::vector<Sweep> sweeps;
    for (int j = 0; j < 4; ++j) {
      const double lean = random.uniform(11.0, 35.0) * kDegree, about = random.uniform(-kPi, kPi);
      const Vec3 axis(std::sin(lean) * std::cos(about), std::sin(lean) * std::sin(about), std::cos(lean));
      const Vec3 tip(-20, random.uniform(-14.0, 14.0), random.uniform(0.0, 24.0));
      sweeps.push_back(Sweep::of(straight(tip, axis, 50.0, kLength), 48));
    }
    SweptStock forward(cylinder(kRadius, kLength), {}), backward = forward;
    for (std::size_t j = 0; j < sweeps.size(); ++j) {
      forward.add(sweeps[j]);
      backward.add(sweeps[sweeps.size() - 1 - j]);
    }
    EngagementMeter one(forward), other(backward);
    for (const double s : {2.0, 8.0, 14.0, 20.0}) {
      const ToolRing ring = ring_at(forward.radial(), s);
      const double angle = one.angle(next, 0.5, ring);
      EXPECT_EQ(angle, other.angle(next, 0.5, ring)) << k << " " << s;
      partly += angle > 0.1 && angle < 3.0 ? 1 : 0;
    }
  }
  EXPECT_GE(partly, 10);
}

TEST(Engagement, EndsOfArcsLieOnTheSweptVolume) {
  SweptStock stock(barrel(), {});
  stock.add(Sweep::of(twisted_half(0.0), 48));
  EngagementMeter meter(stock);
  const RuledMotion next = twisted_half(1.1);
  // One arc, from the sweep to the front's own end: its length gives the other end, where the gap must vanish.
  const ToolRing ring = ring_at(stock.radial(), 14.0);
  const double angle = meter.angle(next, 0.5, ring);
  const AxisJet axis = next.jet(0.5);
  const Vec3 v = axis.velocity(ring.s), across = v - v.dot(axis.u) * axis.u;
  const Vec3 e1 = across.normalized(), e2 = axis.u.cross(e1);
  const double half = std::acos(-ring.sine * v.dot(axis.u) / (ring.cosine * across.norm()));
  double least = 1e300;
  for (const double end : {half - angle, angle - half}) {
    const Vec3 x = axis.at(ring.z) + ring.radius * (std::cos(end) * e1 + std::sin(end) * e2);
    least = std::min(least, std::abs(stock.gap(x)));
  }
  EXPECT_LT(least, 1e-6);
}

TEST(Engagement, WhatIsCoveredFarFromTheMaterialStaysCovered) {
  // At the exit of a slot material is left at one end of the front alone; the other end was swept, and lies far from it.
  const double radius = 5.0, length = 15.0;
  SweptStock stock(cylinder(radius, length), {{Vec3::UnitX(), 24.0}});
  const auto front = [&](double x) {
    const AxisPlace from = place({x, 0.0, 0.0}, Vec3::UnitZ(), Vec3::UnitX(), Vec3::Zero());
    const AxisPlace to = place({x, 10.0, 0.0}, Vec3::UnitZ(), Vec3::UnitX(), Vec3::Zero());
    return half_path(length, from, to.reversed(), {1.6, 1.6, 1.0, 0.0});
  };
  for (int k = 0; k < 8; ++k) stock.add(Sweep::of(front(16.75 - 1.35 * (8 - k)), 48));
  EngagementMeter meter(stock);
  const ToolRing ring = ring_at(stock.radial(), 0.0);
  for (double t = 0.05; t < 0.5; t += 0.05)
    EXPECT_NEAR(meter.angle(front(16.75), t, ring) / kDegree, scanned(stock, front(16.75), t, ring) / kDegree, 0.01)
        << t;
}

TEST(Engagement, WithoutMaterialAheadThereIsNone) {
  SweptStock stock(barrel(), {{Vec3::UnitX(), -40.0}});
  EngagementMeter meter(stock);
  const Engagement e = meter.measure(twisted_half(0.0), tool_rings(stock.radial(), 7, 3), 9);
  EXPECT_EQ(e.peak.angle_rad, 0.0);
  EXPECT_EQ(e.volume_mm3, 0.0);
}

TEST(Engagement, TheSameAgainIsNothing) {
  SweptStock stock(barrel(), {});
  stock.add(Sweep::of(twisted_half(0.0), 48));
  EngagementMeter meter(stock);
  const Engagement e = meter.measure(twisted_half(0.0), tool_rings(stock.radial(), 7, 0), 33);
  EXPECT_LT(e.volume_mm3, 1e-3);
}

TEST(Engagement, WhereAnotherHalfHasEndedBeforeNothingIsLeft) {
  // The side paths may be such that the second end of a front does not get on. Both last poses are then the same, and the
  // profile that stands for the earlier one is rounded either way.
  SweptStock stock(barrel(), {});
  const AxisPlace to = place({1.0, 14.0, 1.0}, {-0.06, -0.1, 1.0}, {1.0, -0.04, 0.01}, {0.0, -0.003, 0.0});
  const auto from = [](double x) { return place({x, 0.0, 0.0}, {0.05, 0.12, 1.0}, {1.0, 0.05, 0.0}, Vec3::Zero()); };
  stock.add(Sweep::of(half_path(30.0, from(0.0), to.reversed(), {2.5, 2.0, 2.0, 0.0}), 48));
  EngagementMeter meter(stock);
  const RuledMotion next = half_path(30.0, from(0.3), to.reversed(), {2.5, 2.0, 2.0, 0.0});
  const std::vector<ToolRing> rings = tool_rings(stock.radial(), 37, 0);
  EXPECT_EQ(meter.measure(next, rings, 33).rows.back().angle_rad, 0.0);
}

TEST(Engagement, RefinedPeaksAreNotBelowTheRows) {
  SweptStock stock(barrel(), {});
  stock.add(Sweep::of(twisted_half(0.0), 48));
  EngagementMeter meter(stock);
  const RuledMotion next = twisted_half(1.1);
  const Engagement coarse = meter.measure(next, tool_rings(stock.radial(), 7, 0), 17);
  const EngagementPeak peak = meter.refine(next, coarse, 7);
  const Engagement fine = meter.measure(next, tool_rings(stock.radial(), 61, 0), 301);
  EXPECT_GE(peak.angle_rad, coarse.peak.angle_rad);
  EXPECT_GE(peak.angle_rad, fine.peak.angle_rad - 0.01 * kDegree);
}

TEST(Engagement, RefinedPeaksFollowTheRidgeAlongTheAxis) {
  // The blank ends at a plane that leans: each ring comes out of it at a time of its own, engages most just before, and a little more
  // or less than the ring beside it.
  struct Scene {
    double step, lean, off;
  };
  for (const Scene& scene : {Scene{0.7, -0.35, 2.0}, Scene{1.1, 0.12, 10.0}, Scene{1.5, 0.12, 10.0}}) {
    SweptStock stock(barrel(), {{Vec3(0.0, 1.0, scene.lean).normalized(), scene.off + 14.0 * scene.lean}});
    stock.add(Sweep::of(twisted_half(0.0), 48));
    EngagementMeter meter(stock);
    const RuledMotion next = twisted_half(scene.step);
    const Engagement rows = meter.measure(next, RowRings(stock.radial(), 61, 9, 3), 102);
    const double peak = meter.refine(next, rows, 61).angle_rad / kDegree;
    const double fine = meter.measure(next, tool_rings(stock.radial(), 121, 0), 601).peak.angle_rad / kDegree;
    EXPECT_GE(peak, fine - 0.02) << scene.step;
    EXPECT_LE(peak, fine + 0.3) << scene.step;
  }
}

TEST(Engagement, ALookBetweenRowsSeesWhatRisesAndFallsThere) {
  // Rows that are far apart, against a plane that each ring comes out of at a time of its own.
  SweptStock stock(barrel(), {{Vec3(0.0, 1.0, 0.12).normalized(), 10.0 + 14.0 * 0.12}});
  stock.add(Sweep::of(twisted_half(0.0), 48));
  EngagementMeter meter(stock);
  const RuledMotion next = twisted_half(1.1);
  const Engagement rows = meter.measure(next, tool_rings(stock.radial(), 7, 0), 22);
  const double looked = meter.look_between(next, rows).angle_rad / kDegree;
  const double fine = meter.measure(next, tool_rings(stock.radial(), 61, 0), 301).peak.angle_rad / kDegree;
  EXPECT_GE(looked, rows.peak.angle_rad / kDegree);
  EXPECT_LT(fine - looked, 0.5 * (fine - rows.peak.angle_rad / kDegree)) << "half of what was unseen, at least";
  EXPECT_LE(looked, fine + 2.0);
}

TEST(Engagement, RingsBetweenOthersAreAskedWhereTheyEngageMost) {
  // Between two earlier halves at different heights a ridge is left, which lies between rings that are asked in any case.
  SweptStock stock(barrel(), {{Vec3::UnitZ(), 21.3}});
  for (const double step : {0.0, 0.4}) stock.add(Sweep::of(twisted_half(step), 48));
  EngagementMeter meter(stock);
  const RuledMotion next = twisted_half(1.5);
  const RowRings all(stock.radial(), 61, 9), some(stock.radial(), 61, 9, 6);
  const Engagement every = meter.measure(next, all, 41), few = meter.measure(next, some, 41);
  EXPECT_GT(every.peak.angle_rad, 30.0 * kDegree);
  EXPECT_NEAR(few.volume_mm3, every.volume_mm3, 1e-6 * every.volume_mm3) << "which does not hang on them";
  for (std::size_t k = 0; k < every.rows.size(); ++k) {
    EXPECT_LE(few.rows[k].angle_rad, every.rows[k].angle_rad + 1e-9) << k;
    EXPECT_GE(few.rows[k].angle_rad, every.rows[k].angle_rad - 0.03 * kDegree) << k;
  }
}

TEST(Engagement, APeakAloneIsTheOneOfAllRows) {
  SweptStock stock(barrel(), {{Vec3::UnitZ(), 21.3}});
  for (const double step : {0.0, 0.4}) stock.add(Sweep::of(twisted_half(step), 48));
  EngagementMeter meter(stock);
  for (const double step : {0.6, 1.0, 1.5}) {
    const RuledMotion next = twisted_half(step);
    for (const int volume : {0, 5}) {
      const RowRings rings(stock.radial(), 7, volume);
      const Engagement all = meter.measure(next, rings, 34);
      ASSERT_GT(all.peak.angle_rad, 20.0 * kDegree);
      for (const double guess : {0.0, 0.3, 1.0}) {
        const Engagement found = meter.measure_peak(next, rings, 34, guess, 0.0);
        EXPECT_EQ(found.peak.angle_rad, all.peak.angle_rad) << guess;
        EXPECT_EQ(found.peak.t, all.peak.t) << guess;
        EXPECT_EQ(found.volume_mm3, all.volume_mm3) << "all that have an area are looked at";
        EXPECT_EQ(meter.measure_peak(next, rings, 34, guess, 0.9 * all.peak.angle_rad).peak.angle_rad,
                  all.peak.angle_rad);
        EXPECT_LE(meter.measure_peak(next, rings, 34, guess, 1.5 * all.peak.angle_rad).peak.angle_rad,
                  all.peak.angle_rad);
      }
    }
  }
}

TEST(GapAt, DerivativesAreThoseOfDifferences) {
  const RadialFunction radial = barrel();
  const ToolProfile profile(radial);
  const Sweep sweep = Sweep::of(twisted_half(0.0), 48);
  const Vec3 x(3.0, 9.0, 12.0);
  constexpr double kStep = 1e-6;
  const double place = 20.3;
  const GapJet at = gap_at(profile, sweep.at(place), x);
  const double dt =
      (gap_at(profile, sweep.at(place + kStep), x).gap - gap_at(profile, sweep.at(place - kStep), x).gap) /
      (2.0 * kStep);
  EXPECT_NEAR(at.dt, dt, 1e-6);
  for (int k = 0; k < 3; ++k) {
    const Vec3 h = kStep * Vec3::Unit(k);
    const double slope =
        (gap_at(profile, sweep.at(place), x + h).gap - gap_at(profile, sweep.at(place), x - h).gap) / (2.0 * kStep);
    EXPECT_NEAR(at.gradient[k], slope, 1e-6) << k;
  }
}

TEST(GapAt, OfARoundEndIsTheDistanceToItsSphere) {
  // Its radius at a height has an endless slope at the pole, where Newton's steps would find nothing.
  const RadialFunction radial = barrel();
  const ToolProfile profile(radial);
  const SweepPose pose{Vec3::Zero(), 2.0 * Vec3::UnitZ(), Vec3(0.3, 0.2, -0.4), Vec3(0.1, 0.0, 0.0)};
  const Vec3 out = Vec3(0.2, -0.1, -1.0).normalized();
  const double radius = radial.at(0.0).r;
  for (const double distance : {0.5 * radius, radius, radius + 0.3}) {
    const GapJet at = gap_at(profile, pose, distance * out);
    EXPECT_NEAR(at.gap, distance - radius, 1e-12);
    EXPECT_NEAR((at.gradient - out).norm(), 0.0, 1e-12);
    EXPECT_NEAR(at.dt, -out.dot(pose.tip_d1), 1e-12);
  }
}

TEST(Sweep, CubicsBetweenPosesAreTheMotion) {
  const RuledMotion motion = twisted_half(0.0);
  const Sweep sweep = Sweep::of(motion, 48);
  for (const double t : {0.013, 0.27, 0.5, 0.777, 0.999}) {
    const SweepPose pose = sweep.at(48.0 * t);
    EXPECT_NEAR((pose.tip - motion.tip.value(t)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((pose.direction - motion.direction.value(t)).norm(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace flank::internal
