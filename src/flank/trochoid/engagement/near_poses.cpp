#include "flank/trochoid/engagement/near_poses.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {

void NearPoses::begin(const RuledMotion& motion) {
  own_ = Sweep::of(motion, kOwnIntervals);
  const ToolProfile& profile = stock_.profile();
  const double length = motion.axis_length;
  tool_ = {profile.low(), profile.high(), profile.largest(), length,
           std::max(profile.high() - 0.5 * length, 0.5 * length - profile.low())};
  bundles_.clear();
  sweeps_.clear();
  firsts_.clear();
  add_bundles_of(own_, kOwnSweep);
  for (int k = static_cast<int>(stock_.sweeps().size()) - 1; k >= 0; --k)
    if (is_ever_near(sweep_of(k))) add_bundles_of(sweep_of(k), k);
}

void NearPoses::add_bundles_of(const Sweep& sweep, int index) {
  for (std::size_t c = 0; c < sweep.chunks.size(); ++c) {
    const std::size_t first = c * Sweep::kChunk;
    bundles_.add(sweep.chunks[c], sweep.axes[first].axis);
    sweeps_.push_back(index);
    firsts_.push_back(first);
  }
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

void NearPoses::add_bundle(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> discs,
                           std::size_t bundle, double own_last, int stride, std::vector<NearPose>& out) const {
  const int index = sweeps_[bundle];
  const Sweep& sweep = sweep_of(index);
  const std::size_t first = firsts_[bundle], last = sweep.axes.size() - 1;
  // A sweep's last pose is in its last chunk, too.
  std::size_t end = first + Sweep::kChunk >= last ? last + 1 : first + Sweep::kChunk;
  if (index == kOwnSweep) end = std::min(end, static_cast<std::size_t>(own_last) + 1);
  PoseLanes lanes;
  for (std::size_t from = first; from < end; from += PoseLanes::kCount) {
    lanes.look(frame, tool_, sweep, from);
    if (!lanes.meets(tool_, whole, discs)) continue;
    const std::size_t to = std::min(from + PoseLanes::kCount, end);
    for (std::size_t p = from; p < to; p += static_cast<std::size_t>(stride)) {
      const std::size_t k = p - from;
      if (lanes.hit[k] == 0) continue;
      out.push_back(
          {lanes.x0[k], lanes.y0[k], lanes.dx[k], lanes.dy[k], lanes.h0[k], lanes.dh[k], index, static_cast<int>(p)});
    }
  }
}

void NearPoses::add(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, double own_last,
                    std::size_t recent, int stride, NearScratch& scratch, std::vector<NearPose>& out) const {
  // The newest first: they end most gaps.
  std::size_t count = bundles_.count();
  const std::size_t all = stock_.sweeps().size();
  if (recent > 0 && all > recent) {
    const int oldest = static_cast<int>(all - recent);
    count = static_cast<std::size_t>(
        std::find_if(sweeps_.begin(), sweeps_.end(), [&](int sweep) { return sweep < oldest; }) - sweeps_.begin());
  }
  scratch.seen.look(frame, tool_, bundles_, count, whole);
  scratch.discs.take(parts);
  for (std::size_t k = 0; k < count; ++k) {
    if (scratch.seen.beyond[k] > 0.0) continue;
    if (sweeps_[k] == kOwnSweep && static_cast<double>(firsts_[k]) > own_last) continue;
    scratch.discs.meet(scratch.seen, k, bundles_.at[6][k], tool_, parts, scratch.some);
    if (!parts.empty() && scratch.some.empty()) continue;
    add_bundle(frame, whole, scratch.some, k, own_last, stride, out);
  }
}

}  // namespace flank::internal
