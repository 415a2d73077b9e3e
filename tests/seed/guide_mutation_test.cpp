// Damaged guide files: a finite motion, or a refusal that names file and line.
#include <gtest/gtest.h>

#include <cmath>

#include "flank/seed/guide_file.h"
#include "flank/seed/guide_start.h"
#include "mutations.h"

namespace flank::internal {
namespace {

constexpr const char* kGuide =
    "# tip x y z, holder end x y z\n0.25, 0.5, 0, 0.25, 0.5, 40\n10 0.5 0.125 10 4.5 40.75 # second\n"
    "\n20;1;0;20;8.5;38\n30 1.5 -0.25 31 12 37\n40\t1.5\t-0.5\t42\t15\t35.5\n";

bool sound(const std::vector<AxisLine>& lines) {
  if (lines.size() < 2) return false;
  for (const AxisLine& line : lines)
    if (!line.tip.allFinite() || !line.holder.allFinite() || !line.pose().axis.allFinite()) return false;
  return true;
}

bool sound(const GuideStart& start) {
  if (!std::isfinite(start.mean_length_mm) || !std::isfinite(start.largest_stretch_mm)) return false;
  for (const double t : {0.0, 0.37, 1.0}) {
    const Pose pose = start.motion.pose(t);
    if (!pose.tip.allFinite() || !(std::abs(pose.axis.norm() - 1.0) < 1e-9)) return false;
  }
  return true;
}

TEST(GuideMutations, TheGoodGuideIsRead) {
  const std::vector<AxisLine> lines = parse_guide("g.txt", kGuide);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[1].holder, Vec3(10, 4.5, 40.75));
  EXPECT_TRUE(sound(start_from_guide("g.txt", lines, std::nullopt)));
}

TEST(GuideMutations, GuidesAreReadOrRefused) {
  const MutationCount count =
      mutate(kGuide, "g.txt", 1, [](const std::string& text) { return sound(parse_guide("g.txt", text)); });
  EXPECT_GT(count.read, kMutants / 10);
  EXPECT_GT(count.refused, kMutants / 10);
}

TEST(GuideMutations, StartsFromGuidesAreFiniteOrRefused) {
  const MutationCount count = mutate(kGuide, "g.txt", 2, [](const std::string& text) {
    return sound(start_from_guide("g.txt", parse_guide("g.txt", text), std::nullopt));
  });
  EXPECT_GT(count.read, kMutants / 10);
  EXPECT_GT(count.refused, kMutants / 10);
}

TEST(GuideMutations, LinesTooFarApartToBeMeasuredAreRefused) {
  for (const char* guide : {"0 0 0 0 0 10\n1e200 0 0 1e200 0 10\n", "0 0 0 0 0 1e200\n10 0 0 10 0 1e200\n",
                            "-1e308 0 0 0 0 10\n1e308 0 0 10 0 10\n"}) {
    try {
      (void)start_from_guide("g.txt", parse_guide("g.txt", guide), std::nullopt);
      ADD_FAILURE() << guide << " was accepted";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("g.txt"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace flank::internal
