// A tool whose parameters are all given is no longer than it can be.
#include "flank/tool_request/tool_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/error.h"
#include "flank/tool.h"

namespace flank::internal {
namespace {

TEST(ToolModel, AGivenBarrelTakesPartOfALongContactLine) {
  const ToolModel model = make_tool_model(parse_tool_spec("barrel:arc=15,radius=6"), {});
  ASSERT_TRUE(model.longest_axis);
  // Its arc meets the axis sqrt(15^2 - 9^2) from the middle.
  EXPECT_LT(*model.longest_axis, 24.0);
  EXPECT_GT(*model.longest_axis, 15.0);
  const double length = model.length_for(47.9, {});
  EXPECT_EQ(length, *model.longest_axis);
  EXPECT_TRUE(check_legitimacy(model.make(length, 1.0)).legitimate);
  EXPECT_FALSE(check_legitimacy(model.make(1.1 * length, 1.0)).legitimate);
  EXPECT_EQ(model.length_for(9.0, {}), 9.0);
  EXPECT_TRUE(model.free_parameters.empty());
  EXPECT_EQ(model.length_for(47.9, 12.0), 12.0);
}

TEST(ToolModel, AnAxisBeyondTheEndIsRefusedWithWhatIsAccepted) {
  const ToolSpec barrel = parse_tool_spec("barrel:arc=15,radius=6");
  EXPECT_EQ(make_tool_model(barrel, 15.0).length_for(47.9, 15.0), 15.0);
  try {
    static_cast<void>(make_tool_model(barrel, 30.0));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("expected at most 24 mm"), std::string::npos) << error.what();
  }
}

TEST(ToolModel, WhatIsOpenOrNeverEndsHasNoLongestAxis) {
  for (const char* text : {"free", "barrel", "barrel:arc=15", "cylinder:radius=4", "cone:radius=3,angle=5"}) {
    const ToolModel model = make_tool_model(parse_tool_spec(text), {});
    EXPECT_FALSE(model.longest_axis) << text;
    EXPECT_EQ(model.length_for(500.0, {}), 500.0) << text;
  }
  // A cone that gets thinner ends in its tip.
  const ToolModel cone = make_tool_model(parse_tool_spec("cone:radius=3,angle=-5"), {});
  ASSERT_TRUE(cone.longest_axis);
  EXPECT_LT(*cone.longest_axis, 3.0 / std::tan(5.0 * std::acos(-1.0) / 180.0));
}

}  // namespace
}  // namespace flank::internal
