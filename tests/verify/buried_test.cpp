// A tool that is inside the material from the beginning of its strip enters no face: it is told apart all the same.
#include "flank/verify/buried.h"

#include <gtest/gtest.h>

#include "verify/buried_scene.h"
#include "verify/faces.h"

namespace flank::internal::verify {
namespace {

using testing::along;
using testing::cylinder;
using testing::kRadius;

/// [0, 40] x [-20, 0] x [0, 20], outwards or inwards.
TriangleMesh block(bool outwards = true) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) mesh.vertices.emplace_back((k & 1) * 40.0, (k & 2) ? 0.0 : -20.0, (k & 4) ? 20.0 : 0.0);
  const std::vector<std::array<int, 4>> quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& [a, b, c, d] : quads) {
    mesh.triangles.push_back(outwards ? std::array{a, b, c} : std::array{a, c, b});
    mesh.triangles.push_back(outwards ? std::array{a, c, d} : std::array{a, d, c});
  }
  return mesh;
}

TEST(BuriedStrips, InsideASolidIsNotBesideIt) {
  // The first touches the face y = 0 from outside, the second from within: both at a distance of 0.
  const Path path{{along(kRadius), along(-kRadius)}};
  for (const bool outwards : {true, false}) {
    const std::vector<TriangleMesh> solids{block(outwards)};
    const std::vector<BuriedStrip> buried = strips_in_solids(solids, cylinder(), path);
    ASSERT_EQ(buried.size(), 1u);
    EXPECT_EQ(buried.front().strip, 1);
    EXPECT_LT((buried.front().point - Vec3(3.0, -kRadius, 10.0)).norm(), 1e-12);
  }
}

TEST(BuriedStrips, TouchTheTargetFromWithinAndOvercutNothing) {
  // What makes the check necessary: the judge alone finds nothing wrong.
  Face face = test::plane_face("F1", 40.0, 20.0);
  face.reversed = true;
  const FaceSamples samples = sample_face(face, 0.5, true);
  JudgeOptions options;
  options.tolerance_mm = 0.01;
  const VerifyReport report = judge(cylinder(), {{along(-kRadius)}}, {samples}, options);
  EXPECT_GT(report.coverage, 0.1);
  EXPECT_LT(report.overcut_mm, 1e-9);
}

TEST(BuriedStrips, TheOtherSideOfAThinBladeIsNotBehindIt) {
  // A sheet 0.2 mm behind the one that is machined: nearer than the radius, farther than the tolerance.
  Face face = test::plane_face("F1", 40.0, 20.0);
  const FaceSamples sheet = sample_face(face, 0.5, true);
  const double y = 0.2 + kRadius;
  const Path path{{along(y), along(-y)}};
  const SheetVotes votes = side_votes(SweptVolume(cylinder(), path), path, sheet, 0.01);
  EXPECT_TRUE(strips_behind({&votes, 1}).empty());
}

TEST(BuriedStrips, BehindASheetByItsOwnVotes) {
  Face face = test::plane_face("F1", 40.0, 20.0);
  face.reversed = true;
  const FaceSamples sheet = sample_face(face, 0.5, true);
  const double front = sheet.normals.front().y();
  ASSERT_NEAR(std::abs(front), 1.0, 1e-12);
  const Path path{{along(front * kRadius), along(-front * kRadius), along(30.0)}};
  const SheetVotes votes = side_votes(SweptVolume(cylinder(), path), path, sheet, 0.01);
  EXPECT_EQ(votes.strips[0].behind + votes.strips[1].in_front + votes.strips[2].in_front + votes.strips[2].behind, 0);
  const std::vector<BuriedStrip> behind = strips_behind({&votes, 1});
  ASSERT_EQ(behind.size(), 1u);
  EXPECT_EQ(behind.front().strip, 1);
  EXPECT_NEAR(behind.front().point.y(), 0.0, 1e-12);
}

TEST(BuriedStrips, AFlankThatEndsBeforeANarrowRimIsNotBehindIt) {
  // The rim is 0.2 mm wide. The tool goes along the side x = 0.2 up to 0.2 mm before it: some of the rim is within the tolerance.
  Face face = test::plane_face("F1", 0.2, 20.0);
  const FaceSamples sheet = sample_face(face, 0.02, true);
  const double front = sheet.normals.front().y();
  Strip strip;
  for (int k = 0; k <= 10; ++k)
    strip.poses.push_back({Vec3(0.2 + kRadius, front * (0.48 * k - 5.0), 6.0), Vec3::UnitZ()});
  const Path path{{strip}};
  const SheetVotes votes = side_votes(SweptVolume(cylinder(), path), path, sheet, 0.05);
  EXPECT_GT(votes.strips[0].behind, 0.04 * votes.asked);
  EXPECT_EQ(votes.strips[0].in_front, 0);
  EXPECT_TRUE(strips_behind({&votes, 1}).empty());
}

TEST(BuriedStrips, ANarrowEdgeBesideASideThatIsMachinedDoesNotDecide) {
  // Both lie in one plane, and look to opposite sides: where a flank runs out over an edge, it is beside it, or behind.
  const Face side = test::plane_face("F1", 40.0, 20.0);
  Face edge = test::plane_face("F2", 0.6, 20.0), wide = test::plane_face("F3", 8.0, 20.0);
  edge.reversed = wide.reversed = true;
  const FaceSamples seen = sample_face(side, 0.5, true);
  Strip strip;
  for (int k = 0; k <= 10; ++k)
    strip.poses.push_back({Vec3(4.0 * k, seen.normals.front().y() * kRadius, 6.0), Vec3::UnitZ()});
  const Path path{{strip}};
  const SweptVolume volume(cylinder(), path);
  const auto behind = [&](const Face& other) {
    const std::vector<SheetVotes> votes = {side_votes(volume, path, seen, 0.01),
                                           side_votes(volume, path, sample_face(other, 0.1, true), 0.01)};
    EXPECT_GT(votes[1].strips[0].from_behind, 0.1 * votes[1].asked);
    return strips_behind(votes).size();
  };
  EXPECT_EQ(behind(edge), 0u);
  EXPECT_EQ(behind(wide), 1u);
}

}  // namespace
}  // namespace flank::internal::verify
