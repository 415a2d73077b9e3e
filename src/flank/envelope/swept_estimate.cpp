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
/// Poses that are looked at together: many enough that a block far off saves time, few enough that it is far off.
constexpr std::size_t kBlock = 16;

}  // namespace

SweptEstimate::Track SweptEstimate::make_track(const RuledMotion& motion, int poses) {
  Track track;
  for (int i = 0; i < poses; ++i) {
    track.poses.push_back(motion.pose(static_cast<double>(i) / (poses - 1)));
    const Pose& pose = track.poses.back();
    for (std::size_t c = 0; c < 3; ++c) {
      track.columns[c].push_back(pose.tip[static_cast<Eigen::Index>(c)]);
      track.columns[3 + c].push_back(pose.axis[static_cast<Eigen::Index>(c)]);
    }
  }
  // The farthest that a point of the axis moves between two poses is at an end.
  const auto travel = [&](std::size_t i, std::size_t k) {
    double most = 0.0;
    for (const double s : {0.0, motion.axis_length})
      most = std::max(most, (track.poses[i].at(s) - track.poses[k].at(s)).norm());
    return most;
  };
  for (std::size_t first = 0; first < track.poses.size(); first += kBlock) {
    const std::size_t last = std::min(first + kBlock, track.poses.size()), middle = (first + last) / 2;
    double& reach = track.reach.emplace_back(0.0);
    for (std::size_t i = first; i < last; ++i) reach = std::max(reach, travel(i, middle));
  }
  for (std::size_t i = 0; i + 1 < track.poses.size(); ++i) track.stride = std::max(track.stride, travel(i, i + 1));
  return track;
}

SweptEstimate::SweptEstimate(const std::vector<RuledMotion>& motions, const RadialFunction& radial, int poses)
    : refiner_(motions, radial), axis_length_(radial.axis_length()), per_length_(kTable / radial.axis_length()) {
  FLANK_ASSERT(poses >= 2);
  for (const RuledMotion& motion : motions) tracks_.push_back(make_track(motion, poses));
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
  for (const Row& row : table_) steepest_ = std::max(steepest_, std::abs(row.more_radius) * per_length_);
  steepest_ = std::min(steepest_, 1.0);
  cosine_ = std::sqrt(1.0 - steepest_ * steepest_);
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

double SweptEstimate::at_pose(const Pose& pose, const Vec3& x, double most) const {
  const Vec3 q = x - pose.tip;
  const double z = q.dot(pose.axis);
  if (std::isnan(z)) return z;  // of a pose without a value: no place of the table
  const double rho2 = std::max(0.0, q.squaredNorm() - z * z);
  const double rho = std::sqrt(rho2);
  // The sphere that touches x is at s = z + r' rho / sqrt(1 - r'^2): steps of Newton, or of the fixed point where a hollow profile has
  // several such spheres. f is off by the square of the last step over twice rho.
  constexpr double kLeastSlope = 0.3, kSettled = 0.25;  // no unit; intervals of the table
  constexpr int kMostSteps = 4;
  const double beside = std::clamp(z, 0.0, axis_length_);
  double s = beside, share = 0.0;
  const Row* row = nullptr;
  const auto look_up = [&] {
    const double place = s * per_length_;
    const int k = std::min(static_cast<int>(place), kTable - 1);
    share = place - k;
    row = table_.data() + k;
  };
  look_up();
  // The radius changes by no more than the steepest slope: no sphere is nearer than this.
  if (cosine_ * rho + steepest_ * std::abs(z - beside) - (row->radius + share * row->more_radius) > most)
    return std::numeric_limits<double>::infinity();
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

void SweptEstimate::squares(const Track& track, std::size_t block, const Vec3& x, double* out) const {
  const std::size_t first = block * kBlock, count = std::min(kBlock, track.poses.size() - first);
  const auto& [px, py, pz, ux, uy, uz] = track.columns;
  const double length = axis_length_;
  // One loop without a branch or a call, which the compiler turns into vectors.
  for (std::size_t k = 0, i = first; k < count; ++k, ++i) {
    const double qx = x.x() - px[i], qy = x.y() - py[i], qz = x.z() - pz[i];
    const double z = qx * ux[i] + qy * uy[i] + qz * uz[i];
    const double inside = z < 0.0 ? 0.0 : (z > length ? length : z), off = z - inside;
    out[k] = qx * qx + qy * qy + qz * qz - z * z + off * off;
  }
}

template <class Visit>
void SweptEstimate::visit_near(const Track& track, const Vec3& x, const double& most, const Visit& visit) const {
  std::array<double, kBlock> square;
  for (std::size_t block = 0; block < track.reach.size(); ++block) {
    const std::size_t first = block * kBlock, last = std::min(first + kBlock, track.poses.size());
    // No point of the axis is nearer than this; not a number: nothing is known.
    if (floor_at(track.poses[(first + last) / 2], x) - track.reach[block] > most) continue;
    squares(track, block, x, square.data());
    for (std::size_t i = first; i < last; ++i) {
      const double near = most + largest_radius_;
      if (near > 0.0 && square[i - first] > near * near) continue;
      visit(i);
    }
  }
}

SweptEstimate::Tabulated SweptEstimate::nearest_pose(const Track& track, const Vec3& x, const Tabulated& bound) const {
  Tabulated best = bound;
  visit_near(track, x, best.f, [&](std::size_t i) {
    const double f = at_pose(track.poses[i], x, best.f);
    if (f < best.f) best = {i, f};
  });
  return best;
}

SweptEstimate::Tabulated SweptEstimate::nearest_pose(const Track& track, const Vec3& x) const {
  // The middle of the block that seems nearest: a low value early leaves out most of the others.
  double least = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (std::size_t block = 0; block < track.reach.size(); ++block) {
    const std::size_t first = block * kBlock, i = (first + std::min(first + kBlock, track.poses.size())) / 2;
    const double floor = floor_at(track.poses[i], x);
    if (floor < least) least = floor, at = i;
  }
  const double f = at_pose(track.poses[at], x);
  const Tabulated best = f < std::numeric_limits<double>::infinity() ? Tabulated{at, f} : Tabulated{};
  return nearest_pose(track, x, best);
}

SweptEstimate::Tabulated SweptEstimate::at_hint(const SweptContact& hint, const Vec3& x) const {
  const auto at = static_cast<std::size_t>(std::lround(std::clamp(hint.t, 0.0, 1.0) / spacing()));
  return {at, at_pose(tracks_[static_cast<std::size_t>(hint.motion)].poses[at], x)};
}

double SweptEstimate::slack(const Track& track) const {
  // A sphere of radius r that passes x half-way between two poses comes nearer by about stride^2 / (8 r).
  // A radial function that is no tool (r <= 0 somewhere) must not make it negative: then nothing would be nearest.
  constexpr double kLeastRadiusShare = 1e-3;
  const double radius = std::max(least_radius_, kLeastRadiusShare * axis_length_);
  return track.stride * track.stride / (8.0 * radius);
}

double SweptEstimate::bound(const Vec3& x, const SweptContact& hint) const {
  if (hint.motion >= 0) return at_hint(hint, x).f + slack(tracks_[static_cast<std::size_t>(hint.motion)]);
  double bound = std::numeric_limits<double>::infinity();
  for (const Track& track : tracks_) bound = std::min(bound, nearest_pose(track, x).f + slack(track));
  return bound;
}

void SweptEstimate::places(const Vec3& x, const SweptContact& hint, std::vector<SweptContact>& places) const {
  places.clear();
  double bound_f = bound(x, hint);
  for (std::size_t m = 0; m < tracks_.size(); ++m) {
    const Track& track = tracks_[m];
    std::size_t last = track.poses.size();
    visit_near(track, x, bound_f, [&](std::size_t i) {
      const double f = at_pose(track.poses[i], x, bound_f);
      if (!(f <= bound_f)) return;
      // A lower value lowers the bound for what follows; what came before it is sifted at the end.
      bound_f = std::min(bound_f, f + slack(track));
      const bool same_run = last + 1 == i && !places.empty() && places.back().motion == static_cast<int>(m);
      if (!same_run) places.emplace_back();
      if (!same_run || f < places.back().f) {
        places.back().motion = static_cast<int>(m);
        places.back().t = static_cast<double>(i) * spacing();
        places.back().f = f;
      }
      last = i;
    });
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
    const Track& track = tracks_[m];
    const std::size_t none = track.poses.size();
    Tabulated least{none, best.f + slack(track)};
    if (hint.motion == static_cast<int>(m)) least = at_hint(hint, x);
    least = std::isfinite(least.f) ? nearest_pose(track, x, least) : nearest_pose(track, x);
    if (least.at == none) return;  // nothing nearer than that of another motion
    const SweptContact found = at_vertex(m, least, x);
    if (found.f < best.f) best = found;
  };
  // A motion that is near keeps the search of the others short.
  if (hint.motion >= 0) look(static_cast<std::size_t>(hint.motion));
  for (std::size_t m = 0; m < tracks_.size(); ++m)
    if (hint.motion != static_cast<int>(m)) look(m);
  return best;
}

SweptContact SweptEstimate::at_vertex(std::size_t motion, const Tabulated& least, const Vec3& x) const {
  const std::vector<Pose>& poses = tracks_[motion].poses;
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
