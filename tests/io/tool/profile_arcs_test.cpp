// Profiles as arcs: how far from the meridian, without corners, no more than it takes, and read back as the same tool.
#include "flank/io/tool/profile_arcs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/error.h"
#include "flank/io/tool/tool_dxf.h"
#include "flank/io/tool/tool_dxf_read.h"
#include "flank/tool.h"

namespace flank::internal {
namespace {

constexpr double kToleranceMm = 1e-3;

RadialFunction waisted() {
  return RadialFunction::spline(40.0, (Eigen::VectorXd(8) << 4.0, 4.6, 5.9, 6.1, 5.8, 6.4, 7.4, 7.1).finished());
}

std::vector<RadialFunction> tools() {
  return {waisted(), RadialFunction(ToolFamily::kBarrel, 24.0, Eigen::Vector3d(85, 5, 10)),
          RadialFunction(ToolFamily::kCone, 30.0, Eigen::Vector2d(3.0, 0.1)),
          RadialFunction::spline(0.04, 1e-3 * (Eigen::VectorXd(5) << 4.0, 4.6, 5.9, 6.1, 5.8).finished())};
}

/// Unit tangent of an arc at its beginning, or at its end.
Vec2 tangent(const ProfileArc& arc, bool at_end) {
  const double turn = (at_end ? 2.0 : -2.0) * std::atan(arc.bulge);
  const Vec2 chord = (arc.to - arc.from).normalized();
  return {std::cos(turn) * chord.x() - std::sin(turn) * chord.y(),
          std::sin(turn) * chord.x() + std::cos(turn) * chord.y()};
}

TEST(ProfileArcs, AreWithinTheToleranceOfTheMeridian) {
  for (const RadialFunction& radial : tools()) {
    const double tolerance = kToleranceMm * radial.axis_length() / 40.0;
    const std::vector<ProfileArc> arcs = profile_arcs(radial, tolerance);
    EXPECT_LT((arcs.front().from - meridian_point(radial, 0.0)).norm(), 1e-12);
    EXPECT_LT((arcs.back().to - meridian_point(radial, radial.axis_length())).norm(), 1e-12);
    // Places that the planner of the arcs does not look at.
    for (int k = 0; k <= 1009; ++k) {
      const Vec2 p = meridian_point(radial, radial.axis_length() * k / 1009.0);
      double nearest = 1e9;
      for (const ProfileArc& arc : arcs) {
        const double slack = 1e-9 * radial.axis_length();
        if (p.x() >= arc.from.x() - slack && p.x() <= arc.to.x() + slack)
          nearest = std::min(nearest, distance_to(arc, p));
      }
      EXPECT_LE(nearest, tolerance) << k;
    }
  }
}

TEST(ProfileArcs, GoOnWithoutACorner) {
  for (const RadialFunction& radial : tools()) {
    const std::vector<ProfileArc> arcs = profile_arcs(radial, kToleranceMm);
    for (std::size_t k = 1; k < arcs.size(); ++k) {
      EXPECT_EQ(arcs[k - 1].to, arcs[k].from);
      EXPECT_LT((tangent(arcs[k - 1], true) - tangent(arcs[k], false)).norm(), 1e-7) << k;
    }
  }
}

TEST(ProfileArcs, AreAsFewAsItTakes) {
  EXPECT_EQ(profile_arcs(RadialFunction(ToolFamily::kCone, 30.0, Eigen::Vector2d(3.0, 0.1)), kToleranceMm).size(), 1U);
  // A barrel's profile is an arc already: two equal halves of it.
  const auto barrel = profile_arcs(RadialFunction(ToolFamily::kBarrel, 24.0, Eigen::Vector3d(85, 5, 10)), kToleranceMm);
  EXPECT_LE(barrel.size(), 2U);
  EXPECT_LE(profile_arcs(waisted(), kToleranceMm).size(), 40U);
  EXPECT_LT(profile_arcs(waisted(), 1e-2).size(), profile_arcs(waisted(), 1e-4).size());
}

TEST(ProfileArcs, PointsLieOnTheArc) {
  const ProfileArc arc{{0.0, 5.0}, {10.0, 6.0}, -0.3};
  const std::vector<Vec2> points = points_of(arc, 1e-3);
  ASSERT_GT(points.size(), 10U);
  for (const Vec2& p : points) EXPECT_LT(distance_to(arc, p), 1e-12);
  // It turns to the right, so it bulges to the left of its chord: by half of bulge times chord.
  const Vec2 top = points[points.size() / 2];
  EXPECT_GT(top.y(), 5.5);
  EXPECT_EQ(points_of({{0.0, 5.0}, {10.0, 6.0}, 0.0}, 1e-3).size(), 1U);
}

TEST(ProfileArcs, ADrawingOfArcsIsReadBackAsTheSameTool) {
  for (const RadialFunction& radial : tools()) {
    if (radial.axis_length() < 1.0) continue;
    Tool tool;
    tool.radial = radial;
    const Tool again = tool_from_dxf(tool_to_dxf(tool, true), "t.dxf", radial.axis_length());
    for (int k = 0; k <= 20; ++k) {
      const double s = radial.axis_length() * k / 20.0;
      EXPECT_NEAR(again.radial.at(s).r, radial.at(s).r, 2.0 * kDxfArcsMm) << s;
    }
  }
}

TEST(ProfileArcs, MoreThanAHalfCircleIsRefused) {
  try {
    (void)profile_from_dxf(
        "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nFLANK\n10\n0\n20\n5\n42\n1.5\n10\n9\n20\n5\n0\nENDSEC\n0\nEOF\n",
        "t.dxf");
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "t.dxf: line 6: LWPOLYLINE: an arc of more than a half circle");
  }
}

}  // namespace
}  // namespace flank::internal
