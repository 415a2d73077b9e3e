// One sector of a wheel, its channels and its copies.
#include "flank/wheel/sector.h"

#include <gtest/gtest.h>

#include <numbers>

#include "flank/error.h"

namespace flank::internal {
namespace {

using Names = std::vector<std::string>;

WheelBlade blade(bool splitter, double angle_deg, const std::string& ahead, const std::string& behind) {
  WheelBlade out;
  out.splitter = splitter, out.angle_deg = angle_deg;
  out.ahead = {ahead}, out.behind = {behind};
  return out;
}

WheelRoles three_mains() {
  WheelRoles roles;
  roles.count = 3, roles.whole = true;
  roles.blades = {blade(false, 10.0, "F1", "F2"), blade(false, 130.0, "F3", "F4"), blade(false, 250.0, "F5", "F6")};
  return roles;
}

TEST(WheelSector, AChannelIsBetweenASideAndTheOneThatFacesIt) {
  const WheelSector sector = make_sector(three_mains());
  EXPECT_EQ(sector.copies, 3);
  EXPECT_NEAR(sector.pitch_rad, 2.0 * std::numbers::pi / 3.0, 1e-15);
  ASSERT_EQ(sector.blades.size(), 1U);
  ASSERT_EQ(sector.channels.size(), 1U);
  EXPECT_EQ(sector.channels[0].first, Names{"F1"});
  EXPECT_EQ(sector.channels[0].second, Names{"F4"});
  EXPECT_EQ(sector.channels[0].second_path, Names{"F2"});
  EXPECT_TRUE(sector.channels[0].turned);
}

TEST(WheelSector, ASplitterMakesTwoChannelsOfOne) {
  WheelRoles roles = three_mains();
  roles.blades.push_back(blade(true, 70.0, "F7", "F8"));
  const WheelSector sector = make_sector(roles);
  EXPECT_EQ(sector.sides(), (Names{"F1", "F2", "F7", "F8"}));
  ASSERT_EQ(sector.channels.size(), 2U);
  EXPECT_EQ(sector.channels[0].second, Names{"F8"});
  EXPECT_FALSE(sector.channels[0].turned);
  EXPECT_EQ(sector.channels[1].first, Names{"F7"});
  EXPECT_EQ(sector.channels[1].second, Names{"F4"});
  EXPECT_TRUE(sector.channels[1].turned);
}

TEST(WheelSector, OneBladeAloneHasNoChannel) {
  WheelRoles roles = three_mains();
  roles.blades.resize(1);
  EXPECT_THROW((void)make_sector(roles), InputError);
}

TEST(WheelSector, CopiesAreTurnedByExactlyAPitchEach) {
  WheelAxis axis;
  Path path;
  path.strips.push_back({1, "flank", "F1", {{Vec3(5.0, 0.0, 1.0), Vec3(1.0, 0.0, 1.0).normalized()}}});
  const Path whole = copied(path, axis, 0.5 * std::numbers::pi, 4, true);
  ASSERT_EQ(whole.strips.size(), 4U);
  EXPECT_LT((whole.strips[1].poses[0].tip - Vec3(0.0, 5.0, 1.0)).norm(), 1e-14);
  EXPECT_LT((whole.strips[3].poses[0].tip - Vec3(0.0, -5.0, 1.0)).norm(), 1e-14);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(whole.strips[k].id, static_cast<int>(k) + 1);
  // In a part that is a sector the blades may lie on either side of the one that was computed.
  EXPECT_EQ(copied(path, axis, 0.1, 3, false).strips.size(), 5U);
}

}  // namespace
}  // namespace flank::internal
