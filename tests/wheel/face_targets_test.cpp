// Faces as targets, as they are and turned about an axis.
#include "flank/wheel/face_targets.h"

#include <gtest/gtest.h>

#include <numbers>

namespace flank::internal {
namespace {

/// z = 0, from (10, 0) to (14, 2), its normal up.
Part one_plane() {
  Face face;
  face.id = "F1";
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0.0, 0.0, 1.0, 1.0};
  s.poles = {Vec3(10.0, 0.0, 0.0), Vec3(10.0, 2.0, 0.0), Vec3(14.0, 0.0, 0.0), Vec3(14.0, 2.0, 0.0)};
  Part part;
  part.faces = {face};
  return part;
}

TEST(FaceTargets, AreTurnedAboutTheAxisAndMadeOnce) {
  const Part part = one_plane();
  FaceTargets targets(part);
  const WheelAxis axis;
  const Vec3 p(12.0, 1.0, 3.0);
  const double pitch = 0.5 * std::numbers::pi;
  const Target* here = targets.of({"F1"}).front();
  const Target* turned = targets.turned({"F1"}, axis, pitch, -1).front();
  EXPECT_LT((here->closest(p).point - Vec3(12.0, 1.0, 0.0)).norm(), 1e-9);
  const Eigen::Isometry3d turn = axis.turn(-pitch);
  EXPECT_LT((turned->closest(turn * p).point - turn * Vec3(12.0, 1.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(turned->closest(turn * p).distance, 3.0, 1e-9);
  EXPECT_EQ(targets.turned({"F1"}, axis, pitch, -1).front(), turned);
  EXPECT_EQ(targets.turned({"F1"}, axis, pitch, 0).front(), here);
}

}  // namespace
}  // namespace flank::internal
