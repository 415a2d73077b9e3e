// Several faces that are not connected, with one tool.
#include "flank/pipeline/search/group_fit.h"

#include <gtest/gtest.h>

#include "flank/fit/rank.h"
#include "sanitized.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

constexpr double kTolerance = 0.05;

/// A plate's two sides, 8 mm apart, and a narrow face beside them.
std::vector<TargetGroup> plate(bool with_edge) {
  std::vector<Face> faces = {test::plane_face("F1", 60.0, 30.0), test::plane_face("F2", 60.0, 30.0, 8.0)};
  faces.front().reversed = true;
  if (with_edge) faces.push_back(test::plane_face("F3", 60.0, 2.0, 40.0));
  std::vector<TargetGroup> groups;
  for (const Face& face : faces) {
    TargetGroup& group = groups.emplace_back();
    group.faces = face.id;
    group.target = make_target({face});
  }
  return groups;
}

FlankFitOptions options() {
  FlankFitOptions options;
  options.tolerance_mm = kTolerance;
  options.bounds = {2.0, 8.0, 0.5};
  options.sample_share = 1.0 / 15.0;
  options.polished_candidates = options.finalists = 1;
  options.enough_coverage = 0.99;
  return options;
}

using Groups = std::vector<std::size_t>;

TEST(GroupFit, TwoSidesGetOneStripEachOfOneTool) {
  const std::vector<TargetGroup> groups = plate(false);
  const GroupFits fits = fit_groups(groups, {}, options(), {.strips = 0, .wanted = {0.98, 0.98}}, {});
  EXPECT_EQ(fits.group_of_motion, (Groups{0, 1}));
  EXPECT_TRUE(meets(fits.fit.after, 0.98, options())) << fits.fit.message;
  for (const RuledMotion& motion : fits.fit.motions) EXPECT_EQ(motion.axis_length, fits.fit.tool.axis_length());
}

TEST(GroupFit, ASmallFaceTakesTheToolOfTheLargeOnes) {
  if (kSanitized) GTEST_SKIP() << "two more searches of the kind that is made beside it";
  const auto large = fit_groups(plate(false), {}, options(), {.strips = 0, .wanted = {0.98, 0.98}}, {});
  const GroupFits all = fit_groups(plate(true), {}, options(), {.strips = 0, .wanted = {0.98, 0.98, 0.98}}, {});
  EXPECT_EQ(all.group_of_motion, (Groups{0, 1, 2}));
  EXPECT_EQ(all.fit.tool.parameters(), large.fit.tool.parameters());
  EXPECT_TRUE(meets(all.fit.after, 0.98, options())) << all.fit.message;
}

TEST(GroupFit, AStopKeepsTheFirstFace) {
  Progress progress;
  progress.cancelled = [] { return true; };
  const GroupFits fits = fit_groups(plate(false), {}, options(), {.strips = 0, .wanted = {0.98, 0.98}}, progress);
  EXPECT_EQ(fits.group_of_motion, Groups(fits.fit.motions.size(), 0));
}

}  // namespace
}  // namespace flank::internal
