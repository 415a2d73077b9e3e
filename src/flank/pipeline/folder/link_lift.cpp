#include "flank/pipeline/folder/link_lift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr std::size_t kDirections = 16;
/// Of the lift: where there is no room for all of it.
constexpr std::array<double, 2> kShares{1.0, 0.25};
/// None, then straight ways round the axis, then arcs.
constexpr std::size_t kStraight = kDirections * kShares.size() + 1, kWays = 2 * kStraight - 1;
constexpr double kNoWay = -1e300;  ///< in the place of a distance

/// The least distance of the tool on these poses from the samples, up to `enough`; any value below `refused` if there is one.
double least_distance(const SweptVolume& tool, std::vector<Pose> poses, const std::vector<FaceSamples>& samples,
                      double enough, double refused = -1e300) {
  Path path;
  path.strips.push_back({1, kLinkKind, "", std::move(poses)});
  const SweptVolume volume(tool, path);
  double least = enough;
  for (const FaceSamples& face : samples)
    for (const Vec3& p : face.points) {
      least = std::min(least, volume.distance(p, least).f);
      if (least < refused) return least;
    }
  return least;
}

/// The second half of a lead: on the first the tool is where it has just cut.
std::vector<Pose> second_half(const std::vector<Pose>& out) {
  if (out.size() < 2) return out;
  std::vector<Pose> poses;
  if (out.size() == 2) poses.push_back({0.5 * (out[0].tip + out[1].tip), out[0].axis});
  poses.insert(poses.end(), out.begin() + static_cast<std::ptrdiff_t>(out.size() / 2), out.end());
  return poses;
}

/// On a lead and on the way from it to the sphere.
double least_on_way(const SweptVolume& tool, const StripEnd& end, const Lead& lead,
                    const std::vector<FaceSamples>& samples, const LinkOptions& links, double enough,
                    double refused = -1e300) {
  std::vector<Pose> poses = second_half(lead_out(end.contact, lead));
  const std::vector<Pose> rest = way_to_sphere(poses.back(), lead, links);
  poses.insert(poses.end(), rest.begin() + 1, rest.end());
  return least_distance(tool, std::move(poses), samples, enough, refused);
}

/// The k-th lead; nothing that is off the surface for an arc whose plane the motion leaves.
Lead lead_of(const StripEnd& end, std::size_t k, double lift_mm) {
  if (k == 0) return {};
  const bool arc = k >= kStraight;
  const std::size_t way = (arc ? k - kStraight : k - 1);
  const Vec3& axis = end.contact.axis;
  const Vec3 side = axis.unitOrthogonal(), other = axis.cross(side);
  const double angle = 2.0 * std::numbers::pi * static_cast<double>(way % kDirections) / kDirections;
  Vec3 off = std::cos(angle) * side + std::sin(angle) * other;
  const double lift = kShares[way / kDirections] * lift_mm;
  if (!arc) return {lift * off};
  // An arc leaves square to the motion: of the directions the one nearest to that, on either side, or all would give the same two arcs.
  constexpr double kHalfStep = std::numbers::pi / kDirections, kRounding = 1e-9;
  off -= off.dot(end.going) * end.going;
  if (end.going.isZero() || off.norm() < std::cos(kHalfStep) - kRounding) return {};
  return {lift * off.normalized(), end.motion};
}

/// Those that there are, the best first.
std::vector<std::size_t> best_first(const double* distances) {
  const double *arcs = distances + kStraight, *end = distances + kWays;
  const double straight = *std::max_element(distances, arcs), arc = *std::max_element(arcs, end);
  const bool tangent = arc > 0.0 && arc >= 0.5 * straight;
  std::vector<std::size_t> ways;
  for (std::size_t k = 0; k < kWays; ++k)
    if (distances[k] != kNoWay) ways.push_back(k);
  std::stable_sort(ways.begin(), ways.end(), [&](std::size_t a, std::size_t b) {
    const bool arc_a = a >= kStraight, arc_b = b >= kStraight;
    return arc_a != arc_b ? arc_a == tangent : distances[a] > distances[b];
  });
  return ways;
}

/// Directions in which a tool may leave, the axis apart: leaning from it by steps of 15 degrees up to across it, all round.
/// Those in which the strip was going come first.
std::vector<Vec3> directions_of(const StripEnd& end) {
  constexpr int kLeans = 6, kRound = 12;
  const Vec3& axis = end.contact.axis;
  Vec3 forward = end.going - axis.dot(end.going) * axis;
  if (!(forward.norm() > 1e-9)) forward = axis.unitOrthogonal();
  forward.normalize();
  const Vec3 side = axis.cross(forward);
  std::vector<Vec3> directions;
  for (int lean = 1; lean <= kLeans; ++lean)
    for (int k = 0; k < kRound; ++k) {
      const double tilt = 0.5 * std::numbers::pi * lean / kLeans, turn = 2.0 * std::numbers::pi * k / kRound;
      directions.push_back(
          (std::cos(tilt) * axis + std::sin(tilt) * (std::cos(turn) * forward + std::sin(turn) * side)).normalized());
    }
  return directions;
}

double length_of(const std::vector<Pose>& way) {
  double length = 0.0;
  for (std::size_t k = 1; k < way.size(); ++k) length += (way[k].tip - way[k - 1].tip).norm();
  return length;
}

/// Beginning and end of each strip, at both of which the tool goes on past it: at the beginning backwards.
std::vector<StripEnd> ends_of(const Path& path, double axis_length) {
  std::vector<StripEnd> ends;
  const auto end_of = [&](const Pose& last, const Pose& before) {
    const PoseVelocity step{last.tip - before.tip, last.axis - before.axis};
    const Vec3 middle = step.at(0.5 * axis_length);
    const double way = middle.norm();
    return way > 0.0 ? StripEnd{last, {step.tip / way, step.axis / way}, middle / way} : StripEnd{last};
  };
  for (const Strip& strip : path.strips) {
    const std::vector<Pose>& poses = strip.poses;
    const Pose &second = poses[std::min<std::size_t>(1, poses.size() - 1)],
               &before = poses[poses.size() > 1 ? poses.size() - 2 : 0];
    ends.push_back(end_of(poses.front(), second));
    ends.push_back(end_of(poses.back(), before));
  }
  return ends;
}

/// The poses of a strip from one of its ends to the other, moved by `off`, which turns with the tool.
std::vector<Pose> along_strip(std::vector<Pose> poses, bool from_end, const Vec3& off) {
  if (from_end) std::reverse(poses.begin(), poses.end());
  Vec3 lift = off;
  for (Pose& pose : poses) {
    // Across the axis wherever it points by now.
    lift -= lift.dot(pose.axis) * pose.axis;
    if (lift.norm() > 1e-12) lift *= off.norm() / lift.norm();
    pose.tip += lift;
  }
  return poses;
}

}  // namespace

LeadSearch::LeadSearch(const Tool& tool, const Path& strips, const std::vector<FaceSamples>& samples, double lift_mm,
                       double tolerance_mm, const LinkOptions& links)
    : tool_(tool, Path{{{1, kLinkKind, "", {{Vec3::Zero(), Vec3::UnitZ()}}}}}),
      samples_(samples),
      links_(links),
      ends_(ends_of(strips, tool.radial.axis_length())),
      lift_mm_(lift_mm),
      tolerance_mm_(tolerance_mm),
      ways_(ends_.size()),
      chosen_(ends_.size(), 0) {
  std::vector<double> distances(ends_.size() * kWays);
  parallel_for(distances.size(), [&](std::size_t i) {
    const StripEnd& end = ends_[i / kWays];
    const Lead lead = lead_of(end, i % kWays, lift_mm);
    const bool no_arc = i % kWays >= kStraight && !lead.is_arc();
    distances[i] = no_arc ? kNoWay : least_on_way(tool_, end, lead, samples_, links_, 2.0 * lift_mm_);
  });
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    const double* const of_end = distances.data() + e * kWays;
    for (const std::size_t k : best_first(of_end)) ways_[e].push_back({lead_of(ends_[e], k, lift_mm), of_end[k]});
    // A tangent arc goes first for its mark, not for its room: one that cuts stays behind what does not.
    std::stable_partition(ways_[e].begin(), ways_[e].end(),
                          [&](const Way& way) { return way.distance >= -tolerance_mm_; });
    if (!free(e)) leave_otherwise(e);
  }
  go_back(strips);
}

/// Out of the part in other directions, from where the tool touches and from the two places beside it with most room.
void LeadSearch::leave_otherwise(std::size_t end) {
  constexpr std::size_t kPlaces = 3;
  const StripEnd& at = ends_[end];
  std::vector<Way> places(kStraight);
  parallel_for(places.size(), [&](std::size_t k) {
    const Lead lead = lead_of(at, k, lift_mm_);
    places[k] = {lead, least_distance(tool_, second_half(lead_out(at.contact, lead)), samples_, 2.0 * lift_mm_)};
  });
  // The first is that of the contact itself.
  std::stable_sort(places.begin() + 1, places.end(),
                   [](const Way& a, const Way& b) { return a.distance > b.distance; });
  const std::vector<Vec3> directions = directions_of(at);
  std::vector<Way> others(kPlaces * directions.size());
  std::vector<double> lengths(others.size());
  parallel_for(others.size(), [&](std::size_t i) {
    Way& way = others[i];
    way.lead = places[i % kPlaces].lead;
    way.lead.out = directions[i / kPlaces];
    way.distance = least_on_way(tool_, at, way.lead, samples_, links_, 2.0 * lift_mm_, -tolerance_mm_);
    const std::vector<Pose> out = lead_out(at.contact, way.lead);
    lengths[i] = length_of(out) + length_of(way_to_sphere(out.back(), way.lead, links_));
  });
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < others.size(); ++i)
    if (others[i].distance >= -tolerance_mm_) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return lengths[a] < lengths[b]; });
  std::vector<Way> free_ones;
  for (const std::size_t i : order) free_ones.push_back(others[i]);
  ways_[end].insert(ways_[end].begin(), free_ones.begin(), free_ones.end());
}

/// Where an end has no way out of its own and the other end of the strip has one.
void LeadSearch::go_back(const Path& strips) {
  std::vector<bool> own(ends_.size());
  for (std::size_t e = 0; e < ends_.size(); ++e) own[e] = free(e);
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    const std::size_t other = e ^ std::size_t{1};
    if (own[e] || !own[other]) continue;
    const std::vector<Pose>& poses = strips.strips[e / 2].poses;
    const bool at_end = e % 2 == 1;
    const Lead& out = ways_[other].front().lead;
    // Off the surface where there is room: each of the straight leads; and on it, where it has been cut.
    std::vector<Way> ways(kStraight);
    parallel_for(ways.size(), [&](std::size_t k) {
      Way& way = ways[k];
      way.distance = kNoWay;
      if (k == 0 && !at_end) return;
      way.lead.back = along_strip(poses, at_end, lead_of(ends_[e], k, lift_mm_).off);
      way.lead.out = out.out;
      if (k == 0) {
        way.lead.off = out.off;
        way.lead.along = out.along;
      } else if (const std::vector<Pose> from_other = lead_out(ends_[other].contact, out); from_other.size() > 1) {
        way.lead.back.push_back(from_other.back());
      }
      way.distance = least_distance(tool_, way.lead.back, samples_, 2.0 * lift_mm_, -tolerance_mm_);
    });
    std::stable_sort(ways.begin() + 1, ways.end(), [](const Way& a, const Way& b) { return a.distance > b.distance; });
    std::rotate(ways.begin(), ways.begin() + 1, ways.end());
    std::vector<Way> free_ones;
    for (Way& way : ways)
      if (way.distance >= -tolerance_mm_) free_ones.push_back(std::move(way));
    ways_[e].insert(ways_[e].begin(), free_ones.begin(), free_ones.end());
  }
}

bool LeadSearch::next(std::size_t end) {
  if (chosen_[end] + 1 >= ways_[end].size()) return false;
  ++chosen_[end];
  return true;
}

}  // namespace flank::internal
