#include "flank/trochoid/sides/side_room.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "flank/envelope/swept_estimate.h"

namespace flank::internal {
namespace {

constexpr int kPoses = 161;

struct Count {
  int reached = 0, all = 0;
};

double share_of(const Count& a, const Count& b) {
  return a.all + b.all > 0 ? static_cast<double>(a.reached + b.reached) / (a.all + b.all) : 1.0;
}

/// The motions of one side: of the left and the right one, in turn.
std::vector<RuledMotion> motions_of(const std::vector<RuledMotion>& motions, std::size_t side) {
  std::vector<RuledMotion> out;
  for (std::size_t k = side; k < motions.size(); k += 2) out.push_back(motions[k]);
  return out;
}

Count reached_by(const CavitySide& side, const std::vector<RuledMotion>& motions, const RadialFunction& tool) {
  Count out;
  const SweptEstimate swept(motions, tool, kPoses);
  for (const SurfaceSample& sample : side.target->samples(std::sqrt(side.target->area()) / 30.0)) {
    ++out.all;
    const SweptContact near = swept.nearest(sample.point);
    const Pose pose = motions[static_cast<std::size_t>(std::max(0, near.motion))].pose(near.t);
    const double s = std::clamp((sample.point - pose.tip).dot(pose.axis), 0.0, tool.axis_length());
    if (side.obstacles == nullptr || side.obstacles->reachable(sample, tool.at(s).r, side.obstacles->allowance_mm()))
      ++out.reached;
  }
  return out;
}

/// Of what is covered.
Count covered_by(const CavitySide& side, const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                 double tolerance, double radius) {
  constexpr double kSpacing = 1.0 / 60.0;  // of the size of the side
  Count out;
  const SweptEstimate swept(motions, tool, kPoses);
  for (const SurfaceSample& sample : side.target->samples(kSpacing * std::sqrt(side.target->area()))) {
    if (std::abs(swept.distance(sample.point)) > tolerance) continue;
    ++out.all;
    if (side.obstacles == nullptr || side.obstacles->reachable(sample, radius, side.obstacles->allowance_mm()))
      ++out.reached;
  }
  return out;
}

/// Of one layer, at one height.
double way_across(const RuledMotion& left, const RuledMotion& right, double s) {
  constexpr int kLeft = 24, kRight = 96;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kLeft; ++i) {
    const Vec3 from = left.pose(static_cast<double>(i) / kLeft).at(s);
    for (int j = 0; j <= kRight; ++j)
      least = std::min(least, (right.pose(static_cast<double>(j) / kRight).at(s) - from).norm());
  }
  return least;
}

}  // namespace

double blocked_share(const CavitySide& left, const CavitySide& right) {
  constexpr double kNear = 0.1, kFirst = 0.3,
                   kLast = 0.7;  // of the way across; nearer to its ends are the sides' own neighbours
  if (left.obstacles == nullptr) return 0.0;
  int blocked = 0, all = 0;
  for (const SurfaceSample& sample : left.target->samples(std::sqrt(left.target->area()) / 30.0)) {
    const Vec3 across = right.target->closest(sample.point).point - sample.point;
    const double near = kNear * across.norm();
    if (!left.obstacles->reachable(sample, near, left.obstacles->allowance_mm())) continue;
    ++all;
    for (double share = kFirst; share < kLast + 0.5 * kNear; share += kNear) {
      if (left.obstacles->at(sample.point + share * across, near).face < 0) continue;
      ++blocked;
      break;
    }
  }
  return all > 0 ? static_cast<double>(blocked) / all : 0.0;
}

double reach_of_tool(const CavitySide& left, const CavitySide& right, const std::vector<RuledMotion>& motions,
                     const RadialFunction& tool) {
  if (motions.size() < 2) return 0.0;
  return share_of(reached_by(left, motions_of(motions, 0), tool), reached_by(right, motions_of(motions, 1), tool));
}

double covered_in_reach(const CavitySide& left, const CavitySide& right, const std::vector<RuledMotion>& motions,
                        const RadialFunction& tool, double tolerance_mm, double radius_mm) {
  if (motions.size() < 2) return 1.0;
  return share_of(covered_by(left, motions_of(motions, 0), tool, tolerance_mm, radius_mm),
                  covered_by(right, motions_of(motions, 1), tool, tolerance_mm, radius_mm));
}

double lying(const std::vector<RuledMotion>& motions) {
  constexpr double kUpright = 1.3, kMost = 4.0;
  const double layers = std::max(1.0, std::floor(0.5 * static_cast<double>(motions.size())));
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < motions.size(); k += 2) {
    const double length = motions[k].axis_length;
    const double way = (motions[k].pose(1.0).at(0.5 * length) - motions[k].pose(0.0).at(0.5 * length)).norm();
    sum += std::clamp(layers * length / std::max(way, 1e-9) - kUpright, 0.0, kMost);
  }
  return sum / layers;
}

double least_way_across(const std::vector<RuledMotion>& motions, const RadialFunction& tool) {
  constexpr int kHeights = 8;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < motions.size(); k += 2)
    for (int j = 0; j <= kHeights; ++j) {
      const double s = tool.axis_length() * j / kHeights;
      least = std::min(least, way_across(motions[k], motions[k + 1], s) / (2.0 * tool.at(s).r));
    }
  return least;
}

}  // namespace flank::internal
