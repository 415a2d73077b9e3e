// The roles of a wheel's faces are found from their shapes alone, and what is no wheel is refused with what it lacks.
#include "flank/feature/recognise_wheel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "flank/error.h"
#include "flank/example.h"
#include "flank/feature/wheel_table.h"
#include "sanitized.h"
#include "shared_data.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

using Names = std::vector<std::string>;

class WheelRolesTest : public TemporaryFolder {
 protected:
  WheelRolesTest() : TemporaryFolder("wheel_roles") {}

  /// An example as a part that was read from its file.
  [[nodiscard]] Part part(const std::string& name) const {
    const std::string file = (root_ / "part.step").string();
    write_example(make_example(name), file);
    return read_part(file);
  }
};

TEST_F(WheelRolesTest, TheImpellersFacesHaveTheRolesThatTheyWereMadeFor) {
  const WheelRoles roles = recognise_wheel(part("impeller"));
  EXPECT_EQ(roles.count, 6);
  EXPECT_FALSE(roles.whole);
  EXPECT_EQ(roles.hub, Names{"F1"});
  EXPECT_TRUE(roles.shroud.empty());
  EXPECT_LT((roles.axis.direction - Vec3::UnitX()).norm(), 1e-9);
  EXPECT_LT(roles.axis.radius(Vec3::Zero()), 1e-6);
  ASSERT_EQ(roles.mains(), 2);
  ASSERT_EQ(roles.splitters(), 2);
  const auto blade = std::find_if(roles.blades.begin(), roles.blades.end(),
                                  [](const WheelBlade& b) { return b.ahead == Names{"F9"}; });
  ASSERT_NE(blade, roles.blades.end());
  EXPECT_FALSE(blade->splitter);
  EXPECT_EQ(blade->behind, Names{"F7"});
  EXPECT_EQ(blade->edges, (Names{"F6", "F8"}));
  EXPECT_EQ(blade->tips, Names{"F23"});
  EXPECT_TRUE(blade->fillets.empty());
  // The planes that the sector is cut with, its ends and its bore are nobody's.
  EXPECT_EQ(roles.rest, (Names{"F2", "F3", "F4", "F5", "F22"}));
}

TEST_F(WheelRolesTest, RolesThatAreGivenTakeTheFoundOnesPlace) {
  const Part wheel = part("impeller");
  WheelChoice choice;
  choice.blades = {"F6,F7,F8,F9,F23", "F14,F15,F16,F17,F25"};
  const WheelRoles roles = recognise_wheel(wheel, choice);
  EXPECT_EQ(roles.mains(), 2);
  EXPECT_EQ(roles.splitters(), 0);
  choice.count = 12;
  EXPECT_EQ(recognise_wheel(wheel, choice).count, 12);
  choice.blades = {"F99"};
  EXPECT_THROW((void)recognise_wheel(wheel, choice), Error);
}

TEST_F(WheelRolesTest, WhatIsNoWheelIsRefusedWithWhatIsMissing) {
  try {
    (void)recognise_wheel(part("twisted-blade"));
    FAIL() << "a blade alone is no wheel";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("not recognised as a wheel: no "), std::string::npos) << error.what();
  }
}

TEST(WheelRoles, BladesThatAreSunkIntoTheHubAreFound) {
  FLANK_REAL_PART(file, "kj66_impeller.step");
  const WheelRoles roles = recognise_wheel(read_part(file));
  EXPECT_EQ(roles.count, 9);
  EXPECT_TRUE(roles.whole);
  EXPECT_EQ(roles.hub, Names{"F88"});
  ASSERT_EQ(roles.mains(), 9);
  EXPECT_EQ(roles.splitters(), 0);
  const auto blade = std::find_if(roles.blades.begin(), roles.blades.end(),
                                  [](const WheelBlade& b) { return b.ahead == Names{"F3"}; });
  ASSERT_NE(blade, roles.blades.end());
  EXPECT_EQ(blade->behind, Names{"F1"});
  EXPECT_EQ(blade->tips, (Names{"F2", "F7", "F9"}));
  EXPECT_NEAR(blade->thickness_mm, 0.75, 0.1);
}

/// One test of what are two things, since half of its time reads the part.
TEST(WheelRoles, OfAnAssemblyTheHousingIsNoPartAndTheBoreOfAVaneNoSide) {
  if (kSanitized) GTEST_SKIP() << "hollow_faces_test has the bores, and a part of 263 faces takes a minute";
  FLANK_REAL_PART(file, "zoo/turbo3d_compressor_export.step");
  const WheelRoles roles = recognise_wheel(read_part(file));
  EXPECT_EQ(roles.count, 6);
  // A lid, F1 to F12, and a housing, F13 to F193; what stands on the floor between the blades is the wheel's.
  ASSERT_EQ(roles.debris.size(), 193U);
  EXPECT_EQ(roles.debris.front(), "F1");
  EXPECT_EQ(roles.debris.back(), "F193");
  EXPECT_EQ(roles.hub, Names{"F194"});
  ASSERT_EQ(roles.mains(), 6);
  for (const WheelBlade& blade : roles.blades) {
    EXPECT_TRUE(blade.round());
    EXPECT_EQ(blade.sides().size(), 1U);
    EXPECT_TRUE(blade.edges.empty());
    EXPECT_EQ(blade.tips.size(), 1U);
    EXPECT_EQ(blade.buried.size(), 1U) << "the ring that it stands on the plate with";
    // Its skin is 6 to 6.4 mm across.
    EXPECT_NEAR(blade.thickness_mm, 6.2, 0.2);
  }
  EXPECT_EQ(roles.blades.front().ahead, Names{"F252"});
  EXPECT_EQ(std::count(roles.rest.begin(), roles.rest.end(), "F251"), 1) << "its bore";
}

TEST(WheelRoles, RootFilletsHaveTheirRadius) {
  FLANK_REAL_PART(file, "wheels/impeller.step");
  const WheelRoles roles = recognise_wheel(read_part(file));
  EXPECT_EQ(roles.mains(), 2);
  EXPECT_EQ(roles.splitters(), 1);
  std::size_t fillets = 0;
  for (const WheelBlade& blade : roles.blades)
    for (const RootFillet& fillet : blade.fillets) {
      ++fillets;
      EXPECT_NEAR(fillet.radius_mm, 0.81, 0.05) << fillet.face;
    }
  EXPECT_GE(fillets, 14U);
}

TEST(WheelAxis, ATurnGoesRoundTheAxisAndBack) {
  WheelAxis axis;
  axis.point = Vec3(1.0, -2.0, 3.0);
  axis.direction = Vec3(1.0, 2.0, 2.0).normalized();
  const Vec3 p(7.0, 1.0, -4.0);
  const Vec3 q = axis.turn(2.0 * std::numbers::pi / 3.0) * p;
  EXPECT_NEAR(axis.radius(p), axis.radius(q), 1e-12);
  EXPECT_NEAR(axis.along(p), axis.along(q), 1e-12);
  EXPECT_GT(axis.around(p).dot(q - p), 0.0);
  EXPECT_LT((axis.turn(4.0 * std::numbers::pi / 3.0) * q - p).norm(), 1e-12);
}

}  // namespace
}  // namespace flank::internal
