// Faces that are equal up to a rigid motion are found, others are not.
#include "flank/design/equal_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "flank/example/example_blades.h"
#include "flank/geom/face_cut.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

Eigen::Isometry3d some_motion() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()));
  motion.pretranslate(Vec3(10.0, -20.0, 30.0));
  return motion;
}

Face moved(Face face, const Eigen::Isometry3d& motion) {
  for (Vec3& pole : face.surface.poles) pole = motion * pole;
  return face;
}

/// The same points with both parameters exchanged: the normal of the parameters turns round.
Face exchanged(const Face& face) {
  Face other = face;
  BSplineSurface& s = other.surface;
  std::swap(s.degree_u, s.degree_v);
  std::swap(s.knots_u, s.knots_v);
  std::swap(s.count_u, s.count_v);
  for (int i = 0; i < s.count_u; ++i)
    for (int j = 0; j < s.count_v; ++j) s.pole(i, j) = face.surface.pole(j, i);
  other.reversed = !face.reversed;
  return other;
}

Face solid_blade() {
  Face face = twisted_blade();
  face.of_solid = true;
  return face;
}

TEST(EqualFaces, TheMotionIsFoundAlsoThroughOtherParameters) {
  const Face face = solid_blade();
  const Eigen::Isometry3d truth = some_motion();
  for (const Face& other : {moved(face, truth), exchanged(moved(face, truth))}) {
    const auto motion = motion_between(face, other, 1e-6);
    ASSERT_TRUE(motion.has_value());
    EXPECT_LT((motion->matrix() - truth.matrix()).norm(), 1e-9);
    EXPECT_GT(motion->linear().determinant(), 0.0);
  }
}

/// The same points with u run backwards, from another first parameter.
Face turned(const Face& face, double first) {
  Face other = face;
  BSplineSurface& s = other.surface;
  const double last = s.knots_u.back();
  for (double& k : s.knots_u) k = first + last - k;
  std::reverse(s.knots_u.begin(), s.knots_u.end());
  for (int i = 0; i < s.count_u; ++i)
    for (int j = 0; j < s.count_v; ++j) s.pole(i, j) = face.surface.pole(s.count_u - 1 - i, j);
  other.reversed = !face.reversed;
  return other;
}

// Kernels keep of a surface what lies in the box of a face's trims: neighbours have other boxes.
TEST(EqualFaces, AFaceThatIsCutALittleDifferentlyIsTheSame) {
  const Face face = solid_blade();
  const Eigen::Isometry3d truth = some_motion();
  const auto cut = [&](double u0, double u1, double v0, double v1) {
    Face part = face;
    part.surface = cut_surface(cut_surface(face.surface, true, u0, u1), false, v0, v1);
    return part;
  };
  const Face one = cut(0.0, 0.99, 0.015, 1.0), other = moved(cut(0.01, 1.0, 0.0, 0.985), truth);
  ASSERT_NE(one.surface.knots_u, other.surface.knots_u);
  for (const Face& to : {other, exchanged(other), turned(other, 7.0), turned(exchanged(other), -3.0)}) {
    const auto motion = motion_between(one, to, 1e-6);
    ASSERT_TRUE(motion.has_value());
    EXPECT_LT((motion->matrix() - truth.matrix()).norm(), 1e-7);
  }
  Face bumped = other;
  bumped.surface.poles[bumped.surface.poles.size() / 2] += Vec3(0.0, 0.05, 0.0);
  EXPECT_FALSE(motion_between(one, bumped, 0.01));
}

TEST(EqualFaces, OtherShapesOtherSidesAndMirrorImagesAreNotEqual) {
  const Face face = solid_blade();
  Face bumped = moved(face, some_motion());
  bumped.surface.poles[bumped.surface.poles.size() / 2] += Vec3(0.0, 0.02, 0.0);
  EXPECT_FALSE(motion_between(face, bumped, 0.01));
  EXPECT_TRUE(motion_between(face, bumped, 0.05));
  Face inside = face;
  inside.reversed = !inside.reversed;
  EXPECT_FALSE(motion_between(face, inside, 0.01));
  Face mirrored = face;
  for (Vec3& pole : mirrored.surface.poles) pole.x() = -pole.x();
  mirrored.reversed = !mirrored.reversed;
  EXPECT_FALSE(motion_between(face, mirrored, 0.01));
}

TEST(EqualFaces, HalfOfAFaceIsNotTheFace) {
  const Face face = solid_blade();
  Face half = face;
  const BSplineSurface& s = face.surface;
  const double u = 0.5 * (s.u_first() + s.u_last());
  TrimLoop loop;
  const Vec2 corners[] = {{s.u_first(), s.v_first()}, {u, s.v_first()}, {u, s.v_last()}, {s.u_first(), s.v_last()}};
  for (int k = 0; k < 4; ++k) {
    BSplineCurve2 edge;
    edge.degree = 1;
    edge.knots = {0.0, 0.0, 1.0, 1.0};
    edge.poles.resize(2, 2);
    edge.poles << corners[k], corners[(k + 1) % 4];
    loop.edges.push_back(edge);
  }
  half.loops = {loop};
  EXPECT_FALSE(motion_between(face, half, 0.01));
}

TEST(EqualFaces, NineBladesOfAWheelAreTwoFaces) {
  FLANK_REAL_PART(file, "kj66_impeller.step");
  const Part part = read_part(file);
  const std::vector<int> faces =
      parse_face_list(part, "F1,F3,F10,F12,F24,F26,F33,F35,F42,F44,F51,F53,F60,F62,F70,F72,F79,F81");
  // A blade moved a little along itself is almost the blade: a wide tolerance must not take it.
  for (const double tolerance : {0.005, 0.05}) {
    const std::vector<EqualFace> equal = equal_faces(part, faces, tolerance);
    for (std::size_t k = 0; k < equal.size(); ++k) {
      EXPECT_EQ(equal[k].first, k % 2) << k;
      // Blades stand 40 degrees apart.
      const Eigen::Isometry3d& motion = equal[k].from_first;
      const double turn = Eigen::AngleAxisd(motion.linear()).angle() * 180.0 / std::numbers::pi;
      EXPECT_NEAR(std::remainder(turn, 40.0), 0.0, 1e-3) << k << " " << tolerance;
      // Both sides of a blade have moved with it. They were found each by itself.
      if (k % 2 == 1) {
        EXPECT_LT((motion.matrix() - equal[k - 1].from_first.matrix()).norm(), 1e-5) << k << " " << tolerance;
      }
    }
  }
}

TEST(EqualFaces, CarriedStripsAreThoseOfTheFace) {
  Path path;
  path.strips = {{1, "flank", "F1", {{Vec3(1, 0, 0), Vec3::UnitX()}}},
                 {2, "flank", "F2", {{Vec3(2, 0, 0), Vec3::UnitX()}}},
                 {3, "flank", "F3,F1", {{Vec3(3, 0, 0), Vec3::UnitY()}}}};
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()));
  motion.pretranslate(Vec3(0, 0, 5));
  const Path moved = carried(path, "F1", "F9", motion);
  ASSERT_EQ(moved.strips.size(), 2u);
  EXPECT_EQ(moved.strips[1].id, 2);
  EXPECT_EQ(moved.strips[1].face, "F9");
  EXPECT_LT((moved.strips[0].poses[0].tip - Vec3(0, 1, 5)).norm(), 1e-12);
  EXPECT_LT((moved.strips[0].poses[0].axis - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_LT((moved.strips[1].poses[0].axis + Vec3::UnitX()).norm(), 1e-12);
}

}  // namespace
}  // namespace flank::internal
