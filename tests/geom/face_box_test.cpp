#include "flank/geom/face_box.h"

#include <gtest/gtest.h>

#include "flank/geom/tessellate.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

/// A paraboloid over [0, 10]^2, of which the loop takes [u0, u1] x [v0, v1].
Face bowl(double u0, double u1, double v0, double v1) {
  Face face;
  face.id = "F1";
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 2;
  s.knots_u = s.knots_v = {0, 0, 0, 10, 10, 10};
  s.count_u = s.count_v = 3;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s.poles.emplace_back(5.0 * i, 5.0 * j, (i == 2 ? 10.0 : 0.0) + (j == 2 ? 10.0 : 0.0));
  face.loops = {rectangle_loop({u0, u1, v0, v1})};
  return face;
}

TEST(FaceBox, IsThatOfTheTrimmedPart) {
  const Face face = bowl(2.0, 3.0, 4.0, 6.0);
  const Box3 box = box_of(face);
  EXPECT_NEAR(box.low.x(), 2.0, 1e-4);
  EXPECT_NEAR(box.high.x(), 3.0, 1e-4);
  EXPECT_NEAR(box.low.y(), 4.0, 1e-4);
  EXPECT_NEAR(box.high.y(), 6.0, 1e-4);
  EXPECT_LT(box.high.z(), 6.0) << "the whole surface rises to 20";
}

TEST(FaceBox, HoldsEveryPlaceOfTheFace) {
  for (const auto& [u0, u1, v0, v1] : std::vector<std::array<double, 4>>{
           {2.0, 3.0, 4.0, 6.0}, {0.0, 10.0, 0.0, 10.0}, {0.0, 0.001, 9.9, 10.0}, {-1.0, 5.0, 5.0, 12.0}}) {
    const Face face = bowl(u0, u1, v0, v1);
    const Box3 box = box_of(face);
    for (const Vec3& p : tessellate(face, {.chord_mm = 0.01}).mesh.vertices) EXPECT_LT(box.squared_distance(p), 1e-12);
  }
}

TEST(FaceBox, WithoutTrimsIsThatOfAllControlPoints) {
  Face face = bowl(0, 10, 0, 10);
  face.loops.clear();
  EXPECT_EQ(box_of(face).high, Vec3(10, 10, 20));
}

TEST(FaceBox, BoxesAreNearWhereAllSidesAre) {
  Box3 a, b;
  a.add(Vec3::Zero());
  a.add(Vec3::Ones());
  b.add(Vec3(1.5, 0, 0));
  EXPECT_FALSE(near(a, b));
  EXPECT_TRUE(near(a, b, 0.5));
  EXPECT_FALSE(near(a, b, 0.4));
}

}  // namespace
}  // namespace flank::internal
