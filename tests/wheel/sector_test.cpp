// One sector of a wheel, its channels and its copies.
#include "flank/wheel/sector.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(WheelSector, AHubLooksTheWayThatItsNormalsSay) {
  WheelRoles roles = three_mains();
  roles.hub = {"F7", "F9"};
  roles.axis.direction = Vec3::UnitZ();
  std::vector<WheelFace> faces(3);
  faces[0].id = "F7", faces[1].id = "F8", faces[2].id = "F9";
  for (WheelFace& face : faces) face.solid = 0;
  faces[0].samples = {{.point = Vec3::Zero(), .normal = -Vec3::UnitZ(), .area = 3.0}};
  faces[1].samples = {{.point = Vec3::Zero(), .normal = Vec3::UnitZ(), .area = 100.0}};
  faces[2].samples = {{.point = Vec3::Zero(), .normal = Vec3::UnitX(), .area = 1.0}};
  EXPECT_NEAR(hub_looks_along(roles, faces), -0.75, 1e-12);
  faces[0].solid = -1;
  EXPECT_NEAR(hub_looks_along(roles, faces), 0.0, 1e-12);
  faces[2].solid = -1;
  EXPECT_EQ(hub_looks_along(roles, faces), 0.0);
}

TEST(WheelSector, AFloorThatLeansIsMachinedFromWhereItLooks) {
  WheelAxis axis;
  axis.direction = Vec3::UnitZ();
  // Sides of a radial wheel: nearly across its axis.
  const std::vector<Strip> strips{
      {.id = 1, .kind = "flank", .face = "F1", .poses = {{Vec3::Zero(), Vec3(1.0, 0.0, -0.1).normalized()}}},
      {.id = 2, .kind = "floor", .face = "F2", .poses = {{Vec3::Zero(), Vec3::UnitZ()}}}};
  EXPECT_TRUE(is_machined_from_ahead(0.8, strips, axis));
  EXPECT_FALSE(is_machined_from_ahead(-0.8, {}, axis));
  EXPECT_FALSE(is_machined_from_ahead(0.1, strips, axis));
  EXPECT_TRUE(is_machined_from_ahead(-0.1, {}, axis));
}

TEST(WheelSector, ABladeOfOneFaceAllRoundHasItOnBothOfItsSides) {
  WheelRoles roles = three_mains();
  for (WheelBlade& one : roles.blades) one.behind = one.ahead;
  ASSERT_TRUE(roles.blades.front().round());
  const WheelSector sector = make_sector(roles);
  EXPECT_EQ(sector.sides(), Names{"F1"});
  ASSERT_EQ(sector.channels.size(), 1U);
  EXPECT_EQ(sector.channels[0].first, Names{"F1"});
  EXPECT_EQ(sector.channels[0].second, Names{"F3"});
  EXPECT_EQ(sector.channels[0].second_path, Names{"F1"});
}

TEST(WheelSector, OneBladeAloneHasNoChannel) {
  WheelRoles roles = three_mains();
  roles.blades.resize(1);
  EXPECT_THROW((void)make_sector(roles), InputError);
}

TEST(WheelSector, APieceOfAWheelHasAllCopiesAndNeighboursThatItLacks) {
  WheelRoles roles = three_mains();
  roles.count = 36, roles.whole = false;
  roles.blades = {blade(false, 10.0, "F1", "F2"), blade(true, 14.0, "F5", "F6"), blade(false, 20.0, "F3", "F4")};
  const WheelSector sector = make_sector(roles);
  EXPECT_EQ(sector.copies, 36);
  const std::vector<MissingBlade> missing = missing_beside(roles, sector);
  ASSERT_EQ(missing.size(), 3U);
  EXPECT_EQ(missing[0].blade.ahead, Names{"F1"});
  EXPECT_EQ(missing[0].turns, -1);
  EXPECT_EQ(missing[1].blade.ahead, Names{"F5"});
  EXPECT_EQ(missing[2].turns, 1);
  EXPECT_TRUE(missing_beside(three_mains(), make_sector(three_mains())).empty());
}

TEST(WheelSector, EveryBladeThatThePartLacksIsATurnedCopyOfOneThatItHas) {
  WheelRoles roles = three_mains();
  roles.count = 7, roles.whole = false;
  const double pitch = 360.0 / 7.0;
  roles.blades = {blade(false, 10.0, "F1", "F2"), blade(true, 30.0, "F5", "F6"),
                  blade(false, 10.0 + pitch, "F3", "F4")};
  const WheelSector sector = make_sector(roles);
  EXPECT_EQ(sector.copies, 7);
  std::vector<int> mains, splitters;
  for (const MissingBlade& one : missing_blades(roles, sector))
    (one.blade.splitter ? splitters : mains).push_back(one.turns);
  EXPECT_EQ(mains, (std::vector<int>{2, 3, 4, 5, 6}));
  EXPECT_EQ(splitters, (std::vector<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(missing_blades(three_mains(), make_sector(three_mains())).empty());
}

TEST(WheelSector, AHubIsCountedBySectors) {
  WheelRoles roles = three_mains();
  roles.count = 12, roles.hub = {"F9"};
  WheelFace hub;
  hub.id = "F9";
  const auto fill = [&](double degrees) {
    hub.samples.clear();
    for (double deg = 0.0; deg <= degrees; deg += 5.0) {
      const double a = deg * std::numbers::pi / 180.0;
      hub.samples.push_back({Vec3(20.0 * std::cos(a), 20.0 * std::sin(a), 0.0), Vec3::UnitZ()});
    }
    return sectors_of_hub(roles, {hub});
  };
  EXPECT_NEAR(fill(90.0), 3.0, 1e-9);
  EXPECT_EQ(fill(355.0), 12.0);
}

TEST(WheelSector, CopiesAreTurnedByExactlyAPitchEach) {
  WheelAxis axis;
  Path path;
  path.strips.push_back({1, "flank", "F1", {{Vec3(5.0, 0.0, 1.0), Vec3(1.0, 0.0, 1.0).normalized()}}});
  const Path whole = copied(path, axis, 0.5 * std::numbers::pi, 4);
  ASSERT_EQ(whole.strips.size(), 4U);
  EXPECT_LT((whole.strips[1].poses[0].tip - Vec3(0.0, 5.0, 1.0)).norm(), 1e-14);
  EXPECT_LT((whole.strips[3].poses[0].tip - Vec3(0.0, -5.0, 1.0)).norm(), 1e-14);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(whole.strips[k].id, static_cast<int>(k) + 1);
}

TEST(WheelSector, CopiesOfThePlacesWithinAPitchAreAllPlacesOnce) {
  WheelAxis axis;
  axis.point = Vec3(1.0, 2.0, 3.0), axis.direction = Vec3(0.2, -0.3, 0.9).normalized();
  for (const int count : {1, 2, 7}) {
    const double pitch = 2.0 * std::numbers::pi / count;
    for (int k = 0; k < 200; ++k) {
      const Vec3 p = axis.point + 10.0 * Vec3(std::sin(1.0 + k), std::cos(3.0 * k), std::sin(0.7 * k));
      int times = 0;
      for (int turns = 0; turns < count; ++turns) {
        const Vec3 there = axis.turn(turns * pitch) * p;
        times += is_within_pitch(there, axis, 2.5, pitch) ? 1 : 0;
      }
      EXPECT_EQ(times, 1) << count << " " << k;
    }
  }
}

}  // namespace
}  // namespace flank::internal
