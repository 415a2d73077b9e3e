#include <gtest/gtest.h>

#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

using namespace test;

constexpr double kRelative = 1e-9;

TEST(NurbsTarget, PlaneIsExact) {
  const auto target = make_target(std::vector<Face>{plane(10)});
  EXPECT_NEAR(target->area(), 100.0, 1e-10);
  EXPECT_NEAR(target->diagonal(), std::sqrt(200.0), 1e-12);
  Random random(1);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p(random.uniform(-20, 30), random.uniform(-20, 30), random.uniform(-20, 20));
    const Vec3 q(std::clamp(p[0], 0.0, 10.0), std::clamp(p[1], 0.0, 10.0), 0.0);
    const Footpoint f = target->closest(p);
    EXPECT_LT((f.point - q).norm(), 1e-12);
    const bool inside = p[0] > 0 && p[0] < 10 && p[1] > 0 && p[1] < 10;
    EXPECT_EQ(f.location, inside ? Location::kInside : Location::kBorder);
    EXPECT_NEAR(f.distance, inside ? p[2] : (p[2] < 0 ? -1 : 1) * (p - q).norm(), 1e-12);
    EXPECT_NEAR(f.normal[2], 1.0, 1e-14);
    EXPECT_NEAR(f.k1, 0.0, 1e-14);
    EXPECT_NEAR(f.k2, 0.0, 1e-14);
  }
}

TEST(NurbsTarget, CylinderIsExact) {
  const auto target = make_target(std::vector<Face>{cylinder(10, 40, 4)});
  EXPECT_NEAR(target->area(), 2 * std::numbers::pi * 10 * 40, 1e-3);
  Random random(2);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 p(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(0, 40));
    const double rho = std::hypot(p[0], p[1]);
    const Footpoint f = target->closest(p);
    EXPECT_NEAR(f.distance, rho - 10, 1e-11);
    EXPECT_EQ(f.location, Location::kInside) << "a seam is no border";
    EXPECT_NEAR(f.k1, -0.1, 1e-10);
    EXPECT_NEAR(f.k2, 0.0, 1e-10);
    EXPECT_NEAR(std::abs(f.d2[2]), 1.0, 1e-8);
    EXPECT_LT((f.normal - Vec3(p[0] / rho, p[1] / rho, 0)).norm(), 1e-10);
  }
}

TEST(NurbsTarget, SphereIsExactEverywhereAndHasNoBorder) {
  const auto target = make_target(std::vector<Face>{sphere(10)});
  EXPECT_NEAR(target->area(), 400 * std::numbers::pi, 1e-3);
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    Vec3 p(random.normal(), random.normal(), random.normal());
    p *= random.uniform(1, 60) / p.norm();
    if (k % 10 == 0) p.head<2>() *= 1e-3;
    const Footpoint f = target->closest(p);
    EXPECT_NEAR(f.distance, p.norm() - 10, 1e-10);
    EXPECT_EQ(f.location, Location::kInside);
    EXPECT_LT((f.normal - p.normalized()).norm(), 1e-6);
  }
  EXPECT_NEAR(target->closest(Vec3(0, 0, 25)).distance, 15, 1e-12);
  EXPECT_NEAR(target->closest(Vec3(0, 0, 0)).distance, -10, 1e-12);
}

TEST(NurbsTarget, TorusIsExact) {
  const auto target = make_target(std::vector<Face>{torus(20, 5)});
  Random random(4);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 p(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-20, 20));
    const double ring = std::hypot(p[0], p[1]) - 20;
    const Footpoint f = target->closest(p);
    EXPECT_NEAR(std::abs(f.distance), std::abs(std::hypot(ring, p[2]) - 5), 1e-11);
    EXPECT_EQ(f.location, Location::kInside);
  }
}

TEST(NurbsTarget, ConeApexIsNoBorder) {
  const auto target = make_target(std::vector<Face>{cone(10)});
  const Footpoint f = target->closest(Vec3(0.3, 0.1, -5));
  EXPECT_LT(f.point.norm(), 1e-9);
  EXPECT_EQ(f.location, Location::kInside);
  EXPECT_NEAR(std::abs(f.distance), Vec3(0.3, 0.1, -5).norm(), 1e-10);
}

struct Case {
  const char* name;
  Face face;
};

std::vector<Case> cases() {
  return {{"bicubic", wavy(1, 3, 3, 9, 8, false, 20)},
          {"rational", wavy(2, 3, 2, 7, 9, true, 20)},
          {"ruled", twisted_ruled()},
          {"degree 1", wavy(3, 1, 1, 6, 6, false, 15)},
          {"degree 5 x 4", wavy(4, 5, 4, 9, 7, false, 25)},
          {"degree 7", wavy(5, 7, 3, 9, 9, true, 25)},
          {"saddle", bilinear({0, 0, 0}, {0, 50, 30}, {50, 0, 30}, {50, 50, 0})}};
}

TEST(NurbsTarget, ClosestMatchesBruteForce) {
  for (const Case& c : cases()) {
    const auto target = make_target(std::vector<Face>{c.face});
    Random random(11);
    for (int k = 0; k < few_if_sanitized(60); ++k) {
      const double margin = k % 3 == 0 ? 0.05 : k % 3 == 1 ? 0.5 : 4.0;
      const Vec3 p = random_in(random, target->box(), margin);
      const Footpoint f = target->closest(p);
      const double brute = brute_distance(c.face.surface, p);
      EXPECT_NEAR(std::abs(f.distance), (f.point - p).norm(), 1e-10) << c.name << ' ' << k;
      EXPECT_LT((f.point - p).norm() - brute, kRelative * target->diagonal()) << c.name << ' ' << k;
      EXPECT_LT((c.face.surface.value(f.u, f.v) - f.point).norm(), 1e-11 * target->diagonal()) << c.name;
    }
  }
}

TEST(NurbsTarget, ClosestMatchesBruteForceNearFocalPoints) {
  // Where the sphere about p osculates the surface, minima merge and Newton's method alone is lost.
  for (const Case& c : cases()) {
    const auto target = make_target(std::vector<Face>{c.face});
    Random random(14);
    const BSplineSurface& s = c.face.surface;
    for (int k = 0; k < few_if_sanitized(30); ++k) {
      const Vec3 on = s.value(random.uniform(s.u_first(), s.u_last()), random.uniform(s.v_first(), s.v_last()));
      const Footpoint at = target->closest(on);
      const double curvature = std::abs(at.k1) > std::abs(at.k2) ? at.k1 : at.k2;
      if (std::abs(curvature) * target->diagonal() < 0.1) continue;
      const Vec3 p = on + random.uniform(0.98, 1.02) / curvature * at.normal;
      EXPECT_LT(std::abs(target->closest(p).distance) - brute_distance(s, p), kRelative * target->diagonal())
          << c.name << ' ' << k;
    }
  }
}

TEST(NurbsTarget, TrackFollowsTheColdFootpointAndContinuesPastTheBorder) {
  const Face face = wavy(1, 3, 3, 9, 8, false, 4);
  const auto target = make_target(std::vector<Face>{face});
  Random random(12);
  int outside = 0;
  for (int k = 0; k < 200; ++k) {
    const double u = random.uniform(), v = random.uniform(-2, 5);
    const SurfaceJet jet = face.surface.jet(u, v);
    const Vec3 n = jet.du.cross(jet.dv).normalized();
    const double d = random.uniform(-3, 3);
    const Footpoint f = target->track(jet.p + d * n, target->closest(jet.p + Vec3(2, -2, 1)));
    EXPECT_NEAR(f.distance, d, 1e-11);
    EXPECT_LT((f.point - jet.p).norm(), 1e-10);
  }
  for (int k = 0; k < 100; ++k) {
    const double v = random.uniform(-1, 4);
    const SurfaceJet jet = face.surface.jet(1.0, v);
    const Vec3 p = jet.p + 4 * jet.du.normalized() + jet.du.cross(jet.dv).normalized();
    const Footpoint f = target->track(p, target->closest(p));
    if (f.location != Location::kExtension) continue;
    ++outside;
    EXPECT_GE(f.u, 1.0);
    if (f.u > 1.0 + 1e-9) {
      EXPECT_LT((p - f.point - f.distance * f.normal).norm(), 1e-9);
    }
  }
  EXPECT_GT(outside, 80);
}

TEST(NurbsTarget, CurvaturesAreThoseOfTheDistance) {
  const auto target = make_target(std::vector<Face>{wavy(21, 4, 3, 9, 8, false, 6)}, -1);
  Random random(13);
  const double h = 1e-3;
  for (int k = 0; k < 50; ++k) {
    Vec3 p = random_in(random, target->box(), -0.02);
    const Footpoint f = target->closest(p);
    if (f.location != Location::kInside) continue;
    p = f.point + 2.0 * f.normal;  // in front of the machining side
    const Footpoint g = target->track(p, f);
    EXPECT_NEAR(g.distance, 2.0, 1e-11);
    const auto second = [&](const Vec3& d) {
      return (target->track(p + h * d, g).distance - 2 * g.distance + target->track(p - h * d, g).distance) / (h * h);
    };
    EXPECT_LE(g.k1, g.k2);
    EXPECT_NEAR(second(g.d1), -g.k1 / (1 - 2.0 * g.k1), 1e-5);
    EXPECT_NEAR(second(g.d2), -g.k2 / (1 - 2.0 * g.k2), 1e-5);
    EXPECT_NEAR(g.d1.dot(g.d2), 0, 1e-12);
    EXPECT_NEAR(g.d1.dot(g.normal), 0, 1e-12);
    const Vec3 gradient(
        (target->track(p + h * Vec3::UnitX(), g).distance - target->track(p - h * Vec3::UnitX(), g).distance),
        (target->track(p + h * Vec3::UnitY(), g).distance - target->track(p - h * Vec3::UnitY(), g).distance),
        (target->track(p + h * Vec3::UnitZ(), g).distance - target->track(p - h * Vec3::UnitZ(), g).distance));
    EXPECT_LT((gradient / (2 * h) - g.normal).norm(), 1e-6);
  }
}

TEST(NurbsTarget, SideAndReversalTurnTheNormal) {
  Face face = plane(10);
  EXPECT_GT(make_target(std::vector<Face>{face}, +1)->closest({5, 5, 1}).distance, 0);
  EXPECT_LT(make_target(std::vector<Face>{face}, -1)->closest({5, 5, 1}).distance, 0);
  face.reversed = true;
  EXPECT_LT(make_target(std::vector<Face>{face}, +1)->closest({5, 5, 1}).distance, 0);
  EXPECT_GT(make_target(std::vector<Face>{face}, -1)->closest({5, 5, 1}).distance, 0);
}

TEST(NurbsTarget, SamplesShareTheArea) {
  for (const Case& c : cases()) {
    const auto target = make_target(std::vector<Face>{c.face});
    double area = 0;
    const auto samples = target->samples(target->diagonal() / 60);
    for (const SurfaceSample& s : samples) {
      area += s.area;
      EXPECT_NEAR(s.normal.norm(), 1.0, 1e-12);
    }
    EXPECT_NEAR(area / target->area(), 1.0, 2e-3) << c.name;
    EXPECT_GT(samples.size(), 900u);
  }
}

TEST(NurbsTarget, ExtensionContinuesAPlaneAndACylinderExactly) {
  const auto flat = make_target(std::vector<Face>{plane(10)});
  const Footpoint f = flat->track({10.6, -0.4, 2}, flat->closest({9, 1, 2}));
  EXPECT_EQ(f.location, Location::kExtension);
  EXPECT_NEAR(f.distance, 2, 1e-12);
  EXPECT_LT((f.point - Vec3(10.6, -0.4, 0)).norm(), 1e-12);
  const auto half = make_target(std::vector<Face>{cylinder(10, 40, 2)});
  const Vec3 p(-12 * std::cos(0.1), -12 * std::sin(0.1), 41);
  const Footpoint g = half->track(p, half->closest(p));
  EXPECT_EQ(g.location, Location::kExtension);
  EXPECT_NEAR(g.distance, 2, 1e-10);
}

TEST(NurbsTarget, TrackGoesRoundASeam) {
  const auto target = make_target(std::vector<Face>{cylinder(10, 40, 4)});
  Footpoint f = target->closest({15, 0, 20});
  for (int k = 0; k <= 200; ++k) {
    const double angle = 0.1 * k;
    f = target->track(15 * Vec3(std::cos(angle), std::sin(angle), 0) + Vec3(0, 0, 20), f);
    EXPECT_NEAR(f.distance, 5, 1e-11);
    EXPECT_EQ(f.location, Location::kInside);
  }
}

}  // namespace
}  // namespace flank::internal
