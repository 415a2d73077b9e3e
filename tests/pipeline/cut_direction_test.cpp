#include "flank/pipeline/cut_direction.h"

#include <gtest/gtest.h>

#include "flank/bspline_surface.h"
#include "flank/setup/targets.h"
#include "flank/target.h"

namespace flank::internal {
namespace {

/// The plane y = 0, machined from y > 0.
TargetGroup wall() {
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid({{0, 0, 0}, {0, 0, 20}, {50, 0, 0}, {50, 0, 20}}, {0.0, 1.0}, {0.0, 1.0}, 1);
  TargetGroup group;
  group.faces = "F1";
  const SurfaceJet jet = face.surface.jet(0.5, 0.5);
  face.reversed = jet.du.cross(jet.dv).y() < 0.0;
  group.target = make_target(std::vector<Face>{face});
  return group;
}

/// Along x beside it, upright.
RuledMotion along(double from, double to) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 10; ++k) {
    t.push_back(0.1 * k);
    poses.push_back({Vec3(from + 0.1 * k * (to - from), 4.0, 2.0), Vec3::UnitZ()});
  }
  return fit_motion(poses, t, 15.0, 5);
}

// Material to the right of the feed is climb milling with a spindle that turns clockwise seen from the holder (as with G41). The wall
// is at y < 0: to the right of +x.
TEST(CutDirection, IsClimbWithTheMaterialToTheRight) {
  const TargetGroup group = wall();
  EXPECT_NEAR(climb_share(along(5.0, 45.0), *group.target), 1.0, 1e-6);
  EXPECT_NEAR(climb_share(along(45.0, 5.0), *group.target), -1.0, 1e-6);
}

TEST(CutDirection, IsThatOfEveryMotion) {
  const TargetGroup group = wall();
  for (const char* cut : {"climb", "conventional"}) {
    std::vector<RuledMotion> motions{along(5.0, 20.0), along(45.0, 20.0)};
    std::vector<const TargetGroup*> groups{&group, &group};
    run_as(cut, motions, groups);
    for (const RuledMotion& motion : motions)
      EXPECT_NEAR(climb_share(motion, *group.target), std::string(cut) == "climb" ? 1.0 : -1.0, 1e-6) << cut;
  }
}

TEST(CutDirection, KeepsMotionsJoinedThatAre) {
  const TargetGroup group = wall();
  std::vector<RuledMotion> motions{along(5.0, 20.0), along(20.0, 45.0)};
  std::vector<const TargetGroup*> groups{&group, &group};
  run_as("conventional", motions, groups);
  EXPECT_LT((motions[0].pose(0.0).tip - Vec3(45.0, 4.0, 2.0)).norm(), 1e-6);
  EXPECT_LT((motions[0].pose(1.0).tip - motions[1].pose(0.0).tip).norm(), 1e-9);
  EXPECT_LT((motions[1].pose(1.0).tip - Vec3(5.0, 4.0, 2.0)).norm(), 1e-6);
}

}  // namespace
}  // namespace flank::internal
