// Whose tool covers a place of what is open of a ring is always found, in its order, and few others are.
#include "flank/trochoid/stock/pose_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace flank::internal {
namespace {

constexpr double kBarrelLength = 30.0;

/// A tool that is thick in the middle and tapers.
ToolProfile barrel_profile() {
  return ToolProfile(RadialFunction(ToolFamily::kBarrel, kBarrelLength, Eigen::Vector3d(60.0, 6.0, 18.0)));
}

ToolRing ring_of(double z, double radius) {
  ToolRing ring;
  ring.z = z, ring.radius = radius;
  return ring;
}

/// Axes about the ring's, with slopes up to `slope` along each of x and y.
std::vector<NearPose> poses_around(std::size_t count, double slope, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-25.0, 25.0), tilt(-slope, slope), height(-20.0, 20.0);
  std::vector<NearPose> out(count);
  for (NearPose& pose : out) {
    pose.x0 = place(random);
    pose.y0 = place(random);
    pose.dx = tilt(random);
    pose.dy = tilt(random);
    pose.h0 = height(random);
    pose.dh = std::sqrt(1.0 + pose.slope2());
  }
  return out;
}

/// An open arc with the angles between which it lies.
struct Sector {
  double low, high;
  [[nodiscard]] OpenArc on(const ToolRing& ring) const {
    const auto at = [&](double angle) { return Vec2(ring.radius * std::cos(angle), ring.radius * std::sin(angle)); };
    return {at(low), at(high), high - low > 3.0};
  }
};

/// How deep the place of the ring at an angle lies in the tool, mm^2: one that hardly leans is a disc there, beside its
/// flank; others are not.
double depth2(const ToolProfile& tool, const NearPose& pose, const ToolRing& ring, double angle) {
  const Vec2 from(ring.radius * std::cos(angle) - pose.x0 - ring.z * pose.dx,
                  ring.radius * std::sin(angle) - pose.y0 - ring.z * pose.dy);
  const double height = pose.h0 + ring.z * pose.dh;
  const bool leans = pose.slope2() > kLeaning * kLeaning || height < tool.flank_low() || height > tool.flank_high();
  const double along = leans ? (pose.dx * from.x() + pose.dy * from.y()) / pose.dh : 0.0;
  ToolProfile::Place place;
  if (!tool.at(height + along, place)) return -1e300;
  return place.radius * place.radius - from.squaredNorm() + along * along;
}

/// The deepest of many places of the arcs.
double deepest2(const ToolProfile& tool, const NearPose& pose, const ToolRing& ring, const std::vector<Sector>& arcs) {
  constexpr int kPlaces = 400;
  double most = -1e300;
  for (const Sector& arc : arcs)
    for (int k = 0; k <= kPlaces; ++k)
      most = std::max(most, depth2(tool, pose, ring, std::lerp(arc.low, arc.high, static_cast<double>(k) / kPlaces)));
  return most;
}

/// Whether an upright tool holds an end of an arc, or its axis lies in the sector of one and it reaches the ring.
bool is_asked_for(const ToolProfile& tool, const NearPose& pose, const ToolRing& ring,
                  const std::vector<Sector>& arcs) {
  ToolProfile::Place place;
  if (!tool.at(pose.h0 + ring.z * pose.dh, place)) return false;
  const Vec2 o(pose.x0 + ring.z * pose.dx, pose.y0 + ring.z * pose.dy);
  return std::any_of(arcs.begin(), arcs.end(), [&](const Sector& sector) {
    const OpenArc arc = sector.on(ring);
    const bool inside =
        arc.wide || (arc.from.x() * o.y() > arc.from.y() * o.x() && o.x() * arc.to.y() > o.y() * arc.to.x());
    return (arc.from - o).norm() < place.radius || (arc.to - o).norm() < place.radius ||
           (inside && o.norm() < ring.radius + place.radius);
  });
}

struct Found {
  int covering = 0;              ///< poses that cover something
  std::vector<std::size_t> all;  ///< by the filter
};

/// Fails where the filter leaves out a pose that covers something.
Found look(const std::vector<NearPose>& poses, const ToolRing& ring, const std::vector<Sector>& arcs) {
  const ToolProfile tool = barrel_profile();
  std::vector<OpenArc> open;
  for (const Sector& arc : arcs) open.push_back(arc.on(ring));
  PoseFilter filter(tool);
  filter.take(poses);
  const std::vector<std::size_t> found = filter.reaching(ring, open);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  Found out{0, found};
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const double deep = deepest2(tool, poses[k], ring, arcs);
    if (deep <= 0.0) continue;
    ++out.covering;
    EXPECT_TRUE(std::binary_search(found.begin(), found.end(), k)) << k << " covers by " << deep << " mm^2";
  }
  return out;
}

const std::vector<std::vector<Sector>> kOpenArcs = {
    {{-0.4, 0.3}}, {{1.0, 1.01}, {-2.0, -0.5}}, {{2.5, 5.4}}, {{-1.5, 1.6}}, {{-3.1, 3.1}}};

TEST(PoseFilter, LeavesNoUprightToolOutAndAddsFew) {
  constexpr double kMostAdded = 0.05;
  const ToolProfile tool = barrel_profile();
  const std::vector<NearPose> poses = poses_around(4001, 0.03, 1);
  for (const double z : {-3.0, 0.0, 13.0, 31.0})
    for (const std::vector<Sector>& arcs : kOpenArcs) {
      const ToolRing ring = ring_of(z, 6.5);
      const Found found = look(poses, ring, arcs);
      EXPECT_GT(found.covering, 50);
      const auto added = std::count_if(found.all.begin(), found.all.end(),
                                       [&](std::size_t k) { return !is_asked_for(tool, poses[k], ring, arcs); });
      EXPECT_LE(static_cast<double>(added), kMostAdded * static_cast<double>(found.all.size())) << z;
    }
}

TEST(PoseFilter, LeavesNoToolOutThatHardlyLeansOverItsPole) {
  const ToolProfile tool = barrel_profile();
  std::vector<NearPose> poses = poses_around(4001, 0.03, 8);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> beside(-0.3, 0.6);
  for (NearPose& pose : poses) pose.h0 = tool.low() + beside(random);
  for (const std::vector<Sector>& arcs : kOpenArcs) EXPECT_GT(look(poses, ring_of(0.0, 6.5), arcs).covering, 5);
}

TEST(PoseFilter, LeavesNoLeaningToolOut) {
  const std::vector<NearPose> poses = poses_around(2003, 0.5, 2);
  for (const double z : {-3.0, 13.0, 31.0})
    for (const std::vector<Sector>& arcs : kOpenArcs) EXPECT_GT(look(poses, ring_of(z, 8.0), arcs).covering, 40);
}

TEST(PoseFilter, AToolThatEndsBelowDoesNotReach) {
  std::vector<NearPose> poses = poses_around(50, 0.0, 3);
  for (NearPose& pose : poses) pose.h0 = kBarrelLength + 20.0;
  EXPECT_TRUE(look(poses, ring_of(0.0, 6.5), {{-3.1, 3.1}}).all.empty());
}

TEST(PoseFilter, KeepsNothingOfTheRowBefore) {
  const std::vector<NearPose> poses = poses_around(300, 0.2, 4);
  const ToolRing ring = ring_of(4.0, 7.0);
  const std::vector<OpenArc> open = {Sector{-0.8, 0.9}.on(ring)};
  const ToolProfile tool = barrel_profile();
  PoseFilter fresh(tool), used(tool);
  fresh.take(poses);
  used.take(poses_around(400, 0.2, 5));
  used.take(poses);
  EXPECT_FALSE(fresh.reaching(ring, open).empty());
  EXPECT_EQ(used.reaching(ring, open), fresh.reaching(ring, open));
}

/// Of every ring of a group: whoever covers something of it is among those of the group.
void look_at_group(const std::vector<NearPose>& poses, const std::vector<Sector>& arcs, double low, double high) {
  const ToolProfile tool = barrel_profile();
  PoseFilter filter(tool);
  filter.take(poses);
  const double middle = 0.5 * (low + high);
  const ToolRing mean = ring_of(middle, 6.4);
  const RingGroup group{middle, 0.5 * (high - low), mean.radius, 0.2};
  std::vector<OpenArc> open;
  for (const Sector& arc : arcs) open.push_back(arc.on(mean));
  const std::vector<std::size_t> found = filter.reaching(group, open);
  EXPECT_LT(found.size(), poses.size());
  int covering = 0;
  for (const double share : {0.0, 0.4, 1.0})
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const ToolRing ring = ring_of(std::lerp(low, high, share), std::lerp(6.2, 6.6, share));
      if (deepest2(tool, poses[k], ring, arcs) <= 0.0) continue;
      ++covering;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), k)) << k << " at " << share;
    }
  EXPECT_GT(covering, 20);
}

TEST(PoseFilter, AGroupOfRingsLeavesNoToolOut) {
  const double height = PoseFilter(barrel_profile()).group_height();
  EXPECT_GT(height, 3.0);
  for (const double slope : {0.03, 0.5})
    for (const double low : {-4.0, 8.0, 28.0})
      for (const std::vector<Sector>& arcs : {kOpenArcs[0], kOpenArcs[1]})
        look_at_group(poses_around(800, slope, 7), arcs, low, low + height);
}

TEST(PoseFilter, SomeOfAnotherFilterReachAsTheyDoThere) {
  const ToolRing ring = ring_of(4.0, 7.0);
  const std::vector<OpenArc> open = {Sector{-0.8, 0.9}.on(ring)};
  PoseFilter all(barrel_profile()), some(barrel_profile());
  all.take(poses_around(300, 0.2, 4));
  const std::vector<std::size_t> found = all.reaching(ring, open);
  ASSERT_FALSE(found.empty());
  some.take(all, found);
  EXPECT_EQ(some.reaching(ring, open).size(), found.size());
}

TEST(PoseFilter, WhereNothingIsOpenNothingReaches) {
  const ToolProfile tool = barrel_profile();
  PoseFilter filter(tool);
  filter.take(poses_around(10, 0.2, 6));
  EXPECT_TRUE(filter.reaching(ring_of(0.0, 6.5), {}).empty());
}

}  // namespace
}  // namespace flank::internal
