#include "flank/verify/swept/radial_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"
#include "flank/error.h"

namespace flank::internal::verify {
namespace {

Eigen::VectorXd values(std::initializer_list<double> list) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  Eigen::Index i = 0;
  for (const double x : list) v[i++] = x;
  return v;
}

std::vector<RadialFunction> every_family() {
  return {RadialFunction(ToolFamily::kCylinder, 30.0, values({4.0})),
          RadialFunction(ToolFamily::kCone, 30.0, values({2.0, 0.12})),
          RadialFunction(ToolFamily::kBarrel, 30.0, values({85.0, 5.0, 12.0})),
          RadialFunction(ToolFamily::kLens, 30.0, values({5.0, 4.0})),
          RadialFunction(ToolFamily::kTaperedBarrel, 30.0, values({250.0, 5.0, 0.1})),
          RadialFunction(ToolFamily::kHyperbolic, 30.0, values({3.0, 0.02, 0.004})),
          RadialFunction(ToolFamily::kPower, 30.0, values({8.0, 1.5, 1.2, 2.3})),
          RadialFunction::spline(30.0, values({3.0, 3.4, 3.9, 4.2, 4.4, 4.1, 4.2}))};
}

TEST(RadialTable, GivesValueSlopeAndBendOfEveryFamily) {
  for (const RadialFunction& radial : every_family()) {
    SCOPED_TRACE(family_name(radial.family()));
    const RadialTable table(radial);
    for (int i = 0; i <= 1000; ++i) {
      const double s = 30.0 * i / 1000;
      const RadialJet wanted = radial.at(s), found = table.at(s);
      ASSERT_NEAR(found.r, wanted.r, 1e-12) << s;
      ASSERT_NEAR(found.d1, wanted.d1, 1e-10) << s;
      ASSERT_NEAR(found.d2, wanted.d2, 1e-7) << s;
      ASSERT_EQ(table.radius(s), found.r) << s;
    }
  }
}

TEST(RadialTable, CellsOfASplineEndOnItsKnots) {
  // A cell that crossed a knot would lose the jump of the third derivative: about h^3 / 6 of it.
  for (const int count : {4, 5, 8, 11, 60, 203}) {
    Random random(static_cast<std::uint64_t>(count));
    Eigen::VectorXd c(count);
    for (double& x : c) x = 5.0 + random.uniform(-1.0, 1.0);
    const RadialFunction radial = RadialFunction::spline(40.0, c);
    const RadialTable table(radial);
    EXPECT_EQ(table.count() % (count - 3), 0) << "whole cells in every span";
    EXPECT_GE(table.count(), 192);
    for (int i = 0; i < 500; ++i) {
      const double s = random.uniform(0.0, 40.0);
      ASSERT_NEAR(table.at(s).r, radial.at(s).r, 1e-12) << count << ' ' << s;
    }
  }
}

TEST(RadialTable, NodesAreEquallySpacedAndHoldTheToolsRadius) {
  for (const RadialFunction& radial : every_family()) {
    const RadialTable table(radial);
    EXPECT_EQ(table.length(), 30.0);
    EXPECT_NEAR(table.step() * table.count(), 30.0, 1e-12);
    EXPECT_EQ(table.node(0), 0.0);
    EXPECT_NEAR(table.node(table.count()), 30.0, 1e-12);
    for (int i = 0; i <= table.count(); ++i)
      ASSERT_NEAR(table.node_radius(i), radial.at(std::min(30.0, table.node(i))).r, 1e-13) << i;
  }
}

TEST(RadialTable, BoundsEncloseTheRadiiAndTheBend) {
  for (const RadialFunction& radial : every_family()) {
    SCOPED_TRACE(family_name(radial.family()));
    const RadialTable table(radial);
    double least = 1e300, most = -1e300, bend = 0.0;
    for (int i = 0; i <= 20000; ++i) {
      const RadialJet j = radial.at(30.0 * i / 20000);
      least = std::min(least, j.r), most = std::max(most, j.r), bend = std::max(bend, std::abs(j.d2));
    }
    EXPECT_LE(table.least_radius(), least);
    EXPECT_GE(table.largest_radius(), most);
    EXPECT_GE(table.least_radius(), least - table.step()) << "and not by far";
    EXPECT_LE(table.largest_radius(), most + table.step());
    EXPECT_NEAR(table.largest_bend(), bend, 1e-2 * bend + 1e-15);
  }
}

TEST(RadialTable, BeyondTheEndsTheLastCellsGoOn) {
  const RadialTable table(RadialFunction(ToolFamily::kCone, 20.0, values({2.0, 0.1})));
  const double slope = std::sin(0.1);
  EXPECT_NEAR(table.at(-0.5).r, 2.0 - 0.5 * slope, 1e-12);
  EXPECT_NEAR(table.at(20.5).r, 2.0 + 20.5 * slope, 1e-12);
  EXPECT_NEAR(table.at(20.0).d1, slope, 1e-12);
}

TEST(RadialTable, RefusesARadiusThatIsNoNumberAndSaysWhere) {
  // A barrel whose arc ends before the tool does has no radius there.
  const RadialFunction radial(ToolFamily::kPower, 20.0, values({5.0, -1.0, 1.0, 2.0}));
  ASSERT_FALSE(std::isfinite(radial.at(15.0).r));
  try {
    const RadialTable table(radial);
    FAIL() << "was accepted";
  } catch (const InputError& e) {
    const std::string message = e.what();
    ASSERT_NE(message.find("not finite at s = "), std::string::npos) << message;
    EXPECT_NEAR(std::stod(message.substr(message.find("s = ") + 4)), 5.0, 0.2) << "where the radius ends";
  }
  EXPECT_THROW((void)RadialTable(RadialFunction()), InputError);
}

}  // namespace
}  // namespace flank::internal::verify
