#include "flank/seed/guide_start.h"
#include "flank/seed/guide_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "flank/error.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

using testing::barrel_target;
using testing::bent_motion;
using testing::ExactTarget;

std::string message(const std::string& text) {
  try {
    (void)parse_guide("guide.txt", text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(GuideStart, ReadsLinesWithComments) {
  const auto lines =
      parse_guide("guide.txt", "# tip, holder end\n\n0,0,0, 0,0,10\n 5 0 0 5 0 10 # second\r\n10 0 0 10 1 10");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1].tip, Vec3(5, 0, 0));
  EXPECT_EQ(lines[2].holder, Vec3(10, 1, 10));
}

TEST(GuideStart, NamesFileAndLine) {
  EXPECT_NE(message("0 0 0 0 0 1\n1 2 3 4 5\n").find("guide.txt, line 2"), std::string::npos);
  EXPECT_NE(message("# a\n0 0 0 0 0 z\n").find("guide.txt, line 2: 'z'"), std::string::npos);
  EXPECT_NE(message("0 0 0 0 0 1\n").find("at least two"), std::string::npos);
  EXPECT_NE(message("").find("guide.txt"), std::string::npos);
  EXPECT_THROW((void)read_guide("no-such-file.txt"), InputError);
  EXPECT_THROW((void)read_guide("."), InputError);
}

TEST(GuideStart, ReadsAFile) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "flank_guide_start_test.txt";
  std::ofstream(file) << "0 0 0 0 0 10\n5 0 0 5 0 10\n";
  EXPECT_EQ(read_guide(file.string()).size(), 2u);
  std::ofstream(file, std::ios::trunc).close();
  EXPECT_THROW((void)read_guide(file.string()), InputError);
  std::filesystem::remove(file);
}

TEST(GuideStart, RefusesAGuideWithoutExtentOrDirection) {
  const auto same = parse_guide("g", "0 0 0 0 0 10\n0 0 0 0 0 10\n");
  EXPECT_THROW((void)start_from_guide("g", same, {}), InputError);
  const auto flipped = parse_guide("g", "0 0 0 0 0 10\n5 0 10 5 0 0\n");
  EXPECT_THROW((void)start_from_guide("g", flipped, {}), InputError);
}

TEST(GuideStart, TwoParallelLinesGiveAStraightSweep) {
  const auto lines = parse_guide("g", "0 0 0 0 0 10\n30 0 0 30 0 10\n");
  const GuideStart start = start_from_guide("g", lines, {});
  EXPECT_NEAR(start.motion.axis_length, 10.0, 1e-9);
  EXPECT_NEAR(start.largest_stretch_mm, 0.0, 1e-9);
  EXPECT_LT((start.motion.pose(0.5).tip - Vec3(15, 0, 0)).norm(), 1e-6);
  EXPECT_LT((start.motion.pose(0.2).axis - Vec3::UnitZ()).norm(), 1e-9);
}

TEST(GuideStart, ControlPolygonsOfAMotionGiveThatMotion) {
  // The guide of a bent motion: its two rails are cubics whose control points are the ends of the lines.
  const RuledMotion truth = bent_motion(40.0);
  std::vector<AxisLine> lines(4);
  for (int i = 0; i < 4; ++i) {
    lines[static_cast<std::size_t>(i)].tip = truth.tip.poles.col(i);
    lines[static_cast<std::size_t>(i)].holder = truth.tip.poles.col(i) + 40.0 * truth.direction.poles.col(i);
  }
  const GuideStart start = start_from_guide("g", lines, 40.0);
  EXPECT_EQ(start.motion.axis_length, 40.0);
  for (int i = 0; i <= 20; ++i) {
    const Pose pose = start.motion.pose(i / 20.0);
    double best = 1e300;
    for (int k = 0; k <= 4000; ++k) {
      const Pose other = truth.pose(k / 4000.0);
      best = std::min(best, (pose.tip - other.tip).norm() + 40.0 * (pose.axis - other.axis).norm());
    }
    EXPECT_LT(best, 0.02);
  }
}

TEST(GuideStart, TellsItsSideOfTheTarget) {
  const ExactTarget exact = barrel_target();
  const std::unique_ptr<Target> other = make_target({exact.face}, -1);
  EXPECT_EQ(side_of_motion(*exact.target, exact.motion), 1);
  EXPECT_EQ(side_of_motion(*other, exact.motion), -1);
}

}  // namespace
}  // namespace flank::internal
