#include "flank/envelope/swept_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "flank/base/assert.h"

namespace flank::internal {

namespace {

/// Intervals of s at which r is tabulated: linear between them, so off by (L / 256)^2 / 8 of r'', 2e-6 L^2 r''. An
/// estimate needs no more, and it is asked for millions of times.
constexpr int kTable = 256;
/// Least 1 - r'^2: |r'| >= 1 is no tool, but a fit may pass through it.
constexpr double kLeastCosineSquared = 1e-6;

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
  table_.resize(kTable + 1);
  for (int k = 0; k <= kTable; ++k) {
    const RadialJet jet = radial.at(axis_length_ * k / kTable);
    Row& row = table_[static_cast<std::size_t>(k)];
    row.radius = jet.r;
    row.slope = jet.d1 / std::sqrt(std::max(kLeastCosineSquared, 1.0 - jet.d1 * jet.d1));
    if (k == 0) continue;
    Row& before = table_[static_cast<std::size_t>(k) - 1];
    before.more_radius = row.radius - before.radius;
    before.more_slope = row.slope - before.slope;
  }
  least_radius_ = radial.smallest();
  largest_radius_ = radial.largest();
  if (!std::isnan(least_radius_)) return;
  // A fit may pass through parameters that leave r without a value somewhere: the range of the table's values then.
  least_radius_ = largest_radius_ = table_.front().radius;
  for (const Row& row : table_) {
    least_radius_ = std::min(least_radius_, row.radius);
    largest_radius_ = std::max(largest_radius_, row.radius);
  }
}

double SweptEstimate::at_pose(const Pose& pose, const Vec3& x) const {
  const Vec3 q = x - pose.tip;
  const double z = q.dot(pose.axis);
  if (std::isnan(z)) return z;  // of a pose without a value: no place of the table
  const double rho2 = std::max(0.0, q.squaredNorm() - z * z);
  const double rho = std::sqrt(rho2);
  // The sphere that touches x is at s = z + r' rho / sqrt(1 - r'^2): steps of Newton, or of the fixed point where a hollow profile has
  // several such spheres. f is off by the square of the last step over twice rho.
  constexpr double kLeastSlope = 0.3, kSettled = 0.25;  // no unit; intervals of the table
  constexpr int kMostSteps = 4;
  double s = std::clamp(z, 0.0, axis_length_), share = 0.0;
  const Row* row = nullptr;
  const auto look_up = [&] {
    const double place = s * per_length_;
    const int k = std::min(static_cast<int>(place), kTable - 1);
    share = place - k;
    row = table_.data() + k;
  };
  double last = 1.0;
  for (int k = 0; k < kMostSteps && !(std::abs(last) < kSettled); ++k) {
    look_up();
    const double slope = 1.0 - rho * row->more_slope * per_length_;
    const double step = z + rho * (row->slope + share * row->more_slope) - s;
    const double next = std::clamp(s + step / (slope > kLeastSlope ? slope : 1.0), 0.0, axis_length_);
    last = (next - s) * per_length_;
    s = next;
  }
  if (std::isnan(s)) return s;  // of a radial function without a value
  look_up();
  double least = std::sqrt(rho2 + (z - s) * (z - s)) - (row->radius + share * row->more_radius);
  // A profile that flares at an end, where nothing held it, has a second nearest sphere there. Mostly it has not, and no root is needed
  // to know it.
  const double past = z - axis_length_;
  for (const auto& [square, radius] :
       {std::pair(rho2 + z * z, table_.front().radius), std::pair(rho2 + past * past, table_.back().radius)}) {
    const double reach = least + radius;
    if (reach > 0.0 && square < reach * reach) least = std::sqrt(square) - radius;
  }
  return least;
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

SweptEstimate::Tabulated SweptEstimate::nearest_pose(std::size_t motion, const Vec3& x, const Tabulated& bound) const {
  const std::vector<Pose>& poses = poses_[motion];
  Tabulated best = bound;
  // From pose to pose f changes by no more than the axis travels: far poses are jumped over.
  for (std::size_t i = 0; i < poses.size();) {
    double f = floor_at(poses[i], x);
    if (!(f >= best.f)) {
      f = at_pose(poses[i], x);
      if (f < best.f) best = {i, f};
    }
    i = next_pose(motion, i, f - best.f);
  }
  return best;
}

SweptEstimate::Tabulated SweptEstimate::nearest_pose(std::size_t motion, const Vec3& x) const {
  const std::vector<Pose>& poses = poses_[motion];
  // Every twelfth pose first: a low value early lets the walk take long jumps.
  constexpr std::size_t kCoarse = 12;
  Tabulated best;
  for (std::size_t i = kCoarse / 2; i < poses.size(); i += kCoarse) {
    if (floor_at(poses[i], x) >= best.f) continue;
    const double f = at_pose(poses[i], x);
    if (f < best.f) best = {i, f};
  }
  return nearest_pose(motion, x, best);
}

SweptEstimate::Tabulated SweptEstimate::at_hint(const SweptContact& hint, const Vec3& x) const {
  const auto at = static_cast<std::size_t>(std::lround(std::clamp(hint.t, 0.0, 1.0) / spacing()));
  return {at, at_pose(poses_[static_cast<std::size_t>(hint.motion)][at], x)};
}

double SweptEstimate::slack(std::size_t motion) const {
  // A sphere of radius r that passes x half-way between two poses comes nearer by about stride^2 / (8 r).
  // A radial function that is no tool (r <= 0 somewhere) must not make it negative: then nothing would be nearest.
  constexpr double kLeastRadiusShare = 1e-3;
  const double radius = std::max(least_radius_, kLeastRadiusShare * axis_length_);
  return stride_[motion] * stride_[motion] / (8.0 * radius);
}

double SweptEstimate::bound(const Vec3& x, const SweptContact& hint) const {
  if (hint.motion >= 0) return at_hint(hint, x).f + slack(static_cast<std::size_t>(hint.motion));
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < poses_.size(); ++m) bound = std::min(bound, nearest_pose(m, x).f + slack(m));
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

SweptContact SweptEstimate::nearest(const Vec3& x, const SweptContact& hint) const {
  SweptContact best;
  best.f = std::numeric_limits<double>::infinity();
  const auto look = [&](std::size_t m) {
    const std::size_t none = poses_[m].size();
    Tabulated least{none, best.f + slack(m)};
    if (hint.motion == static_cast<int>(m)) least = at_hint(hint, x);
    least = std::isfinite(least.f) ? nearest_pose(m, x, least) : nearest_pose(m, x);
    if (least.at == none) return;  // nothing nearer than that of another motion
    const SweptContact found = at_vertex(m, least, x);
    if (found.f < best.f) best = found;
  };
  // A motion that is near keeps the search of the others short.
  if (hint.motion >= 0) look(static_cast<std::size_t>(hint.motion));
  for (std::size_t m = 0; m < poses_.size(); ++m)
    if (hint.motion != static_cast<int>(m)) look(m);
  return best;
}

SweptContact SweptEstimate::at_vertex(std::size_t motion, const Tabulated& least, const Vec3& x) const {
  const std::vector<Pose>& poses = poses_[motion];
  SweptContact found;
  found.motion = static_cast<int>(motion);
  found.f = least.f;
  double t = static_cast<double>(least.at);
  if (least.at > 0 && least.at + 1 < poses.size()) {
    const double a = at_pose(poses[least.at - 1], x), b = at_pose(poses[least.at + 1], x);
    const double bend = a + b - 2.0 * least.f;
    if (bend > 0.0) {
      found.f -= (a - b) * (a - b) / (8.0 * bend);
      t += 0.5 * (a - b) / bend;
    }
  }
  found.t = t * spacing();
  return found;
}

}  // namespace flank::internal
