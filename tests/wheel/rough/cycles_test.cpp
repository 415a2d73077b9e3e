// Cycles clear a layer of a channel and keep the engagement, as the judge's own stock finds it.
#include "flank/wheel/rough/cycles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/verify/program_stock.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

// A shorter block where a sanitizer makes all of it ten times as long.
constexpr double kLength = kSanitized ? 6.0 : 20.0;
constexpr double kHalf = 3.5,
                 kTop = 2.0;  // of a block, the tips' places across, its top over the tip's centre
constexpr double kMostDeg = 60.0;

/// A straight channel through a block; its rows lead by so much on the second side, as those of a channel that winds.
ChannelLayer channel(double lead) {
  std::vector<ChannelLayer::Row> rows;
  for (double x = 0.0; x <= kLength; x += 0.5) {
    rows.emplace_back();
    for (int c = 0; c <= 16; ++c) {
      const double share = c / 16.0;
      rows.back().push_back({Vec3(x + lead * (share - 0.5), kHalf * (2.0 * share - 1.0), 0.0), Vec3::UnitZ()});
    }
  }
  return ChannelLayer::stretches(
             rows, true, true,
             loop_length(Cutter(RadialFunction(ToolFamily::kCylinder, 6.0, Eigen::VectorXd::Ones(1)))))
      .front();
}

struct Cleared {
  std::vector<Strip> strips;
  ProgramStock judged;
};

Cleared cleared(
    const ChannelLayer& layer, const MotionTest& is_free = [](const Pose&, const Pose&) { return true; }) {
  const RadialFunction radial(ToolFamily::kCylinder, 6.0, Eigen::VectorXd::Ones(1));
  const Cutter cutter(radial);
  Box3 box;
  box.add(Vec3(-8.0, -6.0, -2.0)), box.add(Vec3(kLength + 8.0, 6.0, 3.0));
  StockGrid stock(box, 0.2, [](const Vec3& p) { return std::min({p.x(), kLength - p.x(), kTop - p.z()}); });
  Cleared out;
  out.strips = layer_cycles(
      layer, cutter, {.most_engagement_rad = kMostDeg * std::numbers::pi / 180.0, .is_free = is_free}, "F1", stock);
  Tool tool;
  tool.radial = radial;
  Path path;
  path.strips = out.strips;
  const std::vector<HalfSpace> blank{{Vec3::UnitX(), kLength}, {-Vec3::UnitX(), 0.0}, {Vec3::UnitZ(), kTop},
                                     {-Vec3::UnitZ(), 2.0},    {Vec3::UnitY(), 6.0},  {-Vec3::UnitY(), 6.0}};
  ProgramStockOptions options;
  options.cell_mm = 0.1;
  options.most_engagement_deg = kMostDeg;
  out.judged = replay_program(tool, path, blank, {}, options);
  return out;
}

void expect_cleared(const Cleared& found) {
  const StockReport& report = found.judged.report;
  ASSERT_EQ(report.kinds.size(), 1u);
  EXPECT_LE(report.kinds[0].engagement_deg, kMostDeg + report.resolution_deg);
  EXPECT_GT(report.kinds[0].engagement_deg, 0.5 * kMostDeg) << "steps that are too short take hours";
  // A slot of two radii more than the places are apart: its upper part whole, the lower one but for what is between the tip's spheres.
  const double upper = kLength * 2.0 * (kHalf + 1.0) * kTop;
  EXPECT_GT(report.before_mm3 - report.left_mm3, upper);
  EXPECT_LT(report.before_mm3 - report.left_mm3, kLength * 2.0 * (kHalf + 1.0) * (kTop + 1.0));
}

TEST(LayerCycles, ClearAChannelBelowTheLimit) { expect_cleared(cleared(channel(0.0))); }

TEST(LayerCycles, ClearAChannelThatWinds) { expect_cleared(cleared(channel(6.0))); }

TEST(LayerCycles, ClimbFromTheSideOnWhichTheyBegin) {
  const std::vector<Strip> strips = cleared(channel(0.0)).strips;
  ASSERT_FALSE(strips.empty());
  // The material is ahead, in the direction of x or against it: to the right of the way across, seen from above.
  double right = 0.0, left = 0.0;
  for (const Strip& strip : strips) {
    const double on = strip.poses.back().tip.x() > strip.poses.front().tip.x() ? 1.0 : -1.0;
    for (std::size_t k = 1; k + 1 < strip.poses.size(); ++k) {
      const Vec3 way = strip.poses[k + 1].tip - strip.poses[k - 1].tip;
      // Ahead of its neighbours across: on the front half.
      const double bow = on * (2.0 * strip.poses[k].tip.x() - strip.poses[k - 1].tip.x() - strip.poses[k + 1].tip.x());
      if (bow > 0.0) (way.cross(Vec3::UnitZ()).x() * on > 0.0 ? right : left) += way.norm();
    }
  }
  EXPECT_GT(right, 4.0 * left);
}

/// A loop that may not go to a place is narrower, and what follows knows that it was.
TEST(LayerCycles, KeepOffWhereTheToolMayNotGo) {
  const auto is_free = [](const Pose& a, const Pose& b) {
    const auto outside = [](const Vec3& p) { return p.y() < 2.0 || std::abs(p.x() - 0.5 * kLength) > 0.2 * kLength; };
    return outside(a.tip) && outside(b.tip);
  };
  const Cleared found = cleared(channel(0.0), is_free);
  const StockReport& report = found.judged.report;
  ASSERT_EQ(report.kinds.size(), 1u);
  EXPECT_LE(report.kinds[0].engagement_deg, kMostDeg + report.resolution_deg);
  double farthest = -kHalf;
  for (const Strip& strip : found.strips)
    for (std::size_t k = 0; k + 1 < strip.poses.size(); ++k) {
      EXPECT_TRUE(is_free(strip.poses[k], strip.poses[k + 1]));
      farthest = std::max(farthest, strip.poses[k].tip.y());
    }
  EXPECT_GT(farthest, kHalf - 0.1) << "before and behind it loops are as wide as the channel";
}

/// A line that is another place than the one before begins another stretch: a loop would run across from the one to the other.
TEST(ChannelLayer, EndsWhereItsLinesJump) {
  std::vector<ChannelLayer::Row> rows;
  for (double x = 0.0; x <= 20.0; x += 0.5) {
    rows.emplace_back();
    const double first = x < 10.0 ? 0.0 : 6.0;
    for (int c = 0; c <= 16; ++c)
      rows.back().push_back({Vec3(x, std::lerp(first, 14.0, c / 16.0), 0.0), Vec3::UnitZ()});
  }
  const std::vector<ChannelLayer> found = ChannelLayer::stretches(rows, true, true, 2.0);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].open_before() && found[1].open_behind());
  EXPECT_FALSE(found[0].open_behind() || found[1].open_before());
  EXPECT_NEAR(found[0].width(0.5 * found[0].length()), 14.0, 0.1);
  EXPECT_NEAR(found[1].width(0.5 * found[1].length()), 8.0, 0.1);
}

TEST(ChannelLayer, LinesLieSquareAcrossWhereRowsDoNot) {
  const ChannelLayer layer = channel(6.0);
  for (double along = 10.0; along < layer.length() - 10.0; along += 1.3) {
    const Vec3 across = layer.at(along, 1.0).tip - layer.at(along, 0.0).tip;
    EXPECT_NEAR(across.x(), 0.0, 0.05 * across.norm()) << along;
    EXPECT_NEAR(layer.width(along), 2.0 * kHalf, 0.05 * kHalf) << along;
  }
}

}  // namespace
}  // namespace flank::internal
