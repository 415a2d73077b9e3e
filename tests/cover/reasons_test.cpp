// The sentence that says why a tool does not cover a face, with figures that have closed forms.
#include "flank/cover/reasons.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cover/cover_targets.h"
#include "seed/sheet.h"

namespace flank::internal {
namespace {

using testing::sheet;

/// The hollow side of a cylinder of radius 30 about the y axis, 20 mm long; the lowest line is z = -30.
Face hollow_cylinder() {
  const auto at = [](double u, double v) {
    const double a = 0.8 * (u - 0.5);
    return Vec3(30.0 * std::sin(a), 20.0 * v, -30.0 * std::cos(a));
  };
  return sheet(at, 49, 5);
}

/// The inner half of the outside of a torus: a tube of radius 6 round the z axis, at 20 mm. Along the inner equator
/// it is hollow across the tube's plane, with 1 / 14 mm; half a radian up and down that is less.
Face torus_waist() {
  return sheet([](double u, double v) {
    const double a = 0.8 * (u - 0.5), b = 3.14159265358979324 + (v - 0.5), out = 20.0 + 6.0 * std::cos(b);
    return Vec3(out * std::cos(a), out * std::sin(a), 6.0 * std::sin(b));
  });
}

/// Strips that cover the cells for which `covers` holds.
template <class Covers>
std::vector<CoverStrip> one_strip(const CoverSamples& samples, const Covers& covers) {
  std::vector<CoverStrip> strips(1);
  for (std::size_t k = 0; k < samples.cells.size(); ++k)
    if (covers(samples.cells[k].point)) strips[0].cells.push_back(static_cast<int>(k));
  return strips;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(MostConcave, IsTheHollowOfACylinder) {
  const auto target = make_target({hollow_cylinder()});
  const CoverSamples samples = cover_samples(*target, 1.0);
  EXPECT_NEAR(most_concave(*target, samples, {}).curvature, 1.0 / 30.0, 1e-4);
}

TEST(MostConcave, AConvexSideHasNone) {
  const auto target = make_target({hollow_cylinder()}, -1);
  EXPECT_NEAR(most_concave(*target, cover_samples(*target, 1.0), {}).curvature, 0.0, 1e-9)
      << "straight along its lines";
}

TEST(MostConcave, IsTheWaistOfATorus) {
  // The side on which u and v turn anticlockwise looks into the hole.
  const int side =
      torus_waist().surface.jet(0.5, 0.5).du.cross(torus_waist().surface.jet(0.5, 0.5).dv).x() < 0.0 ? 1 : -1;
  const auto target = make_target({torus_waist()}, side);
  const CoverSamples samples = cover_samples(*target, 0.3);
  const ConcavePlace place = most_concave(*target, samples, {});
  EXPECT_NEAR(place.curvature, 1.0 / 14.0, 1e-3);
  EXPECT_NEAR(place.point.z(), 0.0, 0.5);
  EXPECT_NEAR(place.point.head<2>().norm(), 14.0, 0.1);
  // What is covered does not count: 2 mm off the equator the hollow is cos(b) / (20 - 6 cos(b)), sin(b) = 1 / 3.
  const auto strips = one_strip(samples, [](const Vec3& x) { return std::abs(x.z()) < 2.0; });
  const double cosine = std::sqrt(1.0 - 1.0 / 9.0);
  const ConcavePlace next = most_concave(*target, samples, strips);
  EXPECT_NEAR(next.curvature, cosine / (20.0 - 6.0 * cosine), 2e-3);
  EXPECT_LT(next.curvature, cosine / (20.0 - 6.0 * cosine) + 1e-4);
  EXPECT_GE(std::abs(next.point.z()), 2.0);
}

TEST(Reason, NamesTheCurvatureAndTheToolsThinnestPlace) {
  const auto target = make_target({hollow_cylinder()});
  const CoverSamples samples = cover_samples(*target, 1.0);
  // Thinnest at the holder end.
  const RadialFunction cone(ToolFamily::kCone, 25.0, Eigen::Vector2d(45.0, -std::asin(0.2)));
  const std::string text = reason_of(*target, cone, samples, {}, 0.01);
  EXPECT_TRUE(says(text, "the concave face needs a tool radius below 30 mm at (")) << text;
  EXPECT_TRUE(says(text, "the smallest of this tool is 40 mm, 25 mm along its axis")) << text;
}

TEST(Reason, AToolThatFitsTheHollowIsNotBlamedForIt) {
  const auto target = make_target({hollow_cylinder()});
  const CoverSamples samples = cover_samples(*target, 1.0);
  const std::string small = reason_of(*target, testing::cylinder(29.5, 25.0).radial, samples, {}, 0.01);
  EXPECT_FALSE(says(small, "concave")) << small;
  const std::string large = reason_of(*target, testing::cylinder(30.5, 25.0).radial, samples, {}, 0.01);
  EXPECT_TRUE(says(large, "concave")) << large;
}

TEST(Reason, SaysThatNoLineFits) {
  const auto target = testing::flat_target(0.0, 20.0, 0.0, 20.0);
  const std::string text =
      reason_of(*target, testing::cylinder(4.0, 12.5).radial, cover_samples(*target, 1.0), {}, 0.005);
  EXPECT_TRUE(says(text, "nowhere does the whole flank (12.5 mm) lie within 0.005 mm of the face")) << text;
}

TEST(Reason, NamesTheLargestPlaceThatIsLeft) {
  const auto target = testing::flat_target(0.0, 40.0, 0.0, 20.0);
  const CoverSamples samples = cover_samples(*target, 0.5);
  // Left: 4 x 20 mm on the left, 8 x 20 on the right, and both are apart.
  const auto strips = one_strip(samples, [](const Vec3& x) { return x.x() > 4.0 && x.x() < 32.0; });
  const std::string text = reason_of(*target, testing::cylinder(4.0, 12.0).radial, samples, strips, 0.01);
  EXPECT_TRUE(says(text, "the largest unfinished area is 160 mm2 near (36.0, 10.0, 0.0)")) << text;
}

TEST(Reason, IsEmptyWhereAllIsCovered) {
  const auto target = testing::flat_target(0.0, 40.0, 0.0, 20.0);
  const CoverSamples samples = cover_samples(*target, 1.0);
  const auto strips = one_strip(samples, [](const Vec3&) { return true; });
  EXPECT_EQ(reason_of(*target, testing::cylinder(4.0, 12.0).radial, samples, strips, 0.01), "");
}

}  // namespace
}  // namespace flank::internal
