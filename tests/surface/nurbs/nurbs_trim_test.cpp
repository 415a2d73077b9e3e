/// Footpoints on trimmed faces and on several faces together.
#include <gtest/gtest.h>

#include <numbers>

#include "flank/error.h"
#include "flank/geom/trim.h"
#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

using namespace test;

constexpr double kPi = std::numbers::pi;

TrimLoop circle(double u, double v, double radius_u, double radius_v) {
  BSplineCurve2 c;
  c.degree = 2;
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  c.poles.resize(2, 9);
  for (int k = 0; k < 9; ++k) {
    const double angle = k * kPi / 4, reach = k % 2 == 1 ? std::numbers::sqrt2 : 1.0;
    c.poles.col(k) = Vec2(u + radius_u * reach * std::cos(angle), v + radius_v * reach * std::sin(angle));
    c.weights.push_back(1 / reach);
  }
  return {{c}};
}

/// Straight edges from corner to corner.
TrimLoop polygon(const std::vector<Vec2>& corners) {
  TrimLoop loop;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    BSplineCurve2 edge;
    edge.degree = 1;
    edge.knots = {0, 0, 1, 1};
    edge.poles.resize(2, 2);
    edge.poles << corners[k], corners[(k + 1) % corners.size()];
    loop.edges.push_back(std::move(edge));
  }
  return loop;
}

TEST(NurbsTrim, PlateWithARoundHoleIsExact) {
  Face face = plane(10);
  face.loops = {rectangle_loop({0, 1, 0, 1}), circle(0.5, 0.5, 0.2, 0.2)};  // a hole of radius 2 at (5, 5)
  const auto target = make_target(std::vector<Face>{face});
  EXPECT_NEAR(target->area(), 100 - 4 * kPi, 0.05);
  EXPECT_NEAR(target->diagonal(), std::sqrt(200.0), 1e-9);
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p(random.uniform(-5, 15), random.uniform(-5, 15), random.uniform(-8, 8));
    Vec3 q(std::clamp(p[0], 0.0, 10.0), std::clamp(p[1], 0.0, 10.0), 0.0);
    const Vec3 from = q - Vec3(5, 5, 0);
    const bool hole = from.norm() < 2;
    if (hole) q = Vec3(5, 5, 0) + 2 * from.normalized();
    const bool inside = !hole && p[0] > 0 && p[0] < 10 && p[1] > 0 && p[1] < 10;
    const Footpoint f = target->closest(p);
    EXPECT_NEAR(std::abs(f.distance), (p - q).norm(), 1e-10);
    EXPECT_LT((f.point - q).norm(), 1e-8);
    EXPECT_EQ(f.location, inside ? Location::kInside : Location::kBorder);
    const Footpoint t = target->track(p, f);
    if (hole) {
      EXPECT_EQ(t.location, Location::kExtension) << "the surface goes on under a hole";
      EXPECT_NEAR(t.distance, p[2], 1e-11);
    }
  }
}

TEST(NurbsTrim, ATrimAlongTheRectangleIsABorder) {
  // A plate with two corners cut out, whose right edge lies on the end of the parameters. In their last digits the trim
  // lies beside the cells there (the parameters are those of a real part), which are then not cut by it.
  const double u0 = -18.958170991229931, u1 = 6.8112017060040433, v1 = 56.632659910000001, step_u = 6.5, step_v = 45;
  Face face = bilinear({u0, -v1, 0}, {u0, v1, 0}, {u1, -v1, 0}, {u1, v1, 0});
  face.surface.knots_u = {u0, u0, u1, u1};
  face.surface.knots_v = {-v1, -v1, v1, v1};
  face.loops = {polygon({{u0, -v1},
                         {step_u, -v1},
                         {step_u, -step_v},
                         {u1, -step_v},
                         {u1, step_v},
                         {step_u, step_v},
                         {step_u, v1},
                         {u0, v1}})};
  const auto target = make_target(std::vector<Face>{face});
  Random random(2);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p(random.uniform(7, 60), random.uniform(-44, 44), random.uniform(-60, 60));
    const Footpoint f = target->closest(p);
    EXPECT_NEAR(std::abs(f.distance), (p - Vec3(u1, p[1], 0)).norm(), 1e-9);
    EXPECT_EQ(f.location, Location::kBorder) << p.transpose();
  }
}

/// Distance to the wavy face trimmed by an ellipse with an elliptic hole: the grid of the interior, and both ellipses
/// densely.
double brute_trimmed(const BSplineSurface& s, const Vec3& p) {
  const auto inside = [](double u, double v) {
    const double outer = std::hypot((u - 0.55) / 0.35, (v - 1.5) / 2.5),
                 hole = std::hypot((u - 0.6) / 0.1, (v - 1.0) / 0.8);
    return outer <= 1 && hole >= 1;
  };
  struct Start {
    double squared, u, v;
  };
  std::vector<Start> starts;
  const int grid = 150;
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= grid; ++j) {
      const double u = i / double(grid), v = -2 + 7 * j / double(grid);
      if (inside(u, v)) starts.push_back({(s.value(u, v) - p).squaredNorm(), u, v});
    }
  std::partial_sort(starts.begin(), starts.begin() + 8, starts.end(),
                    [](const Start& a, const Start& b) { return a.squared < b.squared; });
  double best = starts[0].squared;
  for (std::size_t k = 0; k < 8; ++k) {
    Start x = starts[k];
    for (double hu = 1.0 / grid, hv = 7.0 / grid; hu > 1e-11;) {
      Start next = x;
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b) {
          if (!inside(x.u + a * hu, x.v + b * hv)) continue;
          const double d = (s.value(x.u + a * hu, x.v + b * hv) - p).squaredNorm();
          if (d < next.squared) next = {d, x.u + a * hu, x.v + b * hv};
        }
      if (next.squared < x.squared) {
        x = next;
      } else {
        hu *= 0.5;
        hv *= 0.5;
      }
    }
    best = std::min(best, x.squared);
  }
  for (int loop = 0; loop < 2; ++loop) {
    const auto at = [&](double a) {
      return loop == 0 ? (s.value(0.55 + 0.35 * std::cos(a), 1.5 + 2.5 * std::sin(a)) - p).squaredNorm()
                       : (s.value(0.6 + 0.1 * std::cos(a), 1.0 + 0.8 * std::sin(a)) - p).squaredNorm();
    };
    double angle = 0;
    const int count = 2000;
    for (int k = 0; k < count; ++k)
      if (at(2 * kPi * k / count) < at(angle)) angle = 2 * kPi * k / count;
    for (double h = 2 * kPi / count; h > 1e-12;) {
      if (at(angle + h) < at(angle))
        angle += h;
      else if (at(angle - h) < at(angle))
        angle -= h;
      else
        h *= 0.5;
    }
    best = std::min(best, at(angle));
  }
  return std::sqrt(best);
}

TEST(NurbsTrim, ClosestOnATrimmedWavyFaceMatchesBruteForce) {
  Face face = wavy(31, 3, 3, 9, 8, false, 15);
  face.loops = {circle(0.55, 1.5, 0.35, 2.5), circle(0.6, 1.0, 0.1, 0.8)};
  const auto target = make_target(std::vector<Face>{face});
  Random random(2);
  int borders = 0;
  for (int k = 0; k < few_if_sanitized(250); ++k) {
    const Vec3 p = random_in(random, target->box(), k % 3 == 0 ? -0.05 : k % 3 == 1 ? 0.3 : 3.0);
    const Footpoint f = target->closest(p);
    borders += f.location == Location::kBorder;
    EXPECT_LT(std::abs(f.distance) - brute_trimmed(face.surface, p), 1e-9 * target->diagonal()) << k;
    EXPECT_NEAR(std::abs(f.distance), (p - f.point).norm(), 1e-10);
    const double outer = std::hypot((f.u - 0.55) / 0.35, (f.v - 1.5) / 2.5),
                 hole = std::hypot((f.u - 0.6) / 0.1, (f.v - 1) / 0.8);
    EXPECT_LT(outer, 1 + 1e-6) << "never off the trimmed face";
    EXPECT_GT(hole, 1 - 1e-6);
  }
  EXPECT_GT(borders, few_if_sanitized(60));
  double area = 0;
  for (const SurfaceSample& s : target->samples(0.7)) area += s.area;
  EXPECT_NEAR(area / target->area(), 1, 2e-3);
}

TEST(NurbsTrim, TwoPlatesSideBySideAreOne) {
  const Face left = plane(10);
  Face right = bilinear({10, 0, 0}, {10, 10, 0}, {20, 0, 0}, {20, 10, 0});
  const auto target = make_target(std::vector<Face>{left, right});
  EXPECT_EQ(target->patch_count(), 2);
  EXPECT_NEAR(target->area(), 200, 1e-9);
  EXPECT_EQ(target->closest({10, 5, 3}).location, Location::kInside);
  EXPECT_EQ(target->closest({10, -5, 3}).location, Location::kBorder) << "the end of the shared edge is on the outline";
  EXPECT_EQ(target->closest({-1, 5, 3}).location, Location::kBorder);
  Footpoint f = target->closest({5, 5, 2});
  for (double x = 5; x < 15; x += 0.5) {
    f = target->track({x, 5, 2}, f);
    EXPECT_EQ(f.location, Location::kInside) << x;
    EXPECT_NEAR(f.distance, 2, 1e-12);
    if (x != 10) {
      EXPECT_EQ(f.patch, x < 10 ? 0 : 1);
    }
  }
}

TEST(NurbsTrim, ASharpEdgeIsNoBorderAndHasTheRightSide) {
  // A roof of 20 degrees between its two sides, ridge along y, outward normals up and out.
  const double slope = std::tan(80 * kPi / 180);
  const Face left = bilinear({-1, 0, -slope}, {-1, 10, -slope}, {0, 0, 0}, {0, 10, 0});
  const Face right = bilinear({0, 0, 0}, {0, 10, 0}, {1, 0, -slope}, {1, 10, -slope});
  const auto target = make_target(std::vector<Face>{left, right});
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const double angle = random.uniform(-75, 75) * kPi / 180, reach = random.uniform(0.1, 5);
    const Vec3 p(reach * std::sin(angle), random.uniform(1, 9), reach * std::cos(angle));
    const Footpoint f = target->closest(p);
    EXPECT_EQ(f.location, Location::kInside);
    EXPECT_NEAR(f.distance, reach, 1e-9) << "outside of the material, whichever face was found first";
    EXPECT_NEAR(f.normal.dot((p - f.point).normalized()), 1, 1e-9);
  }
}

TEST(NurbsTrim, AWindowOfALargerSurfaceIsExtendedByThatSurface) {
  Face face = wavy(33, 3, 3, 9, 8, false, 5);
  face.loops = {rectangle_loop({0.3, 0.7, 0.0, 3.0})};
  const auto target = make_target(std::vector<Face>{face});
  const SurfaceJet jet = face.surface.jet(0.72, 1.0);
  const Vec3 n = jet.du.cross(jet.dv).normalized(), p = jet.p + n;
  const Footpoint f = target->track(p, target->closest(p));
  EXPECT_EQ(f.location, Location::kExtension);
  EXPECT_NEAR(f.distance, 1, 1e-11);
  EXPECT_LT((f.point - jet.p).norm(), 1e-10);
}

TEST(NurbsTrim, RefusesWhatIsNoTarget) {
  EXPECT_THROW((void)make_target(std::vector<Face>{}), InputError);
  Face face = plane(10);
  face.surface.weights = {1, 1, 0, 1};
  EXPECT_THROW((void)make_target(std::vector<Face>{face}), InputError);
  EXPECT_THROW((void)make_target(std::vector<Face>{plane(0)}), InputError);
  face = plane(10);
  face.loops = {rectangle_loop({2, 3, 2, 3})};  // outside of the surface
  EXPECT_THROW((void)make_target(std::vector<Face>{face}), InputError);
}

TEST(NurbsTrim, APointThatIsNotFiniteGetsNoFootpoint) {
  Face face = plane(10);
  face.loops = {circle(0.5, 0.5, 0.2, 0.2)};
  const auto target = make_target(std::vector<Face>{face});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Footpoint good = target->closest({5, 5, 1});
  for (const Footpoint& f : {target->closest({nan, 0, 0}), target->track({0, nan, 0}, good)}) {
    EXPECT_EQ(f.patch, -1);
    EXPECT_TRUE(std::isnan(f.distance));
  }
}

}  // namespace
}  // namespace flank::internal
