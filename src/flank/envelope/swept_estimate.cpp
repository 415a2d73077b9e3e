#include "flank/envelope/swept_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"

namespace flank::internal {

namespace {

/// Intervals of s at which r is tabulated: linear between them, so off by (L / 256)^2 / 8 of r'', 2e-6 L^2 r''. An
/// estimate needs no more, and it is asked for millions of times.
constexpr int kTable = 256;
/// Least 1 - r'^2: |r'| >= 1 is no tool, but a fit may pass through it.
constexpr double kLeastCosineSquared = 1e-6;

double interpolate(const std::vector<double>& table, double x) {
  if (std::isnan(x)) return x;  // of a pose without a value: no place of the table
  const int k = std::min(static_cast<int>(x), kTable - 1);
  const double f = x - k;
  return table[k] + f * (table[k + 1] - table[k]);
}
}  // namespace

SweptEstimate::SweptEstimate(const std::vector<RuledMotion>& motions, const RadialFunction& radial, int poses)
    : refiner_(motions, radial), axis_length_(radial.axis_length()), per_length_(kTable / radial.axis_length()) {
  FLANK_ASSERT(poses >= 2);
  for (const RuledMotion& motion : motions) {
    std::vector<Pose>& table = poses_.emplace_back();
    for (int i = 0; i < poses; ++i) table.push_back(motion.pose(static_cast<double>(i) / (poses - 1)));
    double& stride = stride_.emplace_back(0.0);
    std::vector<double>& travel = travel_.emplace_back(1, 0.0);
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
      // The farthest that a point of the axis moves between two poses joined by straight lines is at an end.
      double step = 0.0;
      for (const double s : {0.0, axis_length_}) step = std::max(step, (table[i + 1].at(s) - table[i].at(s)).norm());
      stride = std::max(stride, step);
      travel.push_back(travel.back() + step);
    }
  }
  for (int k = 0; k <= kTable; ++k) {
    const RadialJet jet = radial.at(axis_length_ * k / kTable);
    radius_.push_back(jet.r);
    slope_over_cosine_.push_back(jet.d1 / std::sqrt(std::max(kLeastCosineSquared, 1.0 - jet.d1 * jet.d1)));
  }
  least_radius_ = radial.smallest();
  largest_radius_ = radial.largest();
  if (!std::isnan(least_radius_)) return;
  // A fit may pass through parameters that leave r without a value somewhere: the range of the table's values then.
  least_radius_ = largest_radius_ = radius_.front();
  for (const double r : radius_) {
    least_radius_ = std::min(least_radius_, r);
    largest_radius_ = std::max(largest_radius_, r);
  }
}

double SweptEstimate::at_pose(const Pose& pose, const Vec3& x) const {
  const Vec3 q = x - pose.tip;
  const double z = q.dot(pose.axis);
  const double rho2 = std::max(0.0, q.squaredNorm() - z * z);
  const double rho = std::sqrt(rho2);
  // The sphere that touches x is at s = z + r' rho / sqrt(1 - r'^2). Two fixed-point steps: r' varies little over the
  // second.
  double s = std::clamp(z, 0.0, axis_length_);
  for (int k = 0; k < 2; ++k)
    s = std::clamp(z + rho * interpolate(slope_over_cosine_, s * per_length_), 0.0, axis_length_);
  const double near = std::sqrt(rho2 + (z - s) * (z - s)) - interpolate(radius_, s * per_length_);
  // A profile that flares at an end, where nothing held it, has a second nearest sphere there.
  const double past = z - axis_length_;
  return std::min({near, std::sqrt(rho2 + z * z) - radius_.front(), std::sqrt(rho2 + past * past) - radius_.back()});
}

double SweptEstimate::floor_at(const Pose& pose, const Vec3& x) const {
  // As if the tool had its largest radius everywhere: the distance to the axis, no radial function.
  const Vec3 q = x - pose.tip;
  const double z = q.dot(pose.axis), off = z - std::clamp(z, 0.0, axis_length_);
  return std::sqrt(std::max(0.0, q.squaredNorm() - z * z) + off * off) - largest_radius_;
}

std::size_t SweptEstimate::next_pose(std::size_t motion, std::size_t at, double spare) const {
  // f is 1-Lipschitz in the travel of the axis. at_pose is f but for what its two steps in s leave: a tenth is kept for
  // it.
  constexpr double kSure = 0.9;
  const std::vector<double>& travel = travel_[motion];
  // A pose without a value says nothing of the others.
  if (std::isnan(spare)) return at + 1;
  const double until = travel[at] + kSure * spare;
  // Most jumps are short where the tool is near: a few steps first, before the rest is halved.
  constexpr std::size_t kShort = 4;
  const std::size_t near = std::min(travel.size(), at + 1 + kShort);
  for (std::size_t i = at + 1; i < near; ++i)
    if (until < travel[i]) return i;
  const auto first = travel.begin() + static_cast<std::ptrdiff_t>(near);
  return static_cast<std::size_t>(std::upper_bound(first, travel.end(), until) - travel.begin());
}

std::size_t SweptEstimate::nearest_pose(std::size_t motion, const Vec3& x, double& least) const {
  const std::vector<Pose>& poses = poses_[motion];
  // Every twelfth pose first: a low value early lets the walk below take long jumps.
  constexpr std::size_t kCoarse = 12;
  std::size_t at = 0;
  least = std::numeric_limits<double>::infinity();
  const auto look = [&](std::size_t i) {
    double f = floor_at(poses[i], x);
    if (f >= least) return f;
    f = at_pose(poses[i], x);
    if (f < least) {
      least = f;
      at = i;
    }
    return f;
  };
  for (std::size_t i = kCoarse / 2; i < poses.size(); i += kCoarse) look(i);
  // From pose to pose f changes by no more than the axis travels: far poses are jumped over.
  for (std::size_t i = 0; i < poses.size();) {
    const double f = look(i);
    i = next_pose(motion, i, f - least);
  }
  return at;
}

double SweptEstimate::slack(std::size_t motion) const {
  // A sphere of radius r that passes x half-way between two poses comes nearer by about stride^2 / (8 r).
  // A radial function that is no tool (r <= 0 somewhere) must not make it negative: then nothing would be nearest.
  constexpr double kLeastRadiusShare = 1e-3;
  const double radius = std::max(least_radius_, kLeastRadiusShare * axis_length_);
  return stride_[motion] * stride_[motion] / (8.0 * radius);
}

double SweptEstimate::bound(const Vec3& x, const SweptContact& hint) const {
  double bound = std::numeric_limits<double>::infinity();
  if (hint.motion >= 0) {
    const auto m = static_cast<std::size_t>(hint.motion);
    const double at = std::clamp(hint.t, 0.0, 1.0) / spacing();
    return at_pose(poses_[m][static_cast<std::size_t>(std::lround(at))], x) + slack(m);
  }
  for (std::size_t m = 0; m < poses_.size(); ++m) {
    double f = 0.0;
    (void)nearest_pose(m, x, f);
    bound = std::min(bound, f + slack(m));
  }
  return bound;
}

void SweptEstimate::places(const Vec3& x, const SweptContact& hint, std::vector<SweptContact>& places) const {
  places.clear();
  double bound_f = bound(x, hint);
  for (std::size_t m = 0; m < poses_.size(); ++m) {
    std::size_t last = poses_[m].size();
    for (std::size_t i = 0; i < poses_[m].size();) {
      double f = floor_at(poses_[m][i], x);
      if (f <= bound_f) f = at_pose(poses_[m][i], x);
      if (f <= bound_f) {
        // A lower value lowers the bound for what follows; what came before it is sifted at the end.
        bound_f = std::min(bound_f, f + slack(m));
        const bool same_run = last + 1 == i && !places.empty() && places.back().motion == static_cast<int>(m);
        if (!same_run) places.emplace_back();
        if (!same_run || f < places.back().f) {
          places.back().motion = static_cast<int>(m);
          places.back().t = static_cast<double>(i) * spacing();
          places.back().f = f;
        }
        last = i++;
        continue;
      }
      i = next_pose(m, i, f - bound_f);
    }
  }
  std::erase_if(places, [&](const SweptContact& place) { return place.f > bound_f; });
  if (!places.empty()) return;
  // A radial function steeper than any tool, as a step of a fit may have it, is not 1-Lipschitz: the walk may have
  // jumped over all that is near.
  const SweptContact best = nearest(x);
  if (best.motion >= 0 && std::isfinite(best.f)) places.push_back(best);
}

SweptContact SweptEstimate::nearest(const Vec3& x) const {
  SweptContact best;
  best.f = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < poses_.size(); ++m) {
    const std::vector<Pose>& poses = poses_[m];
    double least = 0.0;
    const std::size_t at = nearest_pose(m, x, least);
    // Vertex of the parabola through the least pose and its neighbours: at a minimum f is smooth in t.
    double t = static_cast<double>(at);
    if (at > 0 && at + 1 < poses.size()) {
      const double a = at_pose(poses[at - 1], x), b = at_pose(poses[at + 1], x);
      const double bend = a + b - 2.0 * least;
      if (bend > 0.0) {
        least -= (a - b) * (a - b) / (8.0 * bend);
        t += 0.5 * (a - b) / bend;
      }
    }
    if (least >= best.f) continue;
    best.f = least;
    best.motion = static_cast<int>(m);
    best.t = t * spacing();
  }
  return best;
}

}  // namespace flank::internal
