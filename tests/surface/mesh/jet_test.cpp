// Fitted jets: quadrics with their curvatures, invariances, weights, noise and points that do not suffice.
// mesh_surface_test.cpp has their derivatives.
#include "flank/surface/mesh/jet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

using Heights = double (*)(double, double);

/// Points (x, y, z(x, y)) at random within a disk.
std::vector<Vec3> cloud(Heights z, double radius, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points{{0.0, 0.0, z(0.0, 0.0)}};
  while (static_cast<int>(points.size()) < count) {
    const double x = random.uniform(-radius, radius), y = random.uniform(-radius, radius);
    if (x * x + y * y <= radius * radius) points.emplace_back(x, y, z(x, y));
  }
  return points;
}

JetFit fit(const std::vector<Vec3>& points, int degree, double falloff) {
  JetWorkspace workspace;
  return fit_jet(points, points[0], Vec3::UnitZ(), degree, falloff, workspace);
}

double sphere(double x, double y) { return 10.0 - std::sqrt(100.0 - x * x - y * y); }
double saddle(double x, double y) { return 0.05 * x * x - 0.02 * y * y; }

/// Second derivatives of the height at the origin, in the x, y of the test.
Eigen::Matrix2d hessian(const Jet& jet) {
  const Jet::Heights h = jet.heights(0.0, 0.0);
  const Eigen::Matrix2d turn = jet.frame.topLeftCorner<2, 2>();
  return turn * (Eigen::Matrix2d() << h.xx, h.xy, h.xy, h.yy).finished() * turn.transpose();
}

TEST(JetFit, HasTheCurvaturesOfASphereAndOfASaddleWithTheirSigns) {
  const JetFit bowl = fit(cloud(sphere, 1.0, 60, 1), 4, 2.0);
  EXPECT_EQ(bowl.degree, 4);
  EXPECT_LT((hessian(bowl.jet) - 0.1 * Eigen::Matrix2d::Identity()).norm(), 1e-5);
  EXPECT_LT(bowl.residual, 1e-7);
  const JetFit pass = fit(cloud(saddle, 3.0, 60, 2), 4, 2.0);
  EXPECT_NEAR(hessian(pass.jet)(0, 0), 0.1, 1e-12);
  EXPECT_NEAR(hessian(pass.jet)(1, 1), -0.04, 1e-12);
  EXPECT_NEAR(hessian(pass.jet)(0, 1), 0.0, 1e-12);
}

TEST(JetFit, ErrorsFallWithThePowerOfTheSize) {
  // A quartic through a sphere misses sixth-order terms only: halving the size takes it down by about 2^6.
  double before = 0.0;
  for (const double radius : {4.0, 2.0, 1.0}) {
    const std::vector<Vec3> points = cloud(sphere, radius, 80, 3);
    const Jet jet = fit(points, 4, 2.0).jet;
    double worst = 0.0;
    for (const Vec3& p : points) worst = std::max(worst, (jet.project(p) - p).norm());
    if (before > 0.0) {
      EXPECT_LT(worst, before / 32.0) << radius;
    }
    before = worst;
  }
}

TEST(JetFit, MovesWithItsPoints) {
  const std::vector<Vec3> points = cloud(sphere, 3.0, 50, 4);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.3, Vec3(1, 2, -2).normalized()).toRotationMatrix();
  const Vec3 shift(5, 6, 7);
  std::vector<Vec3> moved;
  for (const Vec3& p : points) moved.emplace_back(turn * p + shift);
  JetWorkspace workspace;
  const Jet a = fit(points, 4, 3.0).jet;
  const Jet b = fit_jet(moved, moved[0], turn.col(2), 4, 3.0, workspace).jet;
  for (double x = -2.0; x <= 2.0; x += 0.5) {
    const Vec3 q(x, 0.3 * x - 0.4, 0.1);
    EXPECT_LT((b.project(turn * q + shift) - (turn * a.project(q) + shift)).norm(), 1e-10);
    EXPECT_LT((b.normal(turn * q + shift) - turn * a.normal(q)).norm(), 1e-10);
  }
}

TEST(JetFit, ScalesWithItsPoints) {
  std::vector<Vec3> points = cloud(sphere, 3.0, 50, 5);
  const JetFit a = fit(points, 4, 3.0);
  for (Vec3& p : points) p *= 1e-4;
  const JetFit b = fit(points, 4, 3.0);
  EXPECT_EQ(a.degree, b.degree);
  EXPECT_NEAR(b.residual, 1e-4 * a.residual, 1e-10 * a.residual + 1e-18);
  EXPECT_LT((b.jet.project(Vec3(1e-4, -1e-4, 0)) - 1e-4 * a.jet.project(Vec3(1, -1, 0))).norm(), 1e-15);
}

TEST(JetFit, NormalIsAcrossTheJetAndOnTheSideOfItsHeights) {
  const Jet jet = fit(cloud(sphere, 3.0, 60, 6), 4, 2.0).jet;
  constexpr double h = 1e-5;
  for (double x = -2.0; x <= 2.0; x += 0.4) {
    const Vec3 q(x, 1.0 - 0.5 * x, 0.0);
    const Vec3 along_x = jet.project(q + Vec3(h, 0, 0)) - jet.project(q - Vec3(h, 0, 0));
    const Vec3 along_y = jet.project(q + Vec3(0, h, 0)) - jet.project(q - Vec3(0, h, 0));
    const Vec3 n = jet.normal(q);
    EXPECT_NEAR(n.norm(), 1.0, 1e-14);
    EXPECT_LT((n - along_x.cross(along_y).normalized()).norm(), 1e-8);
    EXPECT_LT((n - (Vec3(0, 0, 10) - jet.project(q)) / 10.0).norm(), 1e-3) << "towards the centre, which lies above";
  }
}

TEST(JetFit, ProjectsAlongTheDirectionOfItsHeightsAndNoFurther) {
  const Jet jet = fit(cloud(saddle, 3.0, 60, 7), 3, 2.0).jet;
  for (const Vec3& q : {Vec3(1, 1, 5), Vec3(-2, 0.5, -3)}) {
    const Vec3 p = jet.project(q);
    EXPECT_LT((p - q).head<2>().norm(), 1e-14);
    EXPECT_NEAR(p[2], saddle(q[0], q[1]), 1e-12);
    EXPECT_LT((jet.project(p) - p).norm(), 1e-14);
  }
}

/// With more falloff the fit follows the near points and lets go of the far ones.
TEST(JetFit, FalloffDrawsTheFitToTheOrigin) {
  const std::vector<Vec3> points = cloud(sphere, 7.0, 200, 8);
  const auto near_error = [&](double falloff) {
    const Jet jet = fit(points, 2, falloff).jet;
    double worst = 0.0;
    for (const Vec3& p : points)
      if (p.head<2>().norm() < 2.0) worst = std::max(worst, (jet.project(p) - p).norm());
    return worst;
  };
  EXPECT_LT(near_error(3.0), 0.7 * near_error(0.0));
  EXPECT_LT(near_error(12.0), 0.5 * near_error(3.0));
}

TEST(JetFit, ResidualIsTheNoise) {
  double mean = 0.0;
  constexpr int kTrials = 60;
  for (int k = 0; k < kTrials; ++k) {
    std::vector<Vec3> points = cloud(saddle, 3.0, 60, 100 + static_cast<std::uint64_t>(k));
    Random random(200 + static_cast<std::uint64_t>(k));
    for (Vec3& p : points) p[2] += 1e-3 * random.normal();
    const double residual = fit(points, 4, 0.0).residual;
    mean += residual * residual / kTrials;
  }
  EXPECT_NEAR(std::sqrt(mean), 1e-3, 0.05e-3);
}

TEST(JetFit, TakesNoHigherDegreeThanAskedFor) {
  const std::vector<Vec3> points = cloud(sphere, 2.0, 60, 9);
  double before = 1e300;
  for (const int degree : {1, 2, 3, 4}) {
    const JetFit found = fit(points, degree, 0.0);
    EXPECT_EQ(found.degree, degree);
    const int terms = (degree + 1) * (degree + 2) / 2;
    for (int k = terms; k < Jet::kTerms; ++k) EXPECT_EQ(found.jet.c[static_cast<std::size_t>(k)], 0.0);
    EXPECT_LE(found.residual, before);
    before = found.residual;
  }
}

TEST(JetFit, IsAPlaneThroughTheOriginWhereThePointsSayNothing) {
  JetWorkspace workspace;
  const Vec3 origin(1, 2, 3), normal = Vec3(1, 1, 1).normalized();
  for (const std::vector<Vec3>& points :
       {std::vector<Vec3>{}, std::vector<Vec3>{origin}, std::vector<Vec3>(30, origin)}) {
    const JetFit found = fit_jet(points, origin, normal, 4, 2.0, workspace);
    EXPECT_EQ(found.degree, 0);
    EXPECT_NEAR((found.jet.project(Vec3(4, -5, 6)) - origin).dot(normal), 0.0, 1e-13);
    EXPECT_LT((found.jet.normal(Vec3(4, -5, 6)) - normal).norm(), 1e-14);
    EXPECT_LT((found.jet.frame.transpose() * found.jet.frame - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(found.jet.frame.determinant(), 1.0, 1e-14);
  }
  std::vector<Vec3> line;
  for (int k = 0; k < 40; ++k) line.emplace_back(0.1 * k, 0.2 * k, 0.0);
  const JetFit found = fit_jet(line, line[0], Vec3::UnitZ(), 4, 0.0, workspace);
  for (const Vec3& p : line) EXPECT_LT((found.jet.project(p) - p).norm(), 1e-9);
  for (const double c : found.jet.c) EXPECT_TRUE(std::isfinite(c));
}

}  // namespace
}  // namespace flank::internal
