#include "flank/io/text/dxf_dimension.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/dxf_reading.h"

namespace flank::internal {
namespace {

using testing_io::dxf_entities;
using testing_io::DxfEntity;
using testing_io::named;

constexpr double kHeight = 2.5;

/// 30 mm along x, drawn at y = -20; 8 mm across, drawn at x = 50.
std::vector<DxfDimension> two() {
  return {{{5, -3}, {35, 4}, false, -20.0, "L"}, {{40, -4}, {42, 4}, true, 50.0, "%%c"}};
}

std::vector<DxfEntity> blocks(const std::vector<DxfDimension>& dimensions) {
  DxfText out;
  dxf_dimension_blocks(out, dimensions, kHeight);
  return dxf_entities(out.take());
}

std::vector<DxfEntity> entities(const std::vector<DxfDimension>& dimensions) {
  DxfText out;
  dxf_dimensions(out, dimensions, kHeight);
  return dxf_entities(out.take());
}

Vec2 point(const DxfEntity& e, int code) { return {e.number(code), e.number(code + 10)}; }

TEST(DxfDimension, MeasuresAlongItsOwnDirectionOnly) {
  const auto found = entities(two());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].values.at(1), "L30.0000");
  EXPECT_EQ(found[1].values.at(1), "%%c8.0000");
  EXPECT_EQ(found[0].number(50), 0.0);
  EXPECT_EQ(found[1].number(50), 90.0);
}

TEST(DxfDimension, NamesItsPointsAndWhereItsLineIs) {
  const auto found = entities(two());
  EXPECT_EQ(point(found[0], 13), Vec2(5, -3));
  EXPECT_EQ(point(found[0], 14), Vec2(35, 4));
  EXPECT_EQ(point(found[0], 10), Vec2(35, -20)) << "below the second point";
  EXPECT_EQ(point(found[0], 11), Vec2(20, -20 + kHeight)) << "the text in the middle, above the line";
  EXPECT_EQ(point(found[1], 10), Vec2(50, 4));
  EXPECT_EQ(point(found[1], 11), Vec2(50 - kHeight, -2)) << "a quarter of the way, beside the centreline";
}

TEST(DxfDimension, EveryDimensionRefersToABlockThatIsThere) {
  const auto drawn = named(blocks(two()), "BLOCK");
  const auto found = entities(two());
  ASSERT_EQ(drawn.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found[i].name, "DIMENSION");
    EXPECT_EQ(found[i].values.at(2), drawn[i].values.at(2));
    EXPECT_EQ(found[i].values.at(3), "STANDARD");
  }
  EXPECT_NE(drawn[0].values.at(2), drawn[1].values.at(2));
}

TEST(DxfDimension, BlocksDrawLinesArrowsAndTheText) {
  const auto all = blocks(two());
  EXPECT_EQ(named(all, "LINE").size(), 6u);
  EXPECT_EQ(named(all, "SOLID").size(), 4u);
  EXPECT_EQ(named(all, "BLOCK").size(), named(all, "ENDBLK").size());
  EXPECT_EQ(all.front().name, "SECTION");
  EXPECT_EQ(all.back().name, "ENDSEC");
  const auto texts = named(all, "TEXT");
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_EQ(texts[1].values.at(1), "%%c8.0000");
  EXPECT_EQ(texts[1].number(40), kHeight);
  EXPECT_EQ(texts[1].number(50), 90.0);
  const auto lines = named(all, "LINE");
  EXPECT_EQ(point(lines[0], 10), Vec2(5, -3));
  EXPECT_EQ(point(lines[0], 11), Vec2(5, -20)) << "from the point to its line";
  EXPECT_EQ(point(lines[2], 10), Vec2(5, -20));
  EXPECT_EQ(point(lines[2], 11), Vec2(35, -20));
  for (const DxfEntity& e : all) {
    if (e.name != "SECTION" && e.name != "ENDSEC") {
      EXPECT_EQ(e.values.at(8), kDxfDimensionLayer) << e.name;
    }
  }
}

TEST(DxfDimension, ArrowsPointOutwardsWithTheirTipsOnTheEnds) {
  const auto arrows = named(blocks(two()), "SOLID");
  const Vec2 ends[] = {{5, -20}, {35, -20}, {50, -4}, {50, 4}};
  const Vec2 outwards[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 tip = point(arrows[i], 10), a = point(arrows[i], 11), b = point(arrows[i], 12);
    EXPECT_LT((tip - ends[i]).norm(), 1e-12);
    EXPECT_LT((0.5 * (a + b) - (tip - kHeight * outwards[i])).norm(), 1e-12) << "the arrow lies within the dimension";
    EXPECT_NEAR((a - b).norm(), kHeight / 3.0, 1e-12);
    EXPECT_EQ(point(arrows[i], 13), b) << "the fourth corner of a SOLID repeats the third";
  }
}

TEST(DxfDimension, WhatIsAlreadyOnTheLineNeedsNoLineToIt) {
  const auto all = blocks({{{5, -20}, {35, 4}, false, -20.0, ""}});
  EXPECT_EQ(named(all, "LINE").size(), 2u);
}

TEST(DxfDimension, ADimensionOfNothingIsStillDrawn) {
  const auto all = blocks({{{5, 1}, {5, 2}, false, 9.0, "L"}});
  EXPECT_EQ(named(all, "TEXT")[0].values.at(1), "L0.0000");
  for (const DxfEntity& arrow : named(all, "SOLID"))
    for (const int code : {10, 11, 12, 13}) EXPECT_TRUE(point(arrow, code).allFinite());
}

TEST(DxfDimension, TheStyleGoesWithTheHeight) {
  DxfText out;
  dxf_dimension_style(out, 4.0);
  const auto all = dxf_entities(out.take());
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].name, "DIMSTYLE");
  EXPECT_EQ(all[1].values.at(2), "STANDARD");
  EXPECT_EQ(all[1].number(140), 4.0) << "the text";
  EXPECT_EQ(all[1].number(41), 4.0) << "the arrows";
  EXPECT_EQ(all[1].number(147), 2.0) << "the gap about the text";
}

}  // namespace
}  // namespace flank::internal
