// The replay of programs: swept volumes and engagement angles against closed forms.
#include "flank/verify/stock/replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal::verify {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180.0;

RadialFunction cylinder(double radius, double length) {
  return {ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius)};
}

Box3 box_of(const Vec3& low, const Vec3& high) {
  Box3 box;
  box.add(low);
  box.add(high);
  return box;
}

Strip straight(const Vec3& from, const Vec3& to, int poses) {
  Strip strip;
  for (int k = 0; k < poses; ++k) strip.poses.push_back({from + (to - from) * k / (poses - 1.0), Vec3::UnitZ()});
  return strip;
}

Strip arc(double way, double from, double to, double z, int poses) {
  Strip strip;
  strip.kind = "front";
  for (int k = 0; k < poses; ++k) {
    const double angle = std::lerp(from, to, k / (poses - 1.0));
    strip.poses.push_back({{way * std::cos(angle), way * std::sin(angle), z}, Vec3::UnitZ()});
  }
  return strip;
}

TEST(StockReplay, ASlotIsHalfACircleAndHasItsVolume) {
  const double radius = 4.0;
  DexelStock stock(box_of({-20.0, -8.0, 0.0}, {20.0, 8.0, 6.0}), {}, 0.1);
  // The tool stands out above and below, so that no round end cuts.
  const StockReplay done =
      replay(stock, cylinder(radius, 20.0), {{straight({-30.0, 0.1, -7.0}, {0.0, 0.1, -7.0}, 31)}}, {.circles = 0});
  EXPECT_NEAR(done.before_mm3 - done.after_mm3, 6.0 * (20.0 * 2.0 * radius + 0.5 * kPi * radius * radius), 1.0);
  EXPECT_NEAR(done.strips[0].volume_mm3, done.before_mm3 - done.after_mm3, 1e-3);
  EXPECT_NEAR(done.strips[0].way_mm, 30.0, 1e-9);
}

TEST(StockReplay, EngagementOfACutBesideASlotIsTheClosedForm) {
  if (kThreadSanitized) GTEST_SKIP() << "the same loops as on an arc";
  const double radius = 4.0, length = 10.0;
  for (const double step : {0.4, 1.5, 2.0, 4.0}) {
    DexelStock stock(box_of({-20.0, -12.0, 0.0}, {20.0, 12.0, 10.0}), {}, 0.1);
    Path path{{straight({-30.0, 0.0, 0.0}, {30.0, 0.0, 0.0}, 61), straight({-10.0, step, 0.0}, {10.0, step, 0.0}, 41)}};
    path.strips[1].kind = "front";
    const StockReplay done = replay(stock, cylinder(radius, length), path, {.circles = 5});
    const double closed = std::acos(1.0 - step / radius);
    for (std::size_t k = 12; k + 4 < path.strips[1].poses.size(); k += 7)
      EXPECT_NEAR(done.strips[1].poses[k].angle_rad / kDegree, closed / kDegree, 1.0) << step << " pose " << k;
    EXPECT_EQ(done.largest("back"), 0.0);
  }
}

TEST(StockReplay, KeepsWhereEveryCircleEntersAndLeaves) {
  const double radius = 4.0, step = 1.5;
  DexelStock stock(box_of({-20.0, -12.0, 2.5}, {20.0, 12.0, 10.0}), {}, 0.1);
  const Path path{
      {straight({-30.0, 0.0, 0.0}, {30.0, 0.0, 0.0}, 61), straight({-10.0, step, 0.0}, {10.0, step, 0.0}, 41)}};
  const StockReplay done = replay(stock, cylinder(radius, 10.0), path, {.circles = 5});
  EXPECT_EQ(done.heights, (std::vector<double>{0.0, 2.5, 5.0, 7.5, 10.0}));
  const auto at = [&](std::size_t strip, int ring) -> std::vector<EngagedArc> {
    std::vector<EngagedArc> arcs;
    for (const EngagedArc& arc : done.strips[strip].poses[20].arcs)
      if (arc.ring == ring) arcs.push_back(arc);
    return arcs;
  };
  EXPECT_TRUE(at(0, 0).empty()) << "below the stock";
  ASSERT_EQ(at(0, 2).size(), 1u);
  EXPECT_NEAR(at(0, 2)[0].from / kDegree, -90.0, 1.0);
  EXPECT_NEAR(at(0, 2)[0].to / kDegree, 90.0, 1.0);
  // The slot is on the right; what is left of the wall on the left is met from its edge to where the circle goes no farther out.
  ASSERT_EQ(at(1, 2).size(), 1u);
  EXPECT_NEAR(at(1, 2)[0].from / kDegree, std::asin((radius - step) / radius) / kDegree, 1.0);
  EXPECT_NEAR(at(1, 2)[0].to / kDegree, 90.0, 1.0);
}

TEST(StockReplay, EngagementOnAnArcIsTheClosedForm) {
  const double radius = 4.0, length = 12.0, way = 9.0;
  for (const double step : {0.5, 1.2}) {
    DexelStock stock(box_of({-2.0, -16.0, 0.0}, {18.0, 16.0, 10.0}), {}, 0.1);
    const Path path{{arc(way, -1.5, 1.5, -1.0, 121), arc(way + step, -0.6, 0.6, -1.0, 49)}};
    const StockReplay done = replay(stock, cylinder(radius, length), path, {.circles = 5});
    const double outer = way + step, edge = way + radius;
    const double closed = std::acos((edge * edge - outer * outer - radius * radius) / (2.0 * outer * radius));
    EXPECT_NEAR(done.strips[1].poses[24].angle_rad / kDegree, closed / kDegree, 1.5) << step;
    EXPECT_NEAR(done.strips[1].poses[40].angle_rad / kDegree, closed / kDegree, 1.5) << step;
    const double ring = 0.5 * 1.2 * 10.0 * (std::pow(outer + radius, 2) - std::pow(edge, 2));
    double swept = 0.0;
    for (std::size_t k = 5; k < 49; ++k) swept += done.strips[1].poses[k].volume_mm3;
    EXPECT_NEAR(swept / (ring * 44.0 / 48.0), 1.0, 5e-3) << step;
  }
}

TEST(StockReplay, NothingInTheAirAndNothingTwice) {
  DexelStock stock(box_of({-10.0, -10.0, 0.0}, {10.0, 10.0, 8.0}), {}, 0.2);
  Path path{{straight({-30.0, 0.0, 0.0}, {30.0, 0.0, 0.0}, 31), straight({-30.0, 0.0, 0.0}, {30.0, 0.0, 0.0}, 31),
             straight({-30.0, 0.0, 40.0}, {30.0, 0.0, 40.0}, 31)}};
  const StockReplay done = replay(stock, cylinder(3.0, 8.0), path, {});
  EXPECT_NEAR(done.strips[0].angle_rad, kPi, 0.02) << "a full slot";
  for (const std::size_t k : {1U, 2U}) EXPECT_EQ(done.strips[k].volume_mm3, 0.0) << k;
  EXPECT_EQ(done.strips[2].angle_rad, 0.0);
  // Both walls only touch the tool in the second pass. The first one leaves scallops of 0.05 cells and cones 0.01 cells
  // inside of the tool on them: as much engagement as a cut of that depth has cannot be told from none.
  const double radius = 3.0, cell = 0.2, wall = 0.06 * cell;
  EXPECT_LT(done.strips[1].angle_rad, 2.0 * std::acos(1.0 - wall / radius));
}

TEST(StockReplay, AChipThinnerThanTheRidgesOfItsOwnCutsIsNoEngagement) {
  // On from where a slot has ended: over half of its circle the tool meets a chip as thick as the step. The stock's own cuts
  // leave ridges of 0.05 cells there, which engage as far.
  const double radius = 3.0, cell = 0.2, most = 2.0 * std::acos(1.0 - 0.06 * cell / radius);
  const auto engagement = [&](double step) {
    DexelStock stock(box_of({-10.0, -10.0, 0.0}, {10.0, 10.0, 8.0}), {}, cell);
    const Vec3 end(0.37, 0.11, -1.1);
    const Path path{{straight({-30.0, 0.11, -1.1}, end, 61), straight({0.0, 0.0, 40.0}, {9.0, 0.0, 40.0}, 4),
                     straight(end, end + Vec3(step, 0.0, 0.0), 2)}};
    return replay(stock, cylinder(radius, 11.0), path, {}).strips[2].angle_rad;
  };
  EXPECT_LT(engagement(0.01 * cell), most) << "as on walls that are only touched";
  EXPECT_GT(engagement(0.5 * cell), 160.0 * kDegree) << "a chip of half a cell is seen";
  EXPECT_GT(engagement(0.1 * cell), 100.0 * kDegree) << "and one of a tenth, where it is thick";
}

TEST(StockReplay, EngagementInATightBendIsTheClosedForm) {
  // The bend's inner side has passed over itself: what the tool has just taken there is in its front.
  const double radius = 5.0, length = 12.0;
  for (const double way : {2.0, 4.0}) {
    const double step = 0.8, outer = way + step, edge = way + radius;
    DexelStock stock(box_of(Vec3(-10.0, -10.0, 0.0), Vec3(10.0, 10.0, 6.0)), {}, 0.1);
    const Path path{{arc(way, -1.5, 1.5, -3.0, 121), arc(outer, -0.7, 0.7, -3.0, 41)}};
    const StockReplay done = replay(stock, cylinder(radius, length), path, {.circles = 3});
    const double closed = std::acos((edge * edge - outer * outer - radius * radius) / (2.0 * outer * radius));
    for (const std::size_t k : {16U, 28U, 36U})
      EXPECT_NEAR(done.strips[1].poses[k].angle_rad / kDegree, closed / kDegree, 1.0) << way << " pose " << k;
  }
}

TEST(StockReplay, EngagementAtTheEndOfTheBlankIsTheClosedForm) {
  // Beside a slot and out through a slanted end: the arc that is left lies between the slot's wall and the plane.
  const double radius = 4.0, step = 1.5, slant = 25.0 * kDegree, end = 10.0;
  const Vec3 normal(std::cos(slant), std::sin(slant), 0.0);
  DexelStock stock(box_of({-20.0, -12.0, 0.0}, {20.0, 12.0, 10.0}), {{normal, end}}, 0.1);
  Path path{{straight({-30.0, 0.0, 0.0}, {30.0, 0.0, 0.0}, 61), straight({0.0, step, 0.0}, {14.0, step, 0.0}, 57)}};
  const StockReplay done = replay(stock, cylinder(radius, 10.0), path, {.circles = 5});
  int left = 0;
  for (std::size_t k = 8; k < path.strips[1].poses.size(); k += 3) {
    const Vec3& centre = path.strips[1].poses[k].tip;
    // The front from the wall at y = radius to +90 degrees; the plane takes |theta - slant| < width away.
    const double room = (end - normal.dot(centre)) / radius;
    const double width = room >= 1.0 ? 0.0 : std::acos(std::max(-1.0, room));
    const double low = std::asin((radius - step) / radius), high = 0.5 * kPi;
    const double closed =
        std::max(0.0, std::min(high, slant - width) - low) + std::max(0.0, high - std::max(low, slant + width));
    if (closed > 0.0) ++left;
    EXPECT_NEAR(done.strips[1].poses[k].angle_rad / kDegree, closed / kDegree, 1.5) << centre.x();
  }
  EXPECT_GT(left, 8);
}

TEST(StockReplay, EngagementOfAConeIsThatOfItsThinnestCircle) {
  const double step = 1.0;
  const RadialFunction cone(ToolFamily::kCone, 14.0, Eigen::Vector2d(3.0, 8.0 * kDegree));
  DexelStock stock(box_of({-14.0, -12.0, 0.0}, {14.0, 12.0, 10.0}), {}, 0.1);
  Path path{{straight({-24.0, 0.0, 1.0}, {24.0, 0.0, 1.0}, 61), straight({-6.0, step, 1.0}, {6.0, step, 1.0}, 25)}};
  const StockReplay done = replay(stock, cone, path, {.circles = 5});
  const RadialJet j = cone.at(0.0);
  const double circle = j.r * std::sqrt(1.0 - j.d1 * j.d1);
  for (const std::size_t k : {10U, 18U}) {
    EXPECT_NEAR(done.strips[1].poses[k].angle_rad / kDegree, std::acos(1.0 - step / circle) / kDegree, 1.0) << k;
    EXPECT_EQ(done.strips[1].poses[k].s, 0.0);
  }
}

TEST(StockReplay, SeesWhatRisesAndFallsJustBeforeTheEndOfAStrip) {
  // A plate right before the tool's last place, which it breaks through in the last hundredths of a millimetre of its way.
  const double radius = 5.0, way = 10.0, plate = 0.34, through = 0.06, back = way + radius - through;
  DexelStock stock(box_of({0.0, -8.0, 0.0}, {back + 1.0, 8.0, 6.0}),
                   {{Vec3::UnitX(), back}, {-Vec3::UnitX(), plate - back}}, 0.1);
  Path path{{straight({0.0, 0.0, -7.0}, {way, 0.0, -7.0}, 51)}};
  path.strips[0].kind = "back";
  const StockReplay done = replay(stock, cylinder(radius, 20.0), path, {.circles = 3});
  const auto within = [&](double depth) { return 2.0 * std::acos((radius - depth) / radius) / kDegree; };
  EXPECT_NEAR(done.largest("back") / kDegree, within(plate), 1.5);
  EXPECT_EQ(done.strips[0].pose, 50u) << "on the way to the last pose";
}

TEST(StockReplay, AStripOfFewPosesIsMeasuredAsOneOfMany) {
  // Near to each other at its end, and not all along the way from the last pose but one.
  const double radius = 4.0, way = 10.0;
  const auto replayed = [&](int poses) {
    DexelStock stock(box_of({-20.0, -8.0, 0.0}, {20.0, 8.0, 6.0}), {}, 0.1);
    return replay(stock, cylinder(radius, 20.0), {{straight({0.0, 0.0, -7.0}, {way, 0.0, -7.0}, poses)}},
                  {.circles = 3});
  };
  const StripReplay few = replayed(2).strips[0], many = replayed(101).strips[0];
  EXPECT_LE(few.places, many.places);
  EXPECT_NEAR(few.angle_rad, many.angle_rad, 1e-3);
  EXPECT_NEAR(few.volume_mm3, many.volume_mm3, 1e-5 * many.volume_mm3);
}

TEST(StockReplay, AStripGoesOnWhereTheLastOneEnded) {
  const double radius = 4.0, step = 1.5, closed = std::acos(1.0 - step / radius);
  DexelStock stock(box_of({-20.0, -12.0, 0.0}, {20.0, 12.0, 10.0}), {}, 0.1);
  Path path{{straight({-30.0, 0.0, 0.0}, {30.0, 0.0, 0.0}, 61), straight({-10.0, step, 0.0}, {0.0, step, 0.0}, 21),
             straight({0.0, step, 0.0}, {10.0, step, 0.0}, 21)}};
  const StockReplay done = replay(stock, cylinder(radius, 10.0), path, {.circles = 3});
  for (const std::size_t k : {0U, 1U, 2U, 8U})
    EXPECT_NEAR(done.strips[2].poses[k].angle_rad / kDegree, closed / kDegree, 1.0) << k;
}

TEST(StockReplay, CutsToTheEndOfAWayThatTurnsBack) {
  // In steps much smaller than cuts need to be: the farthest pose lies near the ones around it.
  const double radius = 4.0, end = 0.3;
  DexelStock stock(box_of({-20.0, -8.0, 0.0}, {20.0, 8.0, 6.0}), {}, 0.1);
  Strip strip = straight({-0.3, 0.0, -7.0}, {end, 0.0, -7.0}, 3);
  const Strip back = straight({end, 0.0, -7.0}, {-0.3, 0.0, -7.0}, 3);
  strip.poses.insert(strip.poses.end(), back.poses.begin() + 1, back.poses.end());
  (void)replay(stock, cylinder(radius, 20.0), {{strip}}, {.circles = 0});
  EXPECT_LE(stock.depth({end + radius - 0.05, 0.0, 3.0}), 0.0);
}

TEST(StockReplay, RaysFindWhatIsLeftAndWhatIsEntered) {
  DexelStock stock(box_of({-10.0, -10.0, 0.0}, {10.0, 10.0, 8.0}), {}, 0.1);
  const Path path{{straight({-30.0, 0.0, -1.0}, {30.0, 0.0, -1.0}, 31)}};
  (void)replay(stock, cylinder(3.0, 10.0), path, {.circles = 0});
  // A wall at y = 3.2: 0.2 mm are left on it. One at y = 2.9 is entered by 0.1 mm.
  EXPECT_NEAR(left_along(stock, {1.0, 3.2, 4.0}, -Vec3::UnitY(), 2.0).over_mm, 0.2, 0.06);
  EXPECT_EQ(left_along(stock, {1.0, 3.2, 4.0}, -Vec3::UnitY(), 2.0).entered_mm, 0.0);
  EXPECT_NEAR(left_along(stock, {1.0, 2.9, 4.0}, -Vec3::UnitY(), 2.0).entered_mm, 0.1, 0.02);
}

TEST(StockReplay, IsTheSameForAnyNumberOfThreads) {
  std::vector<StockReplay> all;
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    DexelStock stock(box_of({-2.0, -16.0, 0.0}, {18.0, 16.0, 10.0}), {}, 0.25);
    all.push_back(replay(stock, cylinder(4.0, 12.0), {{arc(9.0, -1.0, 1.0, -1.0, 41)}}, {}));
  }
  set_thread_count(0);
  ASSERT_EQ(all[0].strips[0].poses.size(), all[1].strips[0].poses.size());
  EXPECT_EQ(all[0].after_mm3, all[1].after_mm3);
  for (std::size_t k = 0; k < all[0].strips[0].poses.size(); ++k) {
    EXPECT_EQ(all[0].strips[0].poses[k].angle_rad, all[1].strips[0].poses[k].angle_rad);
    EXPECT_EQ(all[0].strips[0].poses[k].volume_mm3, all[1].strips[0].poses[k].volume_mm3);
  }
}

}  // namespace
}  // namespace flank::internal::verify
