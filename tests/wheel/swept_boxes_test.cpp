// The boxes of a path hold every ball of its flank, between its poses, too.
#include "flank/wheel/swept_boxes.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

/// Forty poses along x, whose axis leans more and more.
Path fan() {
  Path path;
  Strip strip{.id = 1, .kind = "flank", .face = "F1", .poses = {}};
  for (int k = 0; k < 40; ++k) strip.poses.push_back({Vec3(0.7 * k, 0.0, 0.0), Vec3(0.0, 0.02 * k, 1.0).normalized()});
  path.strips = {strip};
  return path;
}

Box3 box_about(const Vec3& p, double half) {
  Box3 box;
  box.add(p - Vec3::Constant(half)), box.add(p + Vec3::Constant(half));
  return box;
}

TEST(SweptBoxes, HoldTheFlankBetweenPosesToo) {
  const RadialFunction radial(ToolFamily::kCone, 12.0, Eigen::Vector2d(1.0, 0.2));
  const Path path = fan();
  const SweptBoxes boxes(path, radial);
  const std::vector<Pose>& poses = path.strips.front().poses;
  for (std::size_t k = 0; k + 1 < poses.size(); ++k)
    for (const double t : {0.0, 0.3, 0.5, 0.9})
      for (double s = 0.0; s <= 12.0; s += 0.37) {
        const Pose pose{(1.0 - t) * poses[k].tip + t * poses[k + 1].tip,
                        ((1.0 - t) * poses[k].axis + t * poses[k + 1].axis).normalized()};
        for (const Vec3& way : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())})
          for (const double side : {-1.0, 1.0})
            EXPECT_TRUE(boxes.meet(box_about(pose.at(s) + side * radial.at(s).r * way, 0.0)));
      }
}

TEST(SweptBoxes, MeetNothingThatIsFarAway) {
  const RadialFunction radial(ToolFamily::kCone, 12.0, Eigen::Vector2d(1.0, 0.2));
  const SweptBoxes boxes(fan(), radial);
  EXPECT_FALSE(boxes.meet(box_about({10.0, -8.0, 5.0}, 1.0)));
  EXPECT_FALSE(boxes.meet(box_about({60.0, 0.0, 5.0}, 5.0)));
  // Beside the first poses, where the axis is upright: boxes are of a few poses each.
  EXPECT_FALSE(boxes.meet(box_about({1.0, 9.0, 9.0}, 1.0)));
  EXPECT_FALSE(SweptBoxes({}, radial).meet(box_about(Vec3::Zero(), 100.0)));
}

}  // namespace
}  // namespace flank::internal
