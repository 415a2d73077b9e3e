// Faces through a STEP file and back: which way they face, in which order they stand, and how large they are.
#include <gtest/gtest.h>

#include "io/cad_shapes.h"

namespace flank::internal {
namespace {

using testing_io::area_of;
using testing_io::through_step;

constexpr double kPi = std::numbers::pi;

Vec3 outward(const Face& face, double u, double v) {
  const BSplineSurface& s = face.surface;
  const SurfaceJet jet =
      s.jet(s.u_first() + u * (s.u_last() - s.u_first()), s.v_first() + v * (s.v_last() - s.v_first()));
  return (face.reversed ? -1.0 : 1.0) * jet.du.cross(jet.dv).normalized();
}

TEST(ReadFace, AreasAreThoseOfTheClosedForms) {
  const double deviation = 1e-3, r = 7.0;
  const Part part =
      through_step({testing_io::octant(r), testing_io::torus_patch(12.0, 3.0), testing_io::cone_patch(4.0, 9.0, 12.0),
                    test::quarter_cylinder("F4", 5.0, 12.0), test::plane_face("F5", 10.0, 4.0)});
  ASSERT_EQ(part.faces.size(), 5u);
  const double wanted[] = {0.5 * kPi * r * r, 0.5 * kPi * 3.0 * (12.0 * 0.5 * kPi + 3.0),
                           0.5 * kPi * 0.5 * (4.0 + 9.0) * 13.0, 0.5 * kPi * 5.0 * 12.0, 40.0};
  for (std::size_t k = 0; k < 5; ++k) {
    // A chord within d of an arc of radius r is shorter by d / (3 r) of it; two directions bend, and 3 is the least r.
    EXPECT_NEAR(area_of(part.faces[k], deviation), wanted[k], deviation / 3.0 * wanted[k]) << k;
    EXPECT_LE(area_of(part.faces[k], deviation), wanted[k] * (1.0 + 1e-3));
  }
}

TEST(ReadFace, FacesKeepTheirOrderAndAreNumberedFromOne) {
  std::vector<Face> faces;
  for (int k = 0; k < 12; ++k) faces.push_back(test::plane_face("anything", 10.0, 4.0, 3.0 * ((5 * k) % 12)));
  const Part part = through_step(faces);
  ASSERT_EQ(part.faces.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(part.faces[k].id, "F" + std::to_string(k + 1));
    EXPECT_NEAR(part.faces[k].surface.value(0.5, 0.5).y(), faces[k].surface.value(0.5, 0.5).y(), 1e-12);
    EXPECT_EQ(part.faces[k].solid, -1);
    EXPECT_FALSE(part.faces[k].of_solid);
  }
  EXPECT_EQ(part.solids, 0);
}

TEST(ReadFace, AReversedFaceStaysReversedWithAndWithoutTrims) {
  for (const bool trimmed : {false, true}) {
    Face forward = test::quarter_cylinder("F1", 5.0, 12.0), back = forward;
    back.reversed = true;
    if (trimmed) forward.loops = back.loops = {test::polygon({{0, 0}, {1, 0}, {0, 1}})};
    const Part part = through_step({forward, back});
    ASSERT_EQ(part.faces.size(), 2u);
    for (const double u : {0.1, 0.5, 0.9}) {
      ASSERT_EQ(part.faces[0].surface.u_last(), 1.0);
      const Vec3 p = part.faces[0].surface.value(u, 0.5);
      const Vec3 radial = Vec3(p.x(), p.y(), 0.0).normalized();
      EXPECT_NEAR(outward(part.faces[0], u, 0.5).dot(radial), 1.0, 1e-12) << trimmed;
      EXPECT_NEAR(outward(part.faces[1], u, 0.5).dot(radial), -1.0, 1e-12) << trimmed;
    }
    EXPECT_EQ(part.faces[0].loops.size(), trimmed ? 1u : 0u);
  }
}

TEST(ReadFace, FacesOfASolidPointAwayFromItsMaterial) {
  const Part part = read_part(testing_io::own_part("inch_cylinder.step"));
  const Vec3 middle = part.box.center();
  for (const Face& face : part.faces) {
    EXPECT_TRUE(face.of_solid);
    EXPECT_EQ(face.solid, 0);
    for (const double u : {0.13, 0.5, 0.87}) {
      const BSplineSurface& s = face.surface;
      const Vec3 p = s.value(s.u_first() + u * (s.u_last() - s.u_first()), 0.5 * (s.v_first() + s.v_last()));
      EXPECT_GT(outward(face, u, 0.5).dot(p - middle), 0.0) << face.id;
    }
  }
}

TEST(ReadFace, TheBoxOfAPartIsThatOfItsShapeAndNotOfItsControlPoints) {
  // The middle control point of a quarter circle of 5 lies 7.07 from the axis, the shape none.
  const Part part = through_step({test::quarter_cylinder("F1", 5.0, 12.0)});
  EXPECT_LT((part.box.low - Vec3(0, 0, 0)).norm(), 1e-2);
  EXPECT_LT((part.box.high - Vec3(5, 5, 12)).norm(), 1e-2);
}

}  // namespace
}  // namespace flank::internal
