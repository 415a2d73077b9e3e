// Which rows of the table are shown, in which order, and where a face is.
#include "flank/inspect/inspect_order.h"

#include <gtest/gtest.h>

#include "flank/error.h"
#include "flank/inspect.h"
#include "geom/skins.h"

namespace flank::internal {
namespace {

InspectReport three_faces() {
  InspectReport report;
  const auto add = [&](const char* id, const char* type, double area, double radius) {
    InspectRow row;
    row.id = id, row.type = type, row.area_mm2 = area, row.smallest_concave_radius_mm = radius;
    report.rows.push_back(row);
  };
  add("F1", "plane", 3.0, std::numeric_limits<double>::infinity());
  add("F2", "B-spline", 9.0, 5.0);
  add("F3", "B-spline", 1.0, 2.0);
  return report;
}

std::string ids(const InspectOrder& order) {
  std::string text;
  for (const InspectRow& row : in_order(three_faces(), order).rows) text += row.id + " ";
  return text;
}

TEST(InspectOrder, SortsAndFilters) {
  EXPECT_EQ(ids({}), "F1 F2 F3 ");
  EXPECT_EQ(ids({"", "face"}), "F1 F2 F3 ");
  EXPECT_EQ(ids({"", "area"}), "F2 F1 F3 ");
  EXPECT_EQ(ids({"", "radius"}), "F3 F2 F1 ");
  EXPECT_EQ(ids({"", "type"}), "F2 F3 F1 ");
  EXPECT_EQ(ids({"b-SPLINE", "area"}), "F2 F3 ");
}

TEST(InspectOrder, RefusesWhatThereIsNot) {
  try {
    (void)ids({"cone", ""});
    FAIL() << "no face is a cone";
  } catch (const UsageError& e) {
    EXPECT_STREQ(e.what(), "type cone: must be B-spline or plane");
  }
  EXPECT_THROW((void)ids({"", "size"}), UsageError);
}

TEST(InspectMiddle, OfASkinThatGoesAllRoundPointsNowhereOrAlongItsSide) {
  Part part;
  part.faces.push_back(testing::elliptic_skin(40.0, 4.0, 30.0));
  part.faces[0].id = "F1";
  part.surface_types.emplace_back("B-spline");
  const InspectReport report = inspect(part);
  ASSERT_EQ(report.rows[0].pieces.size(), 4u);
  for (const InspectRow& side : report.rows[0].pieces) {
    EXPECT_TRUE(side.box.low.x() <= side.centre.x() && side.centre.x() <= side.box.high.x()) << side.id;
    EXPECT_NEAR(side.normal.norm(), 1.0, 1e-12) << side.id;
  }
  const Vec3 &one = report.rows[0].pieces[0].normal, &other = report.rows[0].pieces[1].normal;
  EXPECT_LT(one.dot(other), -0.9) << "two sides look away from each other";
  EXPECT_TRUE(report.rows[0].normal.isZero()) << "and together nowhere";
}

}  // namespace
}  // namespace flank::internal
