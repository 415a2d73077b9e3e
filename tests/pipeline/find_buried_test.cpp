// Strips inside a solid, a closed mesh or a fixture, and on the wrong side of a sheet, fail the verdict.
#include "flank/pipeline/judge/find_buried.h"

#include <gtest/gtest.h>

#include "flank/pipeline/judge/judge_job.h"
#include "flank/results/acceptance.h"
#include "flank/verify/sample_face.h"
#include "obstacle/obstacle_scene.h"
#include "verify/buried_scene.h"

namespace flank::internal {
namespace {

using testing::along;
using testing::cylinder;
using testing::kRadius;

const Vec3 kLow(0, -20, 0), kHigh(40, 0, 20);

/// A block whose face F1 is y = 0; normals outwards.
Part block() {
  Part part;
  part.box.add(kLow);
  part.box.add(kHigh);
  const auto corner = [](int x, int y, int z) {
    return Vec3(x ? kHigh.x() : kLow.x(), y ? kHigh.y() : kLow.y(), z ? kHigh.z() : kLow.z());
  };
  // p00, p10, p01, p11 with (p10 - p00) x (p01 - p00) outwards.
  const std::vector<std::array<Vec3, 4>> quads = {{corner(1, 1, 0), corner(0, 1, 0), corner(1, 1, 1), corner(0, 1, 1)},
                                                  {corner(0, 0, 0), corner(1, 0, 0), corner(0, 0, 1), corner(1, 0, 1)},
                                                  {corner(0, 1, 0), corner(0, 0, 0), corner(0, 1, 1), corner(0, 0, 1)},
                                                  {corner(1, 0, 0), corner(1, 1, 0), corner(1, 0, 1), corner(1, 1, 1)},
                                                  {corner(0, 0, 1), corner(1, 0, 1), corner(0, 1, 1), corner(1, 1, 1)},
                                                  {corner(0, 1, 0), corner(1, 1, 0), corner(0, 0, 0), corner(1, 0, 0)}};
  for (const auto& [a, b, c, d] : quads) {
    part.faces.push_back(testing::quad(a, b, c, d, "F" + std::to_string(part.faces.size() + 1)));
    part.faces.back().of_solid = true;
    part.faces.back().solid = 0;
  }
  part.solids = 1;
  return part;
}

internal::Setup setup_of(Part part) {
  internal::Setup setup;
  setup.targets = {0};
  for (int k = 1; k < part.face_count(); ++k) setup.checks.push_back(k);
  setup.part = std::move(part);
  return setup;
}

Acceptance judged(const internal::Setup& setup, const Path& path) {
  const VerifyReport report = judge_job(setup, {}, cylinder(), path);
  return accept(cylinder(), report, {.least_coverage = 0.0, .sample_mm = {}, .reach_radius_mm = {}});
}

TEST(FindBuried, AToolThatTouchesTheTargetFromWithinDoesNotPass) {
  const internal::Setup setup = setup_of(block());
  EXPECT_TRUE(judged(setup, {{along(kRadius)}}).pass());
  const Acceptance inside = judged(setup, {{along(kRadius), along(-kRadius)}});
  ASSERT_EQ(inside.reasons.size(), 1u);
  EXPECT_EQ(inside.reasons.front().figure, "buried");
  EXPECT_NE(inside.reasons.front().text.find("pass 2 runs inside the material"), std::string::npos)
      << inside.reasons.front().text;
}

TEST(FindBuried, ASolidWithAFaceThatIsNotJudgedMayBeEntered) {
  internal::Setup setup = setup_of(block());
  setup.checks.pop_back();
  const Path path{{along(-kRadius)}};
  EXPECT_TRUE(find_buried(setup, cylinder(), path, {}).empty());
}

TEST(FindBuried, InAFixtureToo) {
  Part sheet;
  sheet.faces.push_back(testing::quad(Vec3(0, 50, 0), Vec3(40, 50, 0), Vec3(0, 50, 20), Vec3(40, 50, 20), "F1"));
  sheet.box.add(Vec3(0, 50, 0));
  sheet.box.add(Vec3(40, 50, 20));
  internal::Setup setup = setup_of(std::move(sheet));
  setup.fixtures.push_back(block());
  EXPECT_TRUE(find_buried(setup, cylinder(), {{along(kRadius)}}, {}).empty());
  ASSERT_EQ(find_buried(setup, cylinder(), {{along(-10.0)}}, {}).size(), 1u);
}

TEST(FindBuried, BehindASheet) {
  Part sheet;
  sheet.faces.push_back(block().faces.front());
  sheet.faces.front().of_solid = false;
  sheet.faces.front().solid = -1;
  sheet.box.add(Vec3(kLow.x(), 0, kLow.z()));
  sheet.box.add(kHigh);
  internal::Setup setup = setup_of(std::move(sheet));
  EXPECT_TRUE(judged(setup, {{along(kRadius)}}).pass());
  EXPECT_FALSE(judged(setup, {{along(-kRadius)}}).pass()) << "its normal points to the machined side";
  EXPECT_FALSE(judged(setup, {{along(kRadius), along(-kRadius)}}).pass()) << "both sides";
  setup.part.faces.front().reversed = !setup.part.faces.front().reversed;
  EXPECT_TRUE(judged(setup, {{along(-kRadius)}}).pass());
}

}  // namespace
}  // namespace flank::internal
