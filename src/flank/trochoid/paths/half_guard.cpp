#include "flank/trochoid/paths/half_guard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "flank/base/work_count.h"

namespace flank::internal {

namespace {

/// Farthest that balls along the axis may be apart, of the largest radius: an edge between two of them goes unseen to a
/// depth of 3 % of the radius, and of 40 % where they are a diameter and a half apart.
constexpr double kApart = 0.5;
/// Of the largest radius: what is farther from the flank than this is not asked for its distance.
constexpr double kHorizon = 0.01;
/// How much longer the way between two samples may be than the line between them.
constexpr double kArc = 1.1;

/// Of `times` samples, or between two of them: densest at both ends of a half.
double sample_time(double i, int times) { return 0.5 - 0.5 * std::cos(std::numbers::pi * i / (times - 1)); }

/// Depths are looked for with their sign: nothing is near.
constexpr double kFar = -std::numeric_limits<double>::infinity();
constexpr GuardDepth kUnseen{kFar, kFar, kFar};

}  // namespace

HalfGuard::HalfGuard(GuardedFaces faces, const RadialFunction& radial)
    : faces_(std::move(faces)),
      radial_(radial),
      least_places_(static_cast<int>(std::ceil(radial.axis_length() / (kApart * radial.largest()))) + 1) {}

bool HalfGuard::has_faces() const {
  const auto is_there = [](const auto* face) { return face != nullptr; };
  return !faces_.sides.empty() || std::any_of(faces_.others.begin(), faces_.others.end(), is_there);
}

void HalfGuard::look(const Pose& pose, int places, GuardDepth& out) const {
  look(pose, places, kHorizon * radial_.largest(), out);
}

void HalfGuard::look(const Pose& pose, int places, double sight_mm, GuardDepth& out) const {
  const double length = radial_.axis_length();
  places = std::max(places, least_places_);
  const int asked = tips_alone_ ? places / 2 + 1 : places;
  // Most faces are far off, which is soon seen: three of these take about as long as a look.
  count_work(static_cast<std::uint64_t>(asked) * (faces_.sides.size() + faces_.others.size()) / 3);
  for (int j = 0; j < asked; ++j) {
    const double s = length * j / (places - 1), r = radial_.at(s).r, horizon = r + sight_mm;
    const Vec3 p = pose.at(s);
    for (const Target* side : faces_.sides) {
      const Footpoint foot = side->closest_within(p, horizon);
      if (foot.patch < 0) continue;
      // Behind a border's tangent plane a point is not yet in the material.
      const double d = foot.location == Location::kInside ? foot.distance : std::abs(foot.distance);
      out.sides = std::max(out.sides, r - d);
    }
    for (const ObstacleField* field : faces_.others) {
      if (field == nullptr) continue;
      const ObstacleDistance d = field->at(p, horizon);
      if (d.face < 0) continue;
      out.others = std::max(out.others, r - d.distance_mm);
      if (j <= places / 2) out.tip = std::max(out.tip, r - d.distance_mm);
    }
  }
}

std::vector<HalfGuard::Sample> HalfGuard::samples(const RuledMotion& motion, int times, int places) const {
  // Densest at both ends, where a half leaves a side at a tangent: what it enters, it enters there, for a moment.
  std::vector<Pose> poses;
  for (int i = 0; i < times; ++i) poses.push_back(motion.pose(sample_time(i, times)));
  const auto way = [&](std::size_t i, std::size_t k) {
    const double length = radial_.axis_length();
    return std::max((poses[i].tip - poses[k].tip).norm(), (poses[i].at(length) - poses[k].at(length)).norm());
  };
  std::vector<Sample> out(poses.size(), {kUnseen, 0.0});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    // No place of the axis gets nearer to a face than by its way: half way to the next sample it is nearest to one of both.
    const double before = i > 0 ? way(i - 1, i) : 0.0, after = i + 1 < poses.size() ? way(i, i + 1) : 0.0;
    out[i].rise_mm = kArc * 0.5 * std::max(before, after);
    look(poses[i], places, std::max(out[i].rise_mm, kHorizon * radial_.largest()), out[i].depth);
  }
  return out;
}

void HalfGuard::look_closer(const RuledMotion& motion, int times, int at, int places, GuardDepth& out) const {
  constexpr int kCloser = 4;
  std::array<GuardDepth, 2 * kCloser + 1> depths;
  const auto closer = [&](double k) {
    const double i = std::clamp(at + k / kCloser, 0.0, times - 1.0);
    GuardDepth here = kUnseen;
    look(motion.pose(sample_time(i, times)), 2 * places - 1, here);
    out.add(here);
    return here;
  };
  for (int k = -kCloser; k <= kCloser; ++k) depths[static_cast<std::size_t>(k + kCloser)] = closer(k);
  for (double GuardDepth::*kind : {&GuardDepth::sides, &GuardDepth::others}) {
    const auto peak = std::max_element(depths.begin() + 1, depths.end() - 1,
                                       [&](const GuardDepth& a, const GuardDepth& b) { return a.*kind < b.*kind; });
    const double before = (*(peak - 1)).*kind, most = (*peak).*kind, after = (*(peak + 1)).*kind;
    const double bend = before - 2.0 * most + after;
    if (!std::isfinite(bend) || !(bend < 0.0) || most < std::max(before, after)) continue;
    closer(static_cast<double>(peak - depths.begin()) - kCloser + 0.5 * (before - after) / bend);
  }
}

GuardDepth HalfGuard::depth(const RuledMotion& motion, int times, int places) const {
  const std::vector<Sample> seen = samples(motion, times, places);
  GuardDepth out;
  for (const Sample& sample : seen) out.add(sample.depth);
  // The deepest place lies between the samples, and may be a moment between two that enter nothing (a half turns back before a
  // wall): once more around each sample that is deeper than its neighbours, as long as it may hide a deeper place than is known.
  const auto peaks = [&](std::size_t i, double GuardDepth::*kind) {
    const double here = seen[i].depth.*kind;
    if (i > 0 && seen[i - 1].depth.*kind > here) return false;
    if (i + 1 < seen.size() && seen[i + 1].depth.*kind >= here) return false;
    return here + seen[i].rise_mm > out.*kind;
  };
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (peaks(i, &GuardDepth::sides) || peaks(i, &GuardDepth::others))
      look_closer(motion, times, static_cast<int>(i), places, out);
  return out;
}

}  // namespace flank::internal
