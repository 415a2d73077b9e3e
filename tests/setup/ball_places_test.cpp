// No triangle that a ball on a target could enter is left out, and most of those that it could not are.
#include "flank/setup/ball_places.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "flank/geom/triangle_bvh.h"

namespace flank::internal {
namespace {

constexpr double kRadius = 0.25, kSpacing = 0.5, kSide = 20.0;

/// A target of 20 x 20 mm in z = 0, its samples half a millimetre apart.
std::vector<FaceSamples> samples() {
  FaceSamples face;
  face.face = "F1", face.target = true, face.spacing_mm = kSpacing;
  for (double x = 0.0; x <= kSide; x += kSpacing)
    for (double y = 0.0; y <= kSide; y += kSpacing) face.points.emplace_back(x, y, 0.0);
  FaceSamples check = face;
  check.target = false;
  for (Vec3& p : check.points) p.z() = 30.0;
  return {face, check};
}

/// A wall that stands on the target in y = 10, up to 40 mm, in squares of half a millimetre.
TriangleMesh wall() {
  TriangleMesh out;
  constexpr int kColumns = 41, kRows = 81;
  for (int i = 0; i < kColumns; ++i)
    for (int k = 0; k < kRows; ++k) out.vertices.emplace_back(0.5 * i, 10.0, 0.5 * k);
  for (int i = 0; i + 1 < kColumns; ++i)
    for (int k = 0; k + 1 < kRows; ++k) {
      const int at = i * kRows + k;
      out.triangles.push_back({at, at + kRows, at + 1});
      out.triangles.push_back({at + 1, at + kRows, at + kRows + 1});
    }
  return out;
}

TEST(BallPlaces, HoldEverythingThatABallCouldEnterAndLittleElse) {
  const TriangleMesh whole = wall(), near = near_part(whole, BallPlaces(samples(), kRadius));
  EXPECT_LT(near.triangles.size(), whole.triangles.size() / 6);
  const TriangleBvh all(whole), part(near);
  for (double x = 0.1; x < kSide; x += 0.37)
    for (double y = 0.1; y < kSide; y += 0.37) {
      const Vec3 center(x, y, kRadius);
      const double before = (all.closest(center).point - center).norm();
      if (before > kRadius) continue;
      EXPECT_EQ((part.closest(center).point - center).norm(), before) << center.transpose();
    }
}

TEST(BallPlaces, AreThoseOfTargetsAlone) {
  std::vector<FaceSamples> faces = samples();
  EXPECT_TRUE(BallPlaces(faces, kRadius).meet({Vec3(1.0, 1.0, 0.1), Vec3(1.1, 1.1, 0.2)}));
  EXPECT_FALSE(BallPlaces(faces, kRadius).meet({Vec3(1.0, 1.0, 29.9), Vec3(1.1, 1.1, 30.1)}));
  // A box that is larger than all places together.
  EXPECT_TRUE(BallPlaces(faces, kRadius).meet({Vec3::Constant(-1e4), Vec3::Constant(1e4)}));
  EXPECT_FALSE(BallPlaces(faces, kRadius).meet({Vec3(-1e4, -1e4, 20.0), Vec3(1e4, 1e4, 1e4)}));
}

}  // namespace
}  // namespace flank::internal
