// The space of a family, and the search in it.
#include "flank/tool_choice/family_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cover/cover_targets.h"
#include "flank/error.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

ScreenPlaces flat_places() { return screen_places(*testing::flat_target(0.0, 50.0, 0.0, 30.0), 60); }

/// A sheet that bends to 40 mm of radius at most, towards the tool.
ScreenPlaces hollow_places() { return screen_places(*make_target(make_example("elliptic-side").faces, -1), 60); }

TEST(FamilyChart, OpenParametersAreItsCoordinates) {
  const ScreenPlaces places = flat_places();
  const auto count = [&](ToolFamily family, const std::map<std::string, double>& given) {
    return FamilyChart(family, given, 20.0, places, 0.01).coordinates().size();
  };
  EXPECT_EQ(count(ToolFamily::kCylinder, {}), 1u);
  EXPECT_EQ(count(ToolFamily::kBarrel, {}), 2u) << "s0 is the middle of the axis";
  EXPECT_EQ(count(ToolFamily::kBarrel, {{"radius", 5.0}}), 1u);
  EXPECT_EQ(count(ToolFamily::kTaperedBarrel, {}), 3u);
  EXPECT_EQ(count(ToolFamily::kLens, {{"end_radius", 3.0}}), 1u);
}

/// The curvature of the middle of the meridian is the coordinate's, whatever the family calls it.
TEST(FamilyChart, OneCurvatureForAllFamilies) {
  const ScreenPlaces places = hollow_places();
  for (const double x : {0.1, 0.5, 0.8}) {
    const auto arc = FamilyChart(ToolFamily::kBarrel, {{"radius", 5.0}}, 20.0, places, 0.05).at({x});
    ASSERT_TRUE(arc);
    const RadialJet wanted = arc->at(10.0);
    for (const ToolFamily family : {ToolFamily::kLens, ToolFamily::kHyperbolic, ToolFamily::kTaperedBarrel}) {
      std::map<std::string, double> given = {{"radius", 5.0}};
      if (family == ToolFamily::kHyperbolic) given["slope"] = 0.0;
      if (family == ToolFamily::kTaperedBarrel) given["angle"] = 0.0;
      const auto radial = FamilyChart(family, given, 20.0, places, 0.05).at({x});
      ASSERT_TRUE(radial) << family_name(family);
      EXPECT_NEAR(radial->at(10.0).r, 5.0, 1e-12) << family_name(family);
      // Parameters are rounded: arcs to four digits, an end radius to 1e-4 mm over 10 mm.
      EXPECT_NEAR(radial->at(10.0).d2, wanted.d2, 1e-3 * std::abs(wanted.d2) + 2e-6) << family_name(family);
    }
  }
}

TEST(FamilyChart, ReachesWhatTheTargetNeedsAndNoToolThatIsNone) {
  const FamilyChart chart(ToolFamily::kBarrel, {}, 20.0, hollow_places(), 0.05);
  int tools = 0;
  double smallest = 1e300;
  for (double x = 0.0; x <= 1.0; x += 0.1) {
    for (double y = 0.0; y <= 1.0; y += 0.1) {
      const auto radial = chart.at({x, y});
      if (!radial) continue;
      ++tools;
      EXPECT_TRUE(check_legitimacy(*radial).legitimate) << family_text(*radial);
      EXPECT_GE(radial->parameters()[1], 2.0) << "five diameters long at most";
      if (radial->parameters()[0] > 0.0) smallest = std::min(smallest, radial->parameters()[0]);
    }
  }
  EXPECT_GE(tools, 60);
  EXPECT_LE(smallest, 45.0) << "the hollow's own radius is within the range";
}

TEST(FamilyChart, TheTextIsWhatTheCommandLineTakes) {
  const RadialFunction radial(ToolFamily::kTaperedBarrel, 20.0, Eigen::Vector3d(85.5, 5.25, 0.17453292519943295));
  EXPECT_EQ(family_text(radial), "tapered-barrel:arc=85.5,radius=5.25,angle=10");
  const RadialFunction middle(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(100.0, 5.0, 10.0));
  EXPECT_EQ(family_text(middle), "barrel:arc=100,radius=5");
}

/// Strips are not grown: coverage falls off with the distance from one tool.
FamilySearchOptions options_with_best_at(double radius, double sine) {
  FamilySearchOptions options;
  options.axis_length_mm = 20.0;
  options.rounds = 12;
  options.ranking.cover_with = [=](const Target&, const Tool& tool, const Obstacles&, const CoverOptions&,
                                   const Progress&) {
    CoverResult result;
    const RadialJet tip = tool.radial.at(0.0);
    result.coverage = std::exp(-4.0 * std::pow(std::log(tip.r / radius), 2) - 100.0 * std::pow(tip.d1 - sine, 2));
    result.motions = {testing::straight_motion(20.0)};
    return result;
  };
  return options;
}

FamilySearchResult search_flat(ToolFamily family, const std::map<std::string, double>& given,
                               const FamilySearchOptions& options) {
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  const Obstacles none;
  const RankingTarget targets = {target.get(), &none};
  return search_family(std::span(&targets, 1), family, given, options, {});
}

TEST(FamilySearch, FindsTheBestTool) {
  const FamilySearchResult found = search_flat(ToolFamily::kCone, {}, options_with_best_at(3.1, std::sin(0.07)));
  ASSERT_FALSE(found.tools.empty());
  EXPECT_NEAR(found.tools.front().radial.at(0.0).r, 3.1, 0.03);
  EXPECT_NEAR(found.tools.front().radial.at(0.0).d1, std::sin(0.07), 0.002);
  EXPECT_NE(found.searched.find("axis 20 mm (given)"), std::string::npos) << found.searched;
  EXPECT_LT(found.covered, 70);
  ASSERT_EQ(found.tools.size(), 3u);
  for (std::size_t k = 1; k < 3; ++k) EXPECT_NE(found.tools[k].name, found.tools[k - 1].name);
}

TEST(FamilySearch, WhatIsGivenStays) {
  const FamilySearchResult found =
      search_flat(ToolFamily::kCone, {{"radius", 4.0}}, options_with_best_at(3.1, std::sin(0.07)));
  for (const Tool& tool : found.tools) EXPECT_EQ(tool.radial.parameters()[0], 4.0);
  EXPECT_NEAR(found.tools.front().radial.at(0.0).d1, std::sin(0.07), 0.002);
}

TEST(FamilySearch, DerivesTheLengthFromTheWidth) {
  FamilySearchOptions options = options_with_best_at(3.1, 0.0);
  options.axis_length_mm.reset();
  const FamilySearchResult found = search_flat(ToolFamily::kCylinder, {}, options);
  EXPECT_NE(found.searched.find("mm wide: 1 to 4 passes"), std::string::npos) << found.searched;
  const double length = found.tools.front().radial.axis_length();
  EXPECT_GE(length, 6.0);
  EXPECT_LE(length, 32.0);
}

TEST(FamilySearch, SameForAnyNumberOfThreads) {
  std::vector<std::string> names;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    names.push_back(search_flat(ToolFamily::kCone, {}, options_with_best_at(3.1, 0.05)).tools.front().name);
  }
  set_thread_count(0);
  EXPECT_EQ(names[0], names[1]);
}

TEST(FamilySearch, TheNearestWhereNoneWorks) {
  // A lid lower than twice the smallest radius that is searched.
  const auto target = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  const Obstacles obstacles = testing::lid_at(1.0);
  const RankingTarget targets = {target.get(), &obstacles};
  const FamilySearchResult found =
      search_family(std::span(&targets, 1), ToolFamily::kCylinder, {}, options_with_best_at(3.0, 0.0), {});
  EXPECT_EQ(found.tools.size(), 1u);
}

TEST(FamilySearch, RefusesWhatNamesNoSizes) {
  EXPECT_THROW((void)search_flat(ToolFamily::kPower, {}, {}), UsageError);
  EXPECT_THROW((void)search_flat(ToolFamily::kBarrel, {{"arc", 1.0}}, options_with_best_at(3.0, 0.0)), UsageError)
      << "an arc of 1 mm is smaller than every radius that is searched";
}

}  // namespace
}  // namespace flank::internal
