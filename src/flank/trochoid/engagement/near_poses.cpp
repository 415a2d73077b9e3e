#include "flank/trochoid/engagement/near_poses.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// A disc that holds these, one at least.
RowDisc around(std::span<const RowDisc> discs) {
  constexpr double kRounding = 1e-9;
  RowDisc out = discs.front();
  for (const RowDisc& disc : discs.subspan(1)) {
    out.x += disc.x, out.y += disc.y;
    out.low = std::min(out.low, disc.low), out.high = std::max(out.high, disc.high);
  }
  const auto count = static_cast<double>(discs.size());
  out.x /= count, out.y /= count, out.radius = 0.0;
  for (const RowDisc& disc : discs) {
    const double dx = disc.x - out.x, dy = disc.y - out.y;
    out.radius = std::max(out.radius, std::sqrt(dx * dx + dy * dy) + disc.radius);
  }
  out.radius += kRounding, out.low -= kRounding, out.high += kRounding;
  return out;
}

}  // namespace

void NearPoses::begin(const RuledMotion& motion) {
  own_ = Sweep::of(motion, kOwnIntervals);
  near_.clear();
  for (std::size_t k = 0; k < stock_.sweeps().size(); ++k)
    if (is_ever_near(stock_.sweeps()[k])) near_.push_back(static_cast<int>(k));
}

bool NearPoses::is_ever_near(const Sweep& sweep) const {
  const ToolProfile& profile = stock_.profile();
  const double length = sweep.axis_length,
               tilt = (sweep.axes.front().axis - own_.axes.front().axis).norm() + sweep.turn + own_.turn;
  const Vec3 apart = sweep.whole.middle - own_.whole.middle;
  // What is seen from an axis that is elsewhere and tilted: the middles are so much nearer, the heights so much less apart.
  const double sway = own_.whole.reach + (apart.norm() + own_.whole.reach) * 2.0 * own_.turn;
  const double along = apart.dot(own_.axes.front().axis), across2 = apart.squaredNorm() - along * along;
  const double most =
      sweep.whole.reach + sway + 2.0 * profile.largest() + (0.75 * length + std::abs(along) + sway) * tilt;
  if (across2 > most * most) return false;
  const double half = std::max(profile.high() - 0.5 * length, 0.5 * length - profile.low());
  return std::abs(along) <= 2.0 * half + sweep.whole.reach + sway + most * tilt;
}

NearPoses::Bundle NearPoses::bundle_of(const RowFrame& frame, const Sweep& sweep, const Sweep::Chunk& chunk,
                                       double tilt) const {
  const Vec3 apart = chunk.middle - frame.axis.at(0.5 * sweep.axis_length);
  return {apart.dot(frame.x), apart.dot(frame.y), apart.dot(frame.axis.u), chunk.reach, tilt};
}

bool NearPoses::is_beyond(const Bundle& bundle, const RowDisc& disc, double axis_length) const {
  const ToolProfile& profile = stock_.profile();
  // How far the axes may be away and still reach the disc: tilts bring them nearer at one end.
  const double most =
      bundle.spread + profile.largest() + disc.radius + (0.75 * axis_length + std::abs(bundle.along)) * bundle.tilt;
  const double dx = bundle.x - disc.x, dy = bundle.y - disc.y;
  if (dx * dx + dy * dy > most * most) return true;
  // Layers above or below: their tools do not come down or up to these rings. Of another tool, how far it reaches from its
  // middle along its axis.
  const double half = std::max(profile.high() - 0.5 * axis_length, 0.5 * axis_length - profile.low());
  const double height = bundle.along + 0.5 * axis_length, slack = half + bundle.spread + most * bundle.tilt;
  return height + slack < disc.low || height - slack > disc.high;
}

bool NearPoses::meets(const RowFrame& frame, const Pose& pose, const RowDisc& all, std::span<const RowDisc> discs,
                      NearPose& out) const {
  const ToolProfile& profile = stock_.profile();
  const double low = profile.low(), high = profile.high();
  const Vec3 d = pose.tip - frame.axis.tip;
  const double forward = pose.axis.dot(frame.axis.u);
  if (forward < 0.5) return false;
  const double up = d.dot(frame.axis.u);
  out.dh = 1.0 / forward, out.h0 = -up * out.dh;
  out.dx = pose.axis.dot(frame.x) * out.dh, out.dy = pose.axis.dot(frame.y) * out.dh;
  out.x0 = d.dot(frame.x) - up * out.dx, out.y0 = d.dot(frame.y) - up * out.dy;
  // At least the length of (dx, dy), without its root.
  const double slope =
      std::max(std::abs(out.dx), std::abs(out.dy)) + 0.5 * std::min(std::abs(out.dx), std::abs(out.dy));
  const double lean = forward * slope, below = d.dot(pose.axis);
  // Nearest that the axis comes to a disc over the heights of the tool, and a little more where it leans.
  const double slack = profile.largest() * slope, first = low - slack, range = high - low + 2.0 * slack;
  const double ex = range * out.dx, ey = range * out.dy, e2 = ex * ex + ey * ey, per_e2 = e2 > 0.0 ? 1.0 / e2 : 0.0;
  const auto reaches = [&](const RowDisc& disc) {
    const double reach = profile.largest() + disc.radius;
    const double ax = out.x0 + first * out.dx - disc.x, ay = out.y0 + first * out.dy - disc.y;
    const double share = std::clamp(-(ax * ex + ay * ey) * per_e2, 0.0, 1.0);
    const double nx = ax + share * ex, ny = ay + share * ey;
    if (nx * nx + ny * ny > reach * reach) return false;
    // Heights of the places of the disc along this axis.
    const double middle = forward * (disc.x * out.dx + disc.y * out.dy) - below, swing = disc.radius * lean;
    return middle + swing + disc.high * forward >= low && middle - swing + disc.low * forward <= high;
  };
  return reaches(all) && (discs.empty() || std::any_of(discs.begin(), discs.end(), reaches));
}

void NearPoses::add_sweep(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts,
                          const Sweep& sweep, int index, double last, int stride, std::vector<RowDisc>& scratch,
                          std::vector<NearPose>& out) const {
  const double length = sweep.axis_length;
  const double turn = (sweep.axes.front().axis - frame.axis.u).norm();
  if (is_beyond(bundle_of(frame, sweep, sweep.whole, turn + sweep.turn), whole, length)) return;
  for (std::size_t c = 0; c < sweep.chunks.size(); ++c) {
    const std::size_t first = c * Sweep::kChunk;
    const Bundle bundle = bundle_of(frame, sweep, sweep.chunks[c], (sweep.axes[first].axis - frame.axis.u).norm());
    if (is_beyond(bundle, whole, length)) continue;
    scratch.clear();
    for (const RowDisc& part : parts)
      if (!is_beyond(bundle, part, length)) scratch.push_back(part);
    if (!parts.empty() && scratch.empty()) continue;
    const RowDisc all = parts.empty() ? whole : around(scratch);
    const std::size_t end = std::min(first + Sweep::kChunk + (c + 1 == sweep.chunks.size() ? 1 : 0), sweep.axes.size());
    for (std::size_t p = first; p < end && static_cast<double>(p) <= last; p += static_cast<std::size_t>(stride)) {
      NearPose pose{.sweep = index, .pose = static_cast<int>(p)};
      if (meets(frame, sweep.axes[p], all, scratch, pose)) out.push_back(pose);
    }
  }
}

void NearPoses::add(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, double own_last,
                    std::size_t recent, int stride, std::vector<RowDisc>& scratch, std::vector<NearPose>& out) const {
  // The newest first: they end most gaps.
  if (own_last >= 0.0) add_sweep(frame, whole, parts, own_, kOwnSweep, own_last, stride, scratch, out);
  const std::vector<Sweep>& sweeps = stock_.sweeps();
  const std::size_t from = recent > 0 && sweeps.size() > recent ? sweeps.size() - recent : 0;
  for (auto k = near_.rbegin(); k != near_.rend() && static_cast<std::size_t>(*k) >= from; ++k) {
    const Sweep& sweep = sweeps[static_cast<std::size_t>(*k)];
    add_sweep(frame, whole, parts, sweep, *k, sweep.last(), stride, scratch, out);
  }
}

}  // namespace flank::internal
