// A face prepared for footpoints: seams, poles, creases, extension, and the footpoint's normal and curvatures.
#include "flank/surface/nurbs/nurbs_face.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

NurbsFace prepared(const Face& face, int side = 1, const ExtensionOptions& options = {}) {
  return {face, side, options};
}

TEST(NurbsFace, KnowsWhichDirectionsCloseAndWhichBordersArePoints) {
  const NurbsFace tube = prepared(test::cylinder(5, 20, 4)), half = prepared(test::cylinder(5, 20, 2)),
                  ball = prepared(test::sphere(5)), ring = prepared(test::torus(20, 5)), tip = prepared(test::cone(9));
  EXPECT_TRUE(tube.closed_u());
  EXPECT_FALSE(tube.closed_v());
  EXPECT_FALSE(half.closed_u());
  EXPECT_TRUE(ball.closed_u());
  EXPECT_FALSE(ball.closed_v()) << "two poles are no seam";
  EXPECT_TRUE(ring.closed_u());
  EXPECT_TRUE(ring.closed_v());
  for (int border = 0; border < 4; ++border) {
    EXPECT_EQ(ball.pole(border), border >= 2);
    EXPECT_EQ(tip.pole(border), border == 2) << "the apex at v = v0";
    EXPECT_FALSE(ring.pole(border));
    EXPECT_FALSE(tube.pole(border));
  }
}

TEST(NurbsFace, ExtendsOpenBordersByATenthAndNothingElse) {
  const NurbsFace plate = prepared(test::plane(10));
  const ParameterBox &d = plate.domain(), &e = plate.extended();
  EXPECT_NEAR(d.u1 - d.u0, 1.0, 1e-15);
  EXPECT_NEAR(e.u0, -0.1, 1e-12);
  EXPECT_NEAR(e.u1, 1.1, 1e-12);
  EXPECT_NEAR(e.v0, -0.1, 1e-12);
  EXPECT_NEAR(e.v1, 1.1, 1e-12);
  const NurbsFace tube = prepared(test::cylinder(5, 20, 4));
  EXPECT_EQ(tube.extended().u0, tube.domain().u0) << "closed";
  EXPECT_EQ(tube.extended().u1, tube.domain().u1);
  EXPECT_NEAR(tube.extended().v1, 1.1, 1e-12);
  const NurbsFace tip = prepared(test::cone(9));
  EXPECT_EQ(tip.extended().v0, 0.0) << "a pole";
  EXPECT_NEAR(tip.extended().v1, 1.1, 1e-12);
  const NurbsFace bare = prepared(test::plane(10), 1, {0.0, 0.18});
  EXPECT_EQ(bare.extended().u0, bare.domain().u0);
  EXPECT_EQ(bare.extended().v1, bare.domain().v1);
}

TEST(NurbsFace, TheRestOfATrimmedSurfaceIsItsExtension) {
  Face face = test::plane(10);
  face.loops = {rectangle_loop({0.3, 0.6, 0.4, 0.8})};
  const NurbsFace window = prepared(face);
  EXPECT_NEAR(window.domain().u0, 0.3, 1e-6);
  EXPECT_NEAR(window.domain().v1, 0.8, 1e-6);
  EXPECT_NEAR(window.extended().u0, 0.27, 1e-6);
  EXPECT_NEAR(window.extended().v1, 0.84, 1e-6);
  EXPECT_NEAR(window.size(), 5.0, 1e-5) << "3 by 4";
  EXPECT_TRUE(window.inside(0.45, 0.5));
  EXPECT_FALSE(window.inside(0.1, 0.5));
}

/// u has a full knot at 0.5; whether it is a crease depends on the control points beside it.
Face two_plates(double rise) {
  Face f;
  f.id = "F1";
  BSplineSurface& s = f.surface;
  s = {1, 1, {0, 0, 0.5, 1, 1}, {0, 0, 1, 1}, 3, 2, {}, {}};
  for (const auto& [x, z] : {std::pair(0.0, 0.0), std::pair(5.0, 0.0), std::pair(10.0, rise)})
    for (const double y : {0.0, 8.0}) s.poles.emplace_back(x, y, z);
  return f;
}

TEST(NurbsFace, OnlyKinksAreCreases) {
  EXPECT_TRUE(prepared(two_plates(0.0)).creases_u().empty()) << "a full knot in a plane";
  const NurbsFace roof = prepared(two_plates(3.0));
  ASSERT_EQ(roof.creases_u().size(), 1u);
  EXPECT_EQ(roof.creases_u()[0], 0.5);
  EXPECT_TRUE(roof.creases_v().empty());
  EXPECT_EQ(roof.zone_at(0.2, 0.5).u1, 0.5);
  EXPECT_EQ(roof.zone_at(0.8, 0.5).u0, 0.5);
  EXPECT_TRUE(prepared(test::cylinder(5, 20, 4)).creases_u().empty()) << "arcs join smoothly at their double knots";
}

TEST(NurbsFace, TracksAcrossACreaseToTheOtherSide) {
  const NurbsFace roof = prepared(two_plates(3.0));
  bool ok = false;
  const Footpoint f = roof.track(Vec3(8.0, 4.0, 1.8), 0.1, 0.5, ok);
  EXPECT_TRUE(ok);
  EXPECT_LT((f.point - Vec3(8.0, 4.0, 1.8)).norm(), 1e-10);
  EXPECT_EQ(f.location, Location::kInside);
  // Above a valley's line the nearest point is on one of the sides; below a ridge it is the line itself.
  const Footpoint line = roof.track(Vec3(5.2, 4.0, -2.0), 0.2, 0.5, ok);
  EXPECT_TRUE(ok);
  EXPECT_LT((line.point - Vec3(5.0, 4.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(std::abs(line.distance), std::hypot(0.2, 2.0), 1e-9);
  EXPECT_LT((line.normal * line.distance - (Vec3(5.2, 4.0, -2.0) - line.point)).norm(), 1e-9) << "its own gradient";
}

TEST(NurbsFace, TracksRoundAClosedSurface) {
  const NurbsFace tube = prepared(test::cylinder(5, 20, 4));
  bool ok = false;
  const Footpoint f = tube.track(Vec3(7, 0.2, 11), 3.95, 0.5, ok);
  EXPECT_TRUE(ok);
  EXPECT_NEAR(f.distance, std::hypot(7, 0.2) - 5.0, 1e-12) << "across the seam at u = 0";
  EXPECT_LT(f.u, 0.1);
}

TEST(NurbsFace, NormalTurnsWithSideAndReversal) {
  Face face = test::cylinder(5, 20, 4);
  for (const bool reversed : {false, true})
    for (const int side : {1, -1}) {
      face.reversed = reversed;
      const NurbsFace tube = prepared(face, side);
      bool ok = false;
      const Footpoint f = tube.track(Vec3(4, 5, 9), 0.5, 0.5, ok);
      const double sign = (reversed ? -1.0 : 1.0) * side;
      EXPECT_LT((f.normal - sign * Vec3(4, 5, 0).normalized()).norm(), 1e-12);
      EXPECT_NEAR(f.distance, sign * (std::hypot(4, 5) - 5.0), 1e-12);
      EXPECT_NEAR(sign > 0 ? f.k1 : f.k2, -sign / 5.0, 1e-8) << "bends away from the outside";
      EXPECT_NEAR(sign > 0 ? f.k2 : f.k1, 0.0, 1e-8);
      const Vec3 straight = sign > 0 ? f.d2 : f.d1;
      EXPECT_NEAR(std::abs(straight[2]), 1.0, 1e-9);
      EXPECT_LT((f.d1.cross(f.d2) - f.normal).norm(), 1e-12);
    }
}

TEST(NurbsFace, HasANormalAtItsPoles) {
  const NurbsFace ball = prepared(test::sphere(5));
  for (const double u : {0.0, 0.7, 2.3, 4.0}) {
    EXPECT_LT((ball.normal(ball.jet_within(u, 0.0), u, 0.0) - Vec3(0, 0, -1)).norm(), 1e-4);
    EXPECT_LT((ball.normal(ball.jet_within(u, 2.0), u, 2.0) - Vec3(0, 0, 1)).norm(), 1e-4);
  }
  const Footpoint f = ball.footpoint(Vec3(0, 0, 9), 1.0, 2.0, ball.jet_within(1.0, 2.0), true, Location::kInside);
  EXPECT_EQ(f.k1, 0.0) << "curvature is undefined in these parameters";
  EXPECT_NEAR(f.distance, 4.0, 1e-6);
}

/// Oblique parameters on a torus: the curvatures are those of the surface, not of its parameters.
TEST(NurbsFace, CurvaturesDoNotDependOnTheParameters) {
  const NurbsFace ring = prepared(test::torus(20, 6));
  Face sheared = test::wavy(6, 3, 3, 8, 8, false, 15.0);
  const NurbsFace face = prepared(sheared);
  Random random(1);
  for (int k = 0; k < 50; ++k) {
    const double u = random.uniform(0.1, 0.9), v = random.uniform(-1.5, 4.5);
    const SurfaceJet a = face.jet_within(u, v);
    // The same point seen in the parameters u' = u, v' = v + 0.7 u.
    SurfaceJet b = a;
    b.du = a.du - 0.7 * a.dv;
    b.duu = a.duu - 1.4 * a.duv + 0.49 * a.dvv;
    b.duv = a.duv - 0.7 * a.dvv;
    const Vec3 p = a.p + Vec3(1, 2, 3);
    const Footpoint x = face.footpoint(p, u, v, a, true, Location::kInside),
                    y = face.footpoint(p, u, v, b, true, Location::kInside);
    EXPECT_NEAR(x.k1, y.k1, 1e-10);
    EXPECT_NEAR(x.k2, y.k2, 1e-10);
    EXPECT_NEAR(std::abs(x.d1.dot(y.d1)), 1.0, 1e-7);
    // Normal curvature along d1 and d2, by the second fundamental form.
    for (const auto& [direction, curvature] : {std::pair(x.d1, x.k1), std::pair(x.d2, x.k2)}) {
      Eigen::Matrix2d metric;
      metric << a.du.dot(a.du), a.du.dot(a.dv), a.du.dot(a.dv), a.dv.dot(a.dv);
      const Vec2 c = metric.inverse() * Vec2(direction.dot(a.du), direction.dot(a.dv));
      EXPECT_NEAR((c[0] * c[0] * a.duu + 2 * c[0] * c[1] * a.duv + c[1] * c[1] * a.dvv).dot(x.normal), curvature,
                  1e-10);
    }
  }
  bool ok = false;
  const Footpoint inner = ring.track(Vec3(12, 0.5, 0.3), 0.0, 2.0, ok);
  EXPECT_NEAR(std::max(std::abs(inner.k1), std::abs(inner.k2)), 1.0 / 6.0, 1e-10);
  EXPECT_LT(inner.k1 * inner.k2, 0.0) << "a saddle on the inner side";
}

}  // namespace
}  // namespace flank::internal
