#include "flank/trochoid/stock/swept_stock.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {

Sweep Sweep::of(const RuledMotion& motion, int intervals) {
  FLANK_ASSERT(intervals >= 1);
  Sweep sweep;
  sweep.axis_length = motion.axis_length;
  sweep.poses.reserve(static_cast<std::size_t>(intervals) + 1);
  const double step = 1.0 / intervals;
  for (int i = 0; i <= intervals; ++i) {
    const CurveJet<3> tip = motion.tip.jet(i * step), direction = motion.direction.jet(i * step);
    sweep.poses.push_back({tip.p, direction.p, step * tip.d1, step * direction.d1});
  }
  sweep.make_chunks();
  return sweep;
}

Sweep Sweep::of(const std::vector<Pose>& poses, double axis_length) {
  FLANK_ASSERT(!poses.empty());
  Sweep sweep;
  sweep.axis_length = axis_length;
  // Without velocities the cubics between are straight lines, run through with a soft start and end.
  for (const Pose& pose : poses) sweep.poses.push_back({pose.tip, pose.axis, Vec3::Zero(), Vec3::Zero()});
  if (poses.size() == 1) sweep.poses.push_back(sweep.poses.front());
  sweep.make_chunks();
  return sweep;
}

void Sweep::make_chunks() {
  axes.reserve(poses.size());
  for (const SweepPose& p : poses) axes.push_back({p.tip, p.direction.normalized()});
  make_lanes();
  whole.middle = Vec3::Zero();
  const Vec3 direction = axes.front().axis;
  for (const Pose& p : axes) turn = std::max(turn, (p.axis - direction).norm());
  const auto middle = [&](const Pose& p) { return p.at(0.5 * axis_length); };
  for (std::size_t first = 0; first + 1 < poses.size(); first += kChunk) {
    const std::size_t end = std::min(first + kChunk + 1, poses.size());
    const Pose& pose = axes[(first + end - 1) / 2];
    Chunk chunk{middle(pose), 0.0, pose};
    for (std::size_t k = first; k < end; ++k) {
      chunk.reach = std::max(chunk.reach, (middle(axes[k]) - chunk.middle).norm());
      for (const double s : {0.0, axis_length})
        chunk.spread = std::max(chunk.spread, (axes[k].at(s) - pose.at(s)).norm());
    }
    chunks.push_back(chunk);
    whole.middle += chunk.middle;
  }
  whole.middle /= static_cast<double>(chunks.size());
  for (const Chunk& chunk : chunks)
    whole.reach = std::max(whole.reach, (chunk.middle - whole.middle).norm() + chunk.reach);
}

void Sweep::make_lanes() {
  const std::size_t count = (axes.size() + kChunk - 1) / kChunk * kChunk;
  for (int c = 0; c < 6; ++c) {
    std::vector<double>& lane = lanes[static_cast<std::size_t>(c)];
    for (const Pose& p : axes) lane.push_back(c < 3 ? p.tip[c] : p.axis[c - 3]);
    lane.resize(count, lane.back());
    std::vector<double>& rough = rough_lanes[static_cast<std::size_t>(c)];
    for (std::size_t k = 0; k < axes.size(); k += kRough) rough.push_back(lane[k]);
    rough.resize((rough.size() + kChunk - 1) / kChunk * kChunk, rough.back());
  }
}

std::array<const double*, 6> Sweep::lanes_at(std::size_t pose) const {
  std::array<const double*, 6> out{};
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = lanes[c].data() + pose;
  return out;
}

SweepPose Sweep::at(double place) const {
  const int i = std::clamp(static_cast<int>(place), 0, static_cast<int>(poses.size()) - 2);
  const double t = place - i;
  const SweepPose &a = poses[static_cast<std::size_t>(i)], &b = poses[static_cast<std::size_t>(i) + 1];
  const auto blend = [t](const Vec3& p, const Vec3& pd, const Vec3& q, const Vec3& qd, Vec3& value, Vec3& d1) {
    const Vec3 d = q - p, m = pd - d, n = d - qd;
    const Vec3 mix = m * (1.0 - t) + n * t;
    value = p + t * d + t * (1.0 - t) * mix;
    d1 = d + (1.0 - 2.0 * t) * mix + t * (1.0 - t) * (n - m);
  };
  SweepPose out;
  blend(a.tip, a.tip_d1, b.tip, b.tip_d1, out.tip, out.tip_d1);
  blend(a.direction, a.direction_d1, b.direction, b.direction_d1, out.direction, out.direction_d1);
  return out;
}

SweepAxis::SweepAxis(const SweepPose& pose) : tip(pose.tip), tip_d1(pose.tip_d1) {
  const double length = pose.direction.norm();
  u = pose.direction / length;
  u_d1 = (pose.direction_d1 - pose.direction_d1.dot(u) * u) / length;
}

GapJet gap_at(const ToolProfile& profile, const SweepPose& pose, const Vec3& x) {
  return gap_at(profile, SweepAxis(pose), x);
}

GapJet gap_at(const ToolProfile& profile, const SweepAxis& axis, const Vec3& x) {
  GapJet jet;
  const Vec3 &u = axis.u, &u_d1 = axis.u_d1, d = x - axis.tip;
  const double z = d.dot(u);
  if (z < profile.flank_low() || z > profile.flank_high()) {
    // Of a radius at its height a round end has none at its pole and an endless slope beside it: the distance to its sphere is as
    // smooth there as anywhere.
    const ToolProfile::RoundEnd end = profile.round_end(z);
    const Vec3 from = d - end.centre * u;
    const double distance = from.norm();
    jet.gap = distance - end.radius;
    jet.gradient = distance > 0.0 ? Vec3(from / distance) : u.unitOrthogonal();
    jet.dt = -jet.gradient.dot(axis.tip_d1 + end.centre * u_d1);
    return jet;
  }
  ToolProfile::Place place;
  (void)profile.at(z, place);
  const Vec3 across = d - z * u;
  const double distance = across.norm();
  const Vec3 e = distance > 0.0 ? Vec3(across / distance) : u.unitOrthogonal();
  jet.gap = distance - place.radius;
  jet.gradient = e - place.slope * u;
  const double z_d1 = d.dot(u_d1) - axis.tip_d1.dot(u);
  jet.dt = -e.dot(axis.tip_d1 + z * u_d1) - place.slope * z_d1;
  return jet;
}

SweptStock::SweptStock(const RadialFunction& radial, std::vector<HalfSpace> blank)
    : radial_(radial), profile_(radial), blank_(std::move(blank)) {}

double SweptStock::gap(const Vec3& x) const {
  constexpr int kPlaces = 4;  // of an interval
  double least = std::numeric_limits<double>::infinity();
  for (const Sweep& sweep : sweeps_) {
    const int count = static_cast<int>(sweep.last()) * kPlaces;
    double best = std::numeric_limits<double>::infinity(), place = 0.0;
    for (int k = 0; k <= count; ++k) {
      const double g = gap_at(profile_, sweep.at(static_cast<double>(k) / kPlaces), x).gap;
      if (g < best) {
        best = g;
        place = static_cast<double>(k) / kPlaces;
      }
    }
    if (!std::isfinite(best)) continue;
    // Golden section between the neighbours: unimodal there.
    double low = std::max(0.0, place - 1.0 / kPlaces), high = std::min(sweep.last(), place + 1.0 / kPlaces);
    constexpr double kGolden = 0.6180339887498949;
    for (int k = 0; k < 40; ++k) {
      const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
      (gap_at(profile_, sweep.at(a), x).gap < gap_at(profile_, sweep.at(b), x).gap ? high : low) =
          gap_at(profile_, sweep.at(a), x).gap < gap_at(profile_, sweep.at(b), x).gap ? b : a;
    }
    least = std::min({least, best, gap_at(profile_, sweep.at(0.5 * (low + high)), x).gap});
  }
  return least;
}

bool SweptStock::is_material(const Vec3& x) const {
  for (const HalfSpace& h : blank_)
    if (h.normal.dot(x) > h.offset) return false;
  return gap(x) > 0.0;
}

}  // namespace flank::internal
