#include "flank/trochoid/stock/near_poses.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

NearPose pose_of(const PoseLanes& lanes, std::size_t k, int sweep, std::size_t pose) {
  return {lanes.x0[k], lanes.y0[k], lanes.dx[k], lanes.dy[k], lanes.h0[k], lanes.dh[k], sweep, static_cast<int>(pose)};
}

}  // namespace

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
    if (is_ever_near(sweep_of(k), sweep_of(k).whole)) add_bundles_of(sweep_of(k), k);
}

void NearPoses::add_bundles_of(const Sweep& sweep, int index) {
  for (std::size_t c = 0; c < sweep.chunks.size(); ++c) {
    if (index != kOwnSweep && !is_ever_near(sweep, sweep.chunks[c])) continue;
    const std::size_t first = c * Sweep::kChunk;
    bundles_.add(sweep.chunks[c], sweep.axes[first].axis, 1.5 * tool_.largest / tool_.length);
    sweeps_.push_back(index);
    firsts_.push_back(first);
  }
}

bool NearPoses::is_ever_near(const Sweep& sweep, const Sweep::Chunk& part) const {
  const ToolProfile& profile = stock_.profile();
  const double length = sweep.axis_length,
               tilt = (sweep.axes.front().axis - own_.axes.front().axis).norm() + sweep.turn + own_.turn;
  const Vec3 apart = part.middle - own_.whole.middle;
  // What is seen from an axis that is elsewhere and tilted: the middles are so much nearer, the heights so much less apart.
  const double sway = own_.whole.reach + (apart.norm() + own_.whole.reach) * 2.0 * own_.turn;
  const double along = apart.dot(own_.axes.front().axis), across2 = apart.squaredNorm() - along * along;
  const double most = part.reach + sway + 2.0 * profile.largest() + (0.75 * length + std::abs(along) + sway) * tilt;
  if (across2 > most * most) return false;
  const double half = std::max(profile.high() - 0.5 * length, 0.5 * length - profile.low());
  return std::abs(along) <= 2.0 * half + part.reach + sway + most * tilt;
}

std::size_t NearPoses::end_of(std::size_t bundle, double own_last) const {
  const std::size_t first = firsts_[bundle], last = sweep_of(sweeps_[bundle]).axes.size() - 1;
  // A sweep's last pose is in its last chunk, too.
  const std::size_t end = first + Sweep::kChunk >= last ? last + 1 : first + Sweep::kChunk;
  return sweeps_[bundle] == kOwnSweep ? std::min(end, static_cast<std::size_t>(own_last) + 1) : end;
}

void NearPoses::add_bundle(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> discs,
                           std::size_t bundle, double own_last, std::vector<NearPose>& out) const {
  const int index = sweeps_[bundle];
  const std::size_t end = end_of(bundle, own_last);
  PoseLanes lanes;
  for (std::size_t from = firsts_[bundle]; from < end; from += PoseLanes::kCount) {
    lanes.look(frame, tool_, sweep_of(index), from);
    if (!lanes.meets(tool_, whole, discs)) continue;
    const std::size_t count = std::min(PoseLanes::kCount, end - from);
    for (std::size_t k = 0; k < count; ++k)
      if (lanes.hit[k] != 0) out.push_back(pose_of(lanes, k, index, from + k));
  }
}

std::size_t NearPoses::count_of(std::size_t recent) const {
  const std::size_t all = stock_.sweeps().size();
  if (all <= recent) return bundles_.count();
  const int oldest = static_cast<int>(all - recent);
  return static_cast<std::size_t>(
      std::find_if(sweeps_.begin(), sweeps_.end(), [&](int sweep) { return sweep < oldest; }) - sweeps_.begin());
}

void NearPoses::add_roughly(const RowFrame& frame, const RowDisc& whole, double own_last, std::size_t recent,
                            NearScratch& scratch, std::vector<NearPose>& out) const {
  const std::size_t count = count_of(recent);
  scratch.seen.look(frame, tool_, bundles_, count, whole);
  // Lanes of several bundles are looked at together.
  PoseLanes lanes;
  std::size_t looked = 0;
  int sweep = -1;
  for (std::size_t k = 0; k < count; ++k) {
    if (scratch.seen.beyond[k] > 0.0 || (sweeps_[k] == kOwnSweep && static_cast<double>(firsts_[k]) > own_last))
      continue;
    const std::size_t end = end_of(k, own_last);
    for (std::size_t p = firsts_[k]; p < end; p += Sweep::kRough) {
      const std::size_t place = p / Sweep::kRough, lane = place % PoseLanes::kCount;
      if (sweeps_[k] != sweep || place - lane != looked) {
        sweep = sweeps_[k], looked = place - lane;
        lanes.look_roughly(frame, tool_, sweep_of(sweep), looked);
        (void)lanes.meets(tool_, whole, {});
      }
      if (lanes.hit[lane] != 0) out.push_back(pose_of(lanes, lane, sweep, p));
    }
  }
}

template <class Use>
void NearPoses::for_each_bundle(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts,
                                double own_last, NearScratch& scratch, const Use& use) const {
  scratch.seen.look(frame, tool_, bundles_, bundles_.count(), whole);
  std::vector<std::size_t>& near = scratch.near;
  near.clear();
  for (std::size_t k = 0; k < bundles_.count(); ++k) {
    const bool later = sweeps_[k] == kOwnSweep && static_cast<double>(firsts_[k]) > own_last;
    if (!(scratch.seen.beyond[k] > 0.0) && !later) near.push_back(k);
  }
  PoseLanes bundles;
  for (std::size_t block = 0; block < near.size(); block += PoseLanes::kCount) {
    const auto some =
        std::span<const std::size_t>(near).subspan(block, std::min(PoseLanes::kCount, near.size() - block));
    bundles.look(frame, tool_, bundles_, some);
    if (!bundles.meets(tool_, whole, parts)) continue;
    for (std::size_t k = 0; k < some.size(); ++k)
      if (bundles.hit[k] != 0) use(some[k]);
  }
}

void NearPoses::add(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, double own_last,
                    NearScratch& scratch, std::vector<NearPose>& out) const {
  scratch.discs.take(parts);
  for_each_bundle(frame, whole, parts, own_last, scratch, [&](std::size_t k) {
    scratch.discs.meet(scratch.seen, k, bundles_.at[6][k], tool_, parts, scratch.some);
    if (!parts.empty() && scratch.some.empty()) return;
    add_bundle(frame, whole, scratch.some, k, own_last, out);
  });
}

void NearPoses::add_pose(const RowFrame& frame, int sweep, int pose, double own_last,
                         std::vector<NearPose>& out) const {
  if (sweep == kOwnSweep && pose > own_last) return;
  const std::size_t at = static_cast<std::size_t>(pose), k = at % PoseLanes::kCount;
  PoseLanes lanes;
  lanes.project(frame, sweep_of(sweep), at - k);
  if (!lanes.is_near(k)) return;
  out.push_back(pose_of(lanes, k, sweep, at));
}

void NearPoses::see(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, double own_last,
                    NearScratch& scratch, SeenPoses& out) const {
  out.clear();
  PoseLanes lanes;
  for_each_bundle(frame, whole, parts, own_last, scratch, [&](std::size_t bundle) {
    const std::size_t end = end_of(bundle, own_last);
    for (std::size_t from = firsts_[bundle]; from < end; from += PoseLanes::kCount) {
      lanes.project(frame, sweep_of(sweeps_[bundle]), from);
      out.add(lanes, end - from, sweeps_[bundle], from);
    }
  });
}

void SeenPoses::clear() {
  for (std::vector<double>& lane : at_) lane.clear();
  sweeps_.clear();
  firsts_.clear();
}

void SeenPoses::add(const PoseLanes& lanes, std::size_t count, int sweep, std::size_t first) {
  // So far below that nothing of it is seen.
  constexpr double kNowhere = -1e9;
  const std::array<const PoseLanes::Doubles*, 6> from = {&lanes.x0, &lanes.y0, &lanes.dx,
                                                         &lanes.dy, &lanes.h0, &lanes.dh};
  for (std::size_t c = 0; c < from.size(); ++c) at_[c].insert(at_[c].end(), from[c]->begin(), from[c]->end());
  for (std::size_t k = 0; k < PoseLanes::kCount; ++k) {
    if (k < count && lanes.is_near(k)) continue;
    const std::array<double, 6> nowhere = {0.0, 0.0, 0.0, 0.0, kNowhere, 1.0};
    for (std::size_t c = 0; c < from.size(); ++c) at_[c][at_[c].size() - PoseLanes::kCount + k] = nowhere[c];
  }
  sweeps_.push_back(sweep);
  firsts_.push_back(static_cast<int>(first));
}

NearPose SeenPoses::operator[](std::size_t k) const {
  const std::size_t chunk = k / PoseLanes::kCount;
  return {at_[0][k], at_[1][k], at_[2][k],      at_[3][k],
          at_[4][k], at_[5][k], sweeps_[chunk], firsts_[chunk] + static_cast<int>(k % PoseLanes::kCount)};
}

}  // namespace flank::internal
