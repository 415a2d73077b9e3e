// The tri-dexel stock: volumes and distances against closed forms.
#include "flank/verify/stock/dexel_stock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "flank/error.h"
#include "flank/verify/stock/stock_mesh.h"

namespace flank::internal::verify {
namespace {

constexpr double kPi = std::numbers::pi;

RadialFunction cylinder(double radius, double length) {
  return {ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius)};
}

Box3 box_of(const Vec3& low, const Vec3& high) {
  Box3 box;
  box.add(low);
  box.add(high);
  return box;
}

TEST(DexelStock, AWholeBlockHasItsVolume) {
  const DexelStock stock(box_of(Vec3::Zero(), {7.0, 5.0, 3.0}), {}, 0.1);
  EXPECT_NEAR(stock.volume(), 105.0, 1e-3);
  const DexelStock half(box_of(Vec3::Zero(), {7.0, 5.0, 3.0}),
                        {{Vec3(1.0, 1.0, 0.0).normalized(), 6.0 / std::sqrt(2.0)}}, 0.1);
  EXPECT_NEAR(half.volume(), 3.0 * (35.0 - 17.5), 0.3) << "the triangle beyond x + y = 6 is gone";
}

/// A ball of triangles whose corners lie on it.
TriangleMesh ball(const Vec3& centre, double radius, int around) {
  TriangleMesh mesh;
  const int rings = around / 2;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double up = kPi * i / rings, turn = 2.0 * kPi * k / around;
      mesh.vertices.emplace_back(
          centre + radius * Vec3(std::sin(up) * std::cos(turn), std::sin(up) * std::sin(turn), std::cos(up)));
    }
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const int a = i * around + k, b = i * around + (k + 1) % around, c = a + around, d = b + around;
      mesh.triangles.push_back({a, c, d}), mesh.triangles.push_back({a, d, b});
    }
  return mesh;
}

TEST(DexelStock, ABodyOfTrianglesHasItsVolume) {
  TriangleMesh body = ball({1.0, 2.0, 3.0}, 4.0, 96);
  const double volume = 4.0 / 3.0 * kPi * 64.0;
  const DexelStock stock(body, body.box(), 0.1);
  EXPECT_NEAR(stock.volume(), volume, 0.005 * volume);
  EXPECT_GT(stock.depth({1.0, 2.0, 3.0}), 0.0);
  EXPECT_NEAR(stock.depth({1.0, 2.0, 6.5}), 0.5, 0.02);
  // Inside out, and with another ball that overlaps it.
  for (auto& t : body.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(DexelStock(body, body.box(), 0.1).volume(), stock.volume(), 1e-6 * volume);
  const TriangleMesh more = ball({1.5, 2.0, 3.0}, 3.0, 96);
  TriangleMesh both = ball({1.0, 2.0, 3.0}, 4.0, 96);
  const int first = static_cast<int>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& t : more.triangles) both.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  EXPECT_NEAR(DexelStock(both, both.box(), 0.1).volume(), stock.volume(), 1e-6 * volume);
}

TEST(DexelStock, ABodyMayHaveCracksButNoHole) {
  TriangleMesh body = ball({0.0, 0.0, 0.0}, 4.0, 64);
  const double volume = DexelStock(body, body.box(), 0.1).volume();
  TriangleMesh cracked = body;
  cracked.triangles.erase(cracked.triangles.begin() + 1000);
  EXPECT_NEAR(DexelStock(cracked, cracked.box(), 0.1).volume(), volume, 0.01 * volume);
  body.triangles.resize(body.triangles.size() / 2);
  EXPECT_THROW((void)DexelStock(body, body.box(), 0.1), InputError);
}

TEST(DexelStock, ABlankHasItsVolumeWhereverItsPlanesLieBetweenLines) {
  // Planes along the lines of two directions, all of which are at one distance from them; one leans a little.
  for (const double off : {0.01, 0.2, 0.24, 0.26, 0.4, 0.49}) {
    for (const double lean : {0.0, 1e-4, 0.02}) {
      const std::vector<HalfSpace> planes = {{Vec3(1.0, 0.0, lean).normalized(), (5.0 + off) / std::hypot(1.0, lean)},
                                             {-Vec3::UnitX(), -off},
                                             {Vec3::UnitY(), 6.0 - off}};
      DexelStock stock(box_of({-1.0, 0.0, -4.0}, {7.0, 8.0, 4.0}), planes, 0.5);
      const double whole = 5.0 * (6.0 - off) * 8.0;
      EXPECT_NEAR(stock.volume() / whole, 1.0, 1e-3) << off << " " << lean;
      // A cutter that takes all of it.
      const double removed = stock.cut(ToolSolid(cylinder(20.0, 30.0), 1e-3), {Vec3(3.0, 4.0, -15.0), Vec3::UnitZ()});
      EXPECT_NEAR(removed / whole, 1.0, 1e-3) << off << " " << lean;
      EXPECT_NEAR(stock.volume(), 0.0, 1e-9);
    }
  }
}

TEST(DexelStock, ATiltedCapsuleTakesItsVolume) {
  const double radius = 3.0, length = 10.0;
  DexelStock stock(box_of(Vec3::Constant(-8.0), {8.0, 8.0, 18.0}), {}, 0.1);
  const double before = stock.volume();
  const double removed =
      stock.cut(ToolSolid(cylinder(radius, length), 1e-3), {Vec3(0.3, -0.2, 0.1), Vec3(0.2, 0.35, 1.0).normalized()});
  const double capsule = kPi * radius * radius * (length + 4.0 / 3.0 * radius);
  EXPECT_NEAR(removed / capsule, 1.0, 2e-3);
  EXPECT_NEAR(stock.volume(), before - removed, 1e-3);
  for (const double volume : stock.volumes()) EXPECT_NEAR((before - volume) / capsule, 1.0, 3e-3);
  EXPECT_EQ(
      stock.cut(ToolSolid(cylinder(radius, length), 1e-3), {Vec3(0.3, -0.2, 0.1), Vec3(0.2, 0.35, 1.0).normalized()}),
      0.0)
      << "nothing is there twice";
}

TEST(DexelStock, DepthIsTheDistanceToASmoothSurface) {
  const double radius = 4.0, cell = 0.1, chord = 1e-4;
  DexelStock stock(box_of(Vec3::Constant(-9.0), Vec3::Constant(9.0)), {}, cell);
  const Pose pose{Vec3(0.0, 0.0, -6.0), Vec3(0.1, 0.2, 1.0).normalized()};
  (void)stock.cut(ToolSolid(cylinder(radius, 12.0), chord), pose);
  // Lines that see the surface at a slope q of at most 2.5 measure. Along them it is the height f over a plane, with
  // f'' = (1 + q^2)^(3/2) / R, and a height counts as f / sqrt(1 + q^2):
  //   bilinear between lines a cell apart, in two directions: 2 f'' cell^2 / 8;
  //   the slope is that of the secant over a cell, so its angle is off by at most f'' cell / 2 / (1 + q^2), and the foot
  //   of the normal lies off q beside the line;
  //   the surface is taken as its tangent plane: (off q)^2 / (2 R).
  const auto bound = [&](double off) {
    constexpr double q = 2.5;
    const double between = (1.0 + q * q) / radius * cell * cell / 4.0;
    const double turned = off * q * std::sqrt(1.0 + q * q) / radius * cell / 2.0;
    return chord + between + turned + off * off * q * q / (2.0 * radius);
  };
  const Vec3 x = pose.axis.unitOrthogonal(), y = pose.axis.cross(x);
  for (int k = 0; k < 40; ++k) {
    const double angle = 0.157 * k;
    for (const double off : {-0.3, -0.05, 0.05, 0.3}) {
      const Vec3 at = pose.at(6.0) + (radius + off) * (std::cos(angle) * x + std::sin(angle) * y);
      EXPECT_NEAR(stock.depth(at), off, bound(std::abs(off))) << angle;
    }
  }
  EXPECT_LT(stock.depth({30.0, 0.0, 0.0}), 0.0);
  EXPECT_GT(stock.depth({8.0, 8.0, 0.0}), 0.0);
}

TEST(DexelStock, HoldsWhatHasADepth) {
  constexpr double kCell = 0.3;
  DexelStock stock(box_of(Vec3::Constant(-6.0), Vec3::Constant(6.0)), {}, kCell);
  const ToolSolid tool(cylinder(1.0, 20.0), 1e-3);
  // Ribs, so that lines have several stretches, and edges, where lines do not see the same.
  for (const double x : {-4.0, -1.8, 0.1, 2.6, 4.4})
    (void)stock.cut(tool, {Vec3(x, 0.4 * x, -10.0), Vec3(0.1, -0.2, 1.0).normalized()});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-6.8, 6.8);
  int held = 0, clear = 0, differ = 0;
  constexpr int kPlaces = 20000;
  for (int k = 0; k < kPlaces; ++k) {
    const Vec3 x(place(random), place(random), place(random)), across(place(random), place(random), place(random));
    const double depth = stock.depth(x);
    if (std::abs(depth) > kCell || std::isinf(depth)) {
      EXPECT_EQ(stock.holds(x, across), depth > 0.0) << x.transpose();
      ++clear;
    }
    held += stock.holds(x, across) ? 1 : 0;
    differ += stock.holds(x, across) != (depth > 0.0) ? 1 : 0;
  }
  EXPECT_GT(clear, kPlaces / 4);
  EXPECT_GT(held, kPlaces / 5);
  EXPECT_LT(held, kPlaces * 4 / 5);
  EXPECT_LT(differ, kPlaces / 50);  // at edges, and where the surface lies along the lines that are asked
}

TEST(DexelStock, HoldsTheSameWhereBlocksAreKnownToBeEmpty) {
  DexelStock stock(box_of(Vec3::Constant(-6.0), Vec3(6.0, 5.3, 7.1)), {}, 0.3);
  const ToolSolid tool(cylinder(2.5, 20.0), 1e-3);
  std::vector<EmptyBlocks> known = stock.empty_blocks();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-7.5, 7.5);
  int empty = 0;
  // A slot that grows leaves more and more blocks without material.
  for (double x = -5.0; x <= 5.0; x += 0.5) {
    (void)stock.cut(tool, {Vec3(x, 0.2 * x, -10.0), Vec3(0.1, -0.2, 1.0).normalized()});
    for (int k = 0; k < 4000; ++k) {
      const Vec3 at(place(random), place(random), place(random)), across(place(random), place(random), place(random));
      ASSERT_EQ(stock.holds(at, across, known), stock.holds(at, across)) << at.transpose();
    }
  }
  for (std::size_t axis = 0; axis < known.size(); ++axis)
    for (int k = 0; k < 1000; ++k) {
      const auto block = known[axis].block_at(Vec3(place(random), place(random), place(random)));
      empty += block && known[axis].is_empty(*block) ? 1 : 0;
    }
  EXPECT_GT(empty, 100);
}

TEST(DexelStock, LinesAcrossALayerSeeItHoweverThinItIs) {
  constexpr double kCell = 0.4, kThin = 0.05;
  DexelStock stock(box_of(Vec3(-6.0, -6.0, 0.0), Vec3(6.0, 6.0, 6.0)), {}, kCell);
  const ToolSolid tool(cylinder(2.0, 20.0), 1e-4);
  for (const double x : {-2.0 - 0.5 * kThin, 2.0 + 0.5 * kThin})
    for (double y = -6.0; y <= 6.0; y += 0.01) (void)stock.cut(tool, {Vec3(x, y, -7.0), Vec3::UnitZ()});
  for (const double y : {-3.1, 0.05, 1.7})
    for (const double z : {1.0, 3.3}) {
      EXPECT_TRUE(stock.holds({0.0, y, z}, Vec3::UnitX())) << y << ' ' << z;
      for (const double off : {-1.0, -0.6 * kThin, 0.6 * kThin, 1.0})
        EXPECT_FALSE(stock.holds({off, y, z}, Vec3::UnitX())) << off << ' ' << y << ' ' << z;
    }
}

TEST(DexelStock, ConcaveToolsLeaveWhatTheirWaistDoesNotReach) {
  // A waist of 2 mm in the middle of 20 mm, 12 mm above which the tool is thicker.
  const RadialFunction radial(ToolFamily::kHyperbolic, 20.0, Eigen::Vector3d(2.0, 0.0, 0.02));
  const ToolSolid solid(radial, 1e-3);
  const Pose pose;
  const ToolLine along = ToolSolid::line(pose, {2.6, 0.0, 0.0}, Vec3::UnitZ());
  LineCut within;
  ASSERT_TRUE(solid.reach(along, solid.largest(), within));
  const LineCuts cuts = solid.cut(along, within);
  ASSERT_EQ(cuts.count, 2) << "in at the lower end, out at the waist, in again";
  EXPECT_NEAR(cuts.cuts[0].high + cuts.cuts[1].low, 20.0, 0.01);
}

TEST(DexelStock, TheMeshOfWhatIsLeftIsClosedAndHasItsVolume) {
  DexelStock stock(box_of(Vec3::Zero(), {12.0, 10.0, 8.0}), {}, 0.2);
  (void)stock.cut(ToolSolid(cylinder(2.0, 20.0), 1e-3), {{6.0, 5.0, -6.0}, Vec3::UnitZ()});
  for (const int stride : {1, 2}) {
    const TriangleMesh mesh = stock_mesh(stock, stride);
    double volume = 0.0;
    Vec3 area = Vec3::Zero();
    for (const auto& t : mesh.triangles) {
      const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      volume += a.dot(b.cross(c)) / 6.0;
      area += (b - a).cross(c - a);
    }
    EXPECT_NEAR(volume / stock.volume(), 1.0, 0.02) << stride;
    EXPECT_LT(area.norm(), 1e-6) << "closed";
  }
  EXPECT_GE(stride_for(stock, 100.0), 4);
}

TEST(DexelStock, RefusesWhatIsNone) {
  EXPECT_THROW(DexelStock(box_of(Vec3::Zero(), Vec3::Ones()), {}, 0.0), UsageError);
  EXPECT_THROW(DexelStock(box_of(Vec3::Zero(), {1.0, 1.0, 0.0}), {}, 0.1), InputError);
  EXPECT_THROW(DexelStock(box_of(Vec3::Zero(), Vec3::Constant(1e6)), {}, 0.1), InputError);
}

}  // namespace
}  // namespace flank::internal::verify
