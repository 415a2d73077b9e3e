// Skins that close round material or air are told from those that do not close.
#include "flank/feature/hollow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kNearMm = 0.05;

/// A strip of a bent tube of radius r, from one angle to another: it leans with its height. `side` 1: its normals look outwards.
WheelFace tube(double r, double from, double to, double side) {
  constexpr int kRound = 48, kHigh = 24;
  WheelFace out;
  const auto point = [&](double i, double j) {
    const double a = from + (to - from) * i / kRound, z = 30.0 * j / kHigh;
    return Vec3(r * std::cos(a) + 0.01 * z * z, r * std::sin(a), z);
  };
  for (int j = 0; j <= kHigh; ++j)
    for (int i = 0; i <= kRound; ++i) out.mesh.vertices.push_back(point(i, j));
  const auto at = [](int i, int j) { return j * (kRound + 1) + i; };
  for (int j = 0; j < kHigh; ++j)
    for (int i = 0; i < kRound; ++i)
      for (const std::array<int, 3>& t : {std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                          std::array{at(i, j), at(i + 1, j + 1), at(i, j + 1)}}) {
        out.mesh.triangles.push_back(side > 0.0 ? t : std::array{t[0], t[2], t[1]});
        const auto& v = out.mesh.vertices;
        const Vec3 &a = v[static_cast<std::size_t>(t[0])], &b = v[static_cast<std::size_t>(t[1])],
                   &c = v[static_cast<std::size_t>(t[2])];
        const Vec3 cross = side * (b - a).cross(c - a);
        out.samples.push_back({(a + b + c) / 3.0, cross.normalized(), 0.5 * cross.norm()});
      }
  for (int j = 0; j <= kHigh; ++j) out.border.push_back(point(0, j)), out.border.push_back(point(kRound, j));
  for (int i = 0; i <= kRound; ++i) out.border.push_back(point(i, 0)), out.border.push_back(point(i, kHigh));
  out.box = out.mesh.box();
  out.tree = TriangleBvh(out.mesh);
  return out;
}

constexpr double kPi = std::numbers::pi;

TEST(HollowFaces, ASkinClosesRoundMaterialAndABoreRoundAir) {
  const WheelFace skin = tube(3.0, 0.0, 2.0 * kPi, 1.0), bore = tube(2.8, 0.0, 2.0 * kPi, -1.0),
                  half = tube(3.0, 0.0, kPi, 1.0);
  EXPECT_EQ(closing({&skin}, kNearMm), Closing::kRound);
  EXPECT_EQ(closing({&bore}, kNearMm), Closing::kHollow);
  EXPECT_EQ(closing({&half}, kNearMm), Closing::kOpen);
  EXPECT_NEAR(girth({&skin}, Girth::kOfMaterial, kNearMm), 6.0, 0.3);
  EXPECT_NEAR(girth({&bore}, Girth::kOfAir, kNearMm), 5.6, 0.3);
}

TEST(HollowFaces, ABoreOfTwoHalvesIsFoundBesideItsSkin) {
  const WheelFace skin = tube(3.0, 0.0, 2.0 * kPi, 1.0), one = tube(2.0, 0.0, kPi, -1.0),
                  other = tube(2.0, kPi, 2.0 * kPi, -1.0);
  const std::vector<const WheelFace*> found = hollow_faces({&one, &skin, &other}, kNearMm);
  EXPECT_EQ(found, (std::vector<const WheelFace*>{&one, &other}));
  EXPECT_TRUE(hollow_faces({&skin, &one}, kNearMm).empty()) << "half a bore is a groove";
}

}  // namespace
}  // namespace flank::internal
