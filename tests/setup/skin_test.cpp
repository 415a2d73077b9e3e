#include "flank/setup/skin.h"

#include <gtest/gtest.h>

#include "geom/skins.h"

namespace flank::internal {
namespace {

/// Faces drawn along Z from stretches of a section: a straight run, a round corner (in two faces), another straight run,
/// a sharp corner, a third run; and one far away.
Part folded() {
  const auto line = [](Vec3 a, Vec3 b) { return [=](double f) { return Vec3(a + f * (b - a)); }; };
  const auto arc = [](double from, double to) {
    return [=](double f) {
      const double angle = from + f * (to - from);
      return Vec3(20.0 + 5.0 * std::sin(angle), 5.0 - 5.0 * std::cos(angle), 0.0);
    };
  };
  constexpr double kQuarter = std::numbers::pi / 2;
  Part part;
  const auto add = [&](const auto& section) {
    part.faces.push_back(testing::drawn_skin(section, 30.0, 0.0, 40));
    part.faces.back().id = "F" + std::to_string(part.faces.size());
    part.surface_types.emplace_back("B-spline");
    for (const Vec3& p : part.faces.back().surface.poles) part.box.add(p);
  };
  add(line({0, 0, 0}, {20, 0, 0}));
  add(arc(0.5 * kQuarter, kQuarter));
  add(line({25, 5, 0}, {25, 30, 0}));
  add(line({25, 30, 0}, {60, 30, 0}));
  add(arc(0.0, 0.5 * kQuarter));
  add(line({0, 99, 0}, {20, 99, 0}));
  return part;
}

TEST(SmoothSkin, EndsAtSharpEdges) {
  Part part = folded();
  using Faces = std::vector<int>;
  EXPECT_EQ(smooth_skin(part, {0}), (Faces{0, 1, 2, 4}));
  EXPECT_EQ(smooth_skin(part, {4}), (Faces{0, 1, 2, 4}));
  EXPECT_EQ(smooth_skin(part, {3}), Faces{3});
  EXPECT_EQ(smooth_skin(part, {5, 0}), (Faces{0, 1, 2, 4, 5}));
}

TEST(SmoothSkin, GoesRoundWhatWasLeftOut) {
  Part part = folded();
  part.left_out[1] = "why";
  EXPECT_EQ(smooth_skin(part, {0}), (std::vector<int>{0, 4}));
}

TEST(SmoothSkin, HoldsForSheetsOfAnyOrientation) {
  Part part = folded();
  part.faces[4].reversed = true;
  EXPECT_EQ(smooth_skin(part, {0}), (std::vector<int>{0, 1, 2, 4}));
}

TEST(SmoothSkin, FoldsOfASolidAreNotSmooth) {
  // Two plates back to back: the normals of a sheet may be opposite, those of a solid may not.
  const auto line = [](double f) { return Vec3(20.0 * f, 0.0, 0.0); };
  Part part;
  for (int k = 0; k < 2; ++k) {
    part.faces.push_back(testing::drawn_skin(line, 30.0, 0.0, 8));
    part.faces.back().reversed = k == 1;
    part.faces.back().of_solid = true;
    part.faces.back().solid = 0;
  }
  part.box.add(Vec3::Zero());
  part.box.add(Vec3(20.0, 0.0, 30.0));
  EXPECT_EQ(smooth_skin(part, {0}), std::vector<int>{0});
}

}  // namespace
}  // namespace flank::internal
