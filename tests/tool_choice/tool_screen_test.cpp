// What is known of a tool before a strip is grown: errors in closed form, shares that count places, and their order.
#include "flank/tool_choice/tool_screen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cover/cover_targets.h"
#include "flank/threads.h"
#include "seed/sheet.h"

namespace flank::internal {
namespace {

using testing::sheet;

/// A piece of a sphere of radius 40 about the origin, seen from outside, 32 mm wide.
Face ball_face() {
  return sheet([](double u, double v) {
    const double a = 0.8 * (u - 0.5), b = 0.8 * (v - 0.5);
    return Vec3(40.0 * std::sin(a) * std::cos(b), 40.0 * std::sin(b), 40.0 * std::cos(a) * std::cos(b));
  });
}

/// The outside of a cylinder of this radius about the y axis, 40 mm long.
Face round_bar(double radius) {
  return sheet([=](double u, double v) {
    const double a = 1.2 * (u - 0.5);
    return Vec3(radius * std::sin(a), 40.0 * (1.0 - v), radius * std::cos(a));
  });
}

/// The target of a face with its normal towards larger |x - origin|, or the other one.
std::unique_ptr<Target> seen(const Face& face, bool outside) {
  const SurfaceJet jet = face.surface.jet(0.5, 0.5);
  return make_target({face}, (jet.du.cross(jet.dv).z() > 0.0) == outside ? +1 : -1);
}

double area_of(const ScreenPlaces& places) { return std::accumulate(places.area.begin(), places.area.end(), 0.0); }

TEST(ScreenPlaces, ShareOutTheTargetEvenly) {
  const auto target = testing::flat_target(0.0, 60.0, 0.0, 20.0);
  for (const int count : {30, 150, 600}) {
    const ScreenPlaces places = screen_places(*target, count);
    EXPECT_NEAR(static_cast<double>(places.feet.size()), count, 0.35 * count);
    ASSERT_EQ(places.area.size(), places.feet.size());
    EXPECT_NEAR(area_of(places), 1200.0, 1e-6);
    EXPECT_NEAR(places.diagonal_mm, std::hypot(60.0, 20.0), 1e-9);
    for (const Footpoint& foot : places.feet) EXPECT_EQ(foot.location, Location::kInside);
  }
}

TEST(ScreenPlaces, TheWidthIsAcrossTheLongestExtentHoweverItLies) {
  const Face face = testing::rectangle(0.0, 0.0, 80.0, 24.0);
  const double here = screen_places(*make_target({face}), 600).width_mm;
  EXPECT_NEAR(here, 24.0, 3.0);
  EXPECT_LT(here, 24.0) << "between the middles of the outermost cells";
  const Face turned =
      testing::moved(face, Eigen::AngleAxisd(0.6, Vec3(0.3, 0.4, 0.9).normalized()), Vec3(5.0, -90.0, 2.0));
  EXPECT_NEAR(screen_places(*make_target({turned}), 600).width_mm, here, 1e-6);
}

TEST(ScreenMeridian, ACylinderInABallIsOffByAParabola) {
  // In a ball of radius R every direction has lambda = -1 / (R - r), and a cylinder mu = 0: e = L^2 / (16 (R - r)).
  const ScreenPlaces places = screen_places(*seen(ball_face(), false), 80);
  for (const double radius : {5.0, 20.0}) {
    const ToolScreen screen = screen_meridian(places, testing::cylinder(radius, 10.0).radial, {0.01});
    EXPECT_NEAR(screen.least_error_mm, 100.0 / (16.0 * (40.0 - radius)), 2e-3) << radius;
    EXPECT_NEAR(screen.mean_error_mm, 100.0 / (16.0 * (40.0 - radius)), 2e-3);
    EXPECT_EQ(screen.fits, 1.0);
    EXPECT_EQ(screen.accepted, 0.0);
  }
}

TEST(ScreenMeridian, OnABallItIsLessThanInIt) {
  // Outside, lambda = 1 / (R + r).
  const ScreenPlaces places = screen_places(*seen(ball_face(), true), 80);
  const ToolScreen screen = screen_meridian(places, testing::cylinder(5.0, 10.0).radial, {0.01});
  EXPECT_NEAR(screen.mean_error_mm, 100.0 / (16.0 * 45.0), 1e-3);
}

TEST(ScreenMeridian, TheFiltersSlackDecides) {
  const ScreenPlaces places = screen_places(*seen(ball_face(), true), 80);
  const RadialFunction radial = testing::cylinder(5.0, 10.0).radial;
  const double error = 100.0 / (16.0 * 45.0);
  EXPECT_EQ(screen_meridian(places, radial, {error / 3.0 * 0.99}).accepted, 0.0);
  EXPECT_EQ(screen_meridian(places, radial, {error / 3.0 * 1.01}).accepted, 1.0);
  EXPECT_EQ(screen_meridian(places, radial, {error / 2.0 * 0.99, 2.0}).accepted, 0.0);
  EXPECT_EQ(screen_meridian(places, radial, {error / 2.0 * 1.01, 2.0}).accepted, 1.0);
}

TEST(ScreenMeridian, EveryCylinderSuitsABarAlongItsLines) {
  for (const bool outside : {true, false}) {
    const ScreenPlaces places = screen_places(*seen(round_bar(30.0), outside), 80);
    for (const double radius : {2.0, 12.0, 29.0}) {
      const ToolScreen screen = screen_meridian(places, testing::cylinder(radius, 15.0).radial, {0.01});
      EXPECT_EQ(screen.accepted, 1.0) << radius;
      EXPECT_LT(screen.mean_error_mm, 1e-3) << radius;
      EXPECT_EQ(screen.reason, "");
    }
  }
}

TEST(ScreenMeridian, AToolTooLargeForAHollowDoesNotFit) {
  const ScreenPlaces places = screen_places(*seen(round_bar(30.0), false), 80);
  const ScreenOptions options{0.01};
  EXPECT_EQ(screen_meridian(places, testing::cylinder(29.9, 15.0).radial, options).fits, 1.0);
  const ToolScreen screen = screen_meridian(places, testing::cylinder(30.5, 15.0).radial, options);
  EXPECT_EQ(screen.fits, 0.0);
  EXPECT_NE(screen.reason.find("needs a tool radius below 30 mm; the smallest of this tool is 30.5 mm"),
            std::string::npos)
      << screen.reason;
  // What counts is the thinnest place: a cone that begins thin has spheres that fit.
  const RadialFunction cone(ToolFamily::kCone, 15.0, Eigen::Vector2d(29.0, 0.3));
  EXPECT_EQ(screen_meridian(places, cone, options).fits, 1.0);
}

TEST(ScreenTool, WithNothingInTheWayItIsTheMeridianAlone) {
  const ScreenPlaces places = screen_places(*seen(round_bar(30.0), true), 80);
  for (const double tolerance : {0.001, 0.05}) {
    const Tool tool = testing::cylinder(6.0, 15.0);
    const ToolScreen all = screen_tool(places, tool, {}, {tolerance});
    const ToolScreen meridian = screen_meridian(places, tool.radial, {tolerance});
    EXPECT_EQ(all.reachable, 1.0);
    EXPECT_EQ(all.open, all.accepted);
    EXPECT_EQ(all.accepted, meridian.accepted);
    EXPECT_EQ(all.least_error_mm, meridian.least_error_mm);
    EXPECT_EQ(all.mean_error_mm, meridian.mean_error_mm);
  }
}

TEST(ScreenTool, ReachIsTheShareBesideAWall) {
  // A ball of 4 mm keeps 4 mm from a wall at y = 20; the band of a cell's width beyond it may count or not.
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 20.0);
  const ScreenPlaces places = screen_places(*target, 2000);
  const Tool tool = testing::cylinder(4.0, 12.0);
  const ToolScreen screen = screen_tool(places, tool, testing::wall_at(20.0), {0.01});
  EXPECT_NEAR(screen.reachable, 16.0 / 20.0, 0.04);
  EXPECT_EQ(screen.fits, screen.reachable);
  EXPECT_EQ(screen.accepted, screen.reachable);
  EXPECT_NEAR(screen.open, screen.accepted, 0.04) << "along the wall it lies free";
}

TEST(ScreenTool, EachShareIsPartOfTheOneBefore) {
  for (const double y : {14.0, 18.0, 26.0}) {
    const auto target = testing::flat_target(0.0, 50.0, 0.0, 20.0);
    Tool tool = testing::cylinder(3.0, 12.0);
    tool.shank = {{12.0, 5.0}, {30.0, 5.0}};
    const ToolScreen screen = screen_tool(screen_places(*target, 200), tool, testing::wall_at(y), {0.01});
    EXPECT_GE(1.0, screen.reachable);
    EXPECT_GE(screen.reachable, screen.fits);
    EXPECT_GE(screen.fits, screen.accepted);
    EXPECT_GE(screen.accepted, screen.open);
    EXPECT_GT(screen.reachable, 0.0);
  }
}

TEST(ScreenTool, SameForAnyNumberOfThreads) {
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 20.0);
  const ScreenPlaces places = screen_places(*target, 200);
  std::vector<ToolScreen> screens;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    screens.push_back(screen_tool(places, testing::cylinder(4.0, 12.0), testing::wall_at(18.0), {0.01}));
  }
  set_thread_count(0);
  EXPECT_EQ(screens[0].open, screens[1].open);
  EXPECT_EQ(screens[0].reachable, screens[1].reachable);
  EXPECT_EQ(screens[0].mean_error_mm, screens[1].mean_error_mm);
}

}  // namespace
}  // namespace flank::internal
