// The descent to a closest point within a parameter box: closed forms, ends of the box, and starts that are not good.
#include "flank/surface/nurbs/nurbs_newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

ParameterBox whole(const BSplinePatches& s) {
  return {s.breaks_u().front(), s.breaks_u().back(), s.breaks_v().front(), s.breaks_v().back(), 0, s.cells_u() - 1, 0,
          s.cells_v() - 1};
}

Descent from(double u, double v) {
  Descent x;
  x.u = u;
  x.v = v;
  return x;
}

Descent run(const BSplinePatches& s, const Vec3& p, const ParameterBox& box, double size, double u, double v) {
  Descent x = from(u, v);
  descend(s, p, box, size, nullptr, x);
  return x;
}

TEST(NurbsNewton, ReachesTheFootpointOnAPlaneInOneStep) {
  const BSplinePatches s(test::plane(10.0).surface);
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Vec3 p(random.uniform(0, 10), random.uniform(0, 10), random.uniform(-5, 5));
    const Descent x = run(s, p, whole(s), 14.0, random.uniform(), random.uniform());
    EXPECT_EQ(x.end, Descent::End::kConverged);
    EXPECT_LT((x.jet.p - Vec3(p[0], p[1], 0)).norm(), 1e-13);
    EXPECT_NEAR(x.squared, p[2] * p[2], 1e-12);
    EXPECT_EQ(x.side_u, 0);
    EXPECT_EQ(x.side_v, 0);
    EXPECT_NEAR(x.stiffness, 1.0, 1e-12) << "a plane has no focal points";
  }
}

TEST(NurbsNewton, ConvergesToRoundOffOnASphere) {
  const BSplinePatches s(test::sphere(10.0).surface);
  Random random(2);
  for (int k = 0; k < 300; ++k) {
    // Within one quarter, so that no seam lies between start and end.
    const double angle = random.uniform(0.2, 1.3), height = random.uniform(-0.8, 0.8),
                 out = std::sqrt(1 - height * height);
    const Vec3 direction(out * std::cos(angle), out * std::sin(angle), height);
    const double radius = random.uniform(4.0, 30.0);
    const Descent x =
        run(s, radius * direction, whole(s), 35.0, angle / (0.5 * std::numbers::pi) + random.uniform(-0.1, 0.1),
            1.0 + 0.7 * height + random.uniform(-0.1, 0.1));
    EXPECT_EQ(x.end, Descent::End::kConverged);
    EXPECT_LT((x.jet.p - 10.0 * direction).norm(), 1e-12);
    EXPECT_NEAR(gradient_u(x.jet, radius * direction), 0.0, 1e-10);
    EXPECT_NEAR(gradient_v(x.jet, radius * direction), 0.0, 1e-10);
    // Inside, the Hessian over the metric is (1 - d k)^2 = (radius / 10)^2, or 1 - d k if the last, tiny step counted
    // as clipped in one direction because of round-off.
    if (radius < 9.0) {
      EXPECT_GE(x.stiffness, std::pow(radius / 10.0, 2) - 1e-3);
      EXPECT_LE(x.stiffness, radius / 10.0 + 1e-3);
    }
  }
}

TEST(NurbsNewton, NeverEndsFartherThanItBegan) {
  Random random(3);
  const BSplineSurface wavy = test::wavy(5, 3, 3, 8, 8, true, 20.0).surface;
  const BSplinePatches s(wavy);
  const ParameterBox box = whole(s);
  for (int k = 0; k < 400; ++k) {
    const Vec3 p(random.uniform(-20, 120), random.uniform(-20, 120), random.uniform(-60, 60));
    const double u = random.uniform(box.u0, box.u1), v = random.uniform(box.v0, box.v1);
    const Descent x = run(s, p, box, 150.0, u, v);
    EXPECT_LE(x.squared, (wavy.value(u, v) - p).squaredNorm() * (1.0 + 1e-12));
    EXPECT_LT((wavy.value(x.u, x.v) - x.jet.p).norm(), 1e-10) << "the jet belongs to u and v";
    EXPECT_GE(x.u, box.u0);
    EXPECT_LE(x.u, box.u1);
    EXPECT_GE(x.v, box.v0);
    EXPECT_LE(x.v, box.v1);
  }
}

TEST(NurbsNewton, IsHeldByTheEndsOfItsBox) {
  const BSplinePatches s(test::plane(10.0).surface);
  ParameterBox box = whole(s);
  box.u0 = 0.2;
  box.u1 = 0.5;
  box.v1 = 0.7;
  const auto at = [&](double x, double y) { return run(s, Vec3(x, y, 1), box, 14.0, 0.3, 0.3); };
  const Descent free = at(3, 4), high_u = at(9, 4), low_u = at(-1, 4), high_v = at(3, 9), corner = at(9, 9);
  EXPECT_EQ(free.side_u, 0);
  EXPECT_EQ(high_u.side_u, 1);
  EXPECT_EQ(high_u.side_v, 0);
  EXPECT_LT((high_u.jet.p - Vec3(5, 4, 0)).norm(), 1e-12);
  EXPECT_EQ(low_u.side_u, -1);
  EXPECT_LT((low_u.jet.p - Vec3(2, 4, 0)).norm(), 1e-12);
  EXPECT_EQ(high_v.side_v, 1);
  EXPECT_LT((high_v.jet.p - Vec3(3, 7, 0)).norm(), 1e-12);
  EXPECT_EQ(corner.side_u, 1);
  EXPECT_EQ(corner.side_v, 1);
  EXPECT_LT((corner.jet.p - Vec3(5, 7, 0)).norm(), 1e-12);
  for (const Descent* x : {&free, &high_u, &low_u, &high_v, &corner}) EXPECT_EQ(x->end, Descent::End::kConverged);
}

TEST(NurbsNewton, AStartOutsideTheBoxIsTakenToItsEnd) {
  const BSplinePatches s(test::plane(10.0).surface);
  const Descent x = run(s, Vec3(4, 6, 2), whole(s), 14.0, -7.0, 19.0);
  EXPECT_EQ(x.end, Descent::End::kConverged);
  EXPECT_LT((x.jet.p - Vec3(4, 6, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace flank::internal
