#include "flank/verify/reach_border.h"

#include <gtest/gtest.h>

#include "verify/faces.h"

namespace flank::internal::verify {
namespace {

using Indices = std::vector<std::size_t>;

/// A row of five cells of 1 mm, then one that is far away.
FaceSamples row(const std::vector<double>& shares) {
  FaceSamples samples;
  for (std::size_t i = 0; i < shares.size(); ++i)
    samples.points.emplace_back(i < 5 ? 1.0 * static_cast<double>(i) : 99.0, 0.0, 0.0);
  samples.reachable = shares;
  samples.spacing_mm = 0.71;
  return samples;
}

TEST(ReachBorder, IsNowhereIfAllIsTheSame) {
  EXPECT_EQ(reach_border(row({})), Indices{});
  EXPECT_EQ(reach_border(row({1, 1, 1, 1, 1, 1})), Indices{});
  EXPECT_EQ(reach_border(row({0, 0, 0, 0, 0, 0})), Indices{});
}

TEST(ReachBorder, IsInCellsThatAreReachableInPart) { EXPECT_EQ(reach_border(row({1, 1, 0.3, 1, 1, 1})), Indices{2}); }

TEST(ReachBorder, IsBetweenCellsThatDiffer) {
  EXPECT_EQ(reach_border(row({1, 1, 0, 0, 0, 1})), (Indices{1, 2}));
  EXPECT_EQ(reach_border(row({0, 0, 0, 0.5, 1, 0})), (Indices{2, 3}));
}

TEST(ReachBorder, IsNoWiderThanTwoCells) {
  FaceSamples plane = sample_face(test::plane_face("F1", 40.0, 20.0), 0.5, true);
  double border = 0.0;
  for (const Vec3& p : plane.points) plane.reachable.push_back(p.x() + 0.3 * p.z() < 20.1 ? 1.0 : 0.0);
  const Indices found = reach_border(plane);
  for (const std::size_t i : found) {
    border += plane.areas[i];
    EXPECT_LT(std::abs(plane.points[i].x() + 0.3 * plane.points[i].z() - 20.1), 1.0);
  }
  EXPECT_GT(border, 20.0 * 0.5);
  EXPECT_LT(border, 4.0 * 20.0 * 0.5);
}

}  // namespace
}  // namespace flank::internal::verify
