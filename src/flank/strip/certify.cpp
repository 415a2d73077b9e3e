#include "flank/strip/certify.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "flank/base/tolerance_budget.h"

namespace flank::internal {

bool is_certified(const PoseGuard& guard, const CoverStrip& strip, double tolerance_mm) {
  if (strip.cells.empty() || strip.overcut_mm > kToleranceBudget.target.certified * tolerance_mm) return false;
  const int poses = depth_poses(strip.motion);
  for (int i = 0; i <= poses; ++i)
    if (!guard.clear(strip.motion.pose(static_cast<double>(i) / poses))) return false;
  return true;
}

namespace {

/// The largest of the shifts within `reach` steps, then the mean over as many. The maximum first, because a mean alone
/// would flatten the peak that is needed: after both, the largest shift within 2 `reach` steps is kept whole, and the
/// ramps on both sides of it are 2 `reach` long.
std::vector<Vec3> ramped(const std::vector<Vec3>& shifts, int reach) {
  const int n = static_cast<int>(shifts.size());
  const auto window = [&](int i, const auto& visit) {
    for (int k = std::max(0, i - reach); k <= std::min(n - 1, i + reach); ++k) visit(static_cast<std::size_t>(k));
  };
  std::vector<Vec3> wide(shifts.size(), Vec3::Zero()), smooth(shifts.size(), Vec3::Zero());
  for (int i = 0; i < n; ++i)
    window(i, [&](std::size_t k) {
      Vec3& at = wide[static_cast<std::size_t>(i)];
      if (shifts[k].squaredNorm() > at.squaredNorm()) at = shifts[k];
    });
  for (int i = 0; i < n; ++i) {
    int count = 0;
    window(i, [&](std::size_t k) {
      smooth[static_cast<std::size_t>(i)] += wide[k];
      ++count;
    });
    smooth[static_cast<std::size_t>(i)] /= count;
  }
  return smooth;
}

/// The motion with both ends of the axis shifted at equal steps of t.
RuledMotion shifted(const RuledMotion& motion, const std::vector<Vec3>& tips, const std::vector<Vec3>& holders) {
  std::vector<Pose> poses;
  std::vector<double> times;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    times.push_back(static_cast<double>(i) / static_cast<double>(tips.size() - 1));
    const Pose pose = motion.pose(times.back());
    const Vec3 tip = pose.tip + tips[i], holder = pose.at(motion.axis_length) + holders[i];
    poses.push_back({tip, (holder - tip).normalized()});
  }
  return fit_motion(poses, times, motion.axis_length, motion.tip.count());
}

/// Shifts of the ends of the axis at equal steps of t.
struct Shifts {
  std::vector<Vec3> tips, holders;
  bool any = false;
};

/// Shifts that take the poses of a strip out of the target, if they are too deep in it, and out of other faces.
Shifts shifts_of(const PoseGuard& guard, const CoverStrip& strip, double depth_mm, int poses, LineFitter& fitter) {
  constexpr double kReachShare = 0.25;  ///< of the axis: a slide that is longer makes another strip of it
  // Depths are known at depth_poses(motion) steps: at those, poses that are not too deep are not measured again.
  const bool known = poses == depth_poses(strip.motion);
  Shifts shifts;
  fitter.forget();
  for (int i = 0; i <= poses; ++i) {
    const Pose pose = strip.motion.pose(static_cast<double>(i) / poses);
    LineFitter::Lift lift;
    if (known && strip.depths[static_cast<std::size_t>(i)] <= depth_mm) {
      fitter.forget();  // the next pose that is measured may be far from the last: its footpoints are no hints
    } else {
      (void)fitter.measure(pose);
      lift = fitter.lift(pose, depth_mm);
    }
    const Vec3 slide = slid_clear(guard, pose, kReachShare * strip.motion.axis_length).tip - pose.tip;
    shifts.tips.push_back(lift.tip + slide);
    shifts.holders.push_back(lift.holder + slide);
  }
  // Depths seen from the target's points: the sphere of s has to move by the excess, and the other end is the hinge, so
  // the end that is nearer to s moves by excess * L / (its distance from the hinge), at most twice the excess.
  for (const SweptContact& at : strip.deep) {
    if (-at.f <= depth_mm) continue;
    const double length = strip.motion.axis_length;
    const bool upper = 2.0 * at.s > length;
    const Vec3 shift = (-at.f - depth_mm) * length / (upper ? at.s : length - at.s) * at.to_axis;
    Vec3& end = (upper ? shifts.holders : shifts.tips)[static_cast<std::size_t>(std::lround(at.t * poses))];
    if (shift.squaredNorm() > end.squaredNorm()) end = shift;
  }
  const auto moves = [](const Vec3& v) { return v != Vec3::Zero(); };
  shifts.any = std::any_of(shifts.tips.begin(), shifts.tips.end(), moves) ||
               std::any_of(shifts.holders.begin(), shifts.holders.end(), moves);
  return shifts;
}

/// Ramps as long as a knot span: shorter ones are no motion that the rails can follow, and would come back as ripples.
RuledMotion moved(const RuledMotion& motion, const Shifts& shifts) {
  const int reach = std::max(1, static_cast<int>(shifts.tips.size()) / motion.tip.count());
  return shifted(motion, ramped(shifts.tips, reach), ramped(shifts.holders, reach));
}

}  // namespace

CoverStrip lifted(const CoverSamples& samples, const PoseGuard& guard, CoverStrip strip, const RadialFunction& radial,
                  LineFitter& fitter) {
  constexpr int kTries = 4;  ///< the rails follow a shift only nearly, so what is left is lifted again
  const double limit = kToleranceBudget.target.certified * fitter.options().tolerance_mm;
  for (int k = 0; k < kTries && !strip.cells.empty(); ++k) {
    // Not too deep anywhere: then only slides out of other faces are left to do.
    const double depth =
        strip.overcut_mm > limit ? kToleranceBudget.target.lift_of_certified * limit : strip.overcut_mm;
    const Shifts shifts = shifts_of(guard, strip, depth, depth_poses(strip.motion), fitter);
    if (!shifts.any) break;
    strip = measure_strip(samples, moved(strip.motion, shifts), radial, fitter);
  }
  return strip;
}

CoverStrip cut_to_certified(const CoverSamples& samples, const PoseGuard& guard, CoverStrip strip,
                            const RadialFunction& radial, LineFitter& fitter) {
  constexpr int kTries = 3;  ///< the shorter motion is a new approximation, which has to be certified itself
  const double tolerance = fitter.options().tolerance_mm;
  for (int k = 0; k < kTries && !strip.cells.empty() && !is_certified(guard, strip, tolerance); ++k) {
    const int poses = depth_poses(strip.motion);
    int first = 0, longest = 0;
    for (int i = 0, run = 0; i <= poses; ++i) {
      const bool good = strip.depths[static_cast<std::size_t>(i)] <= kToleranceBudget.target.certified * tolerance &&
                        guard.clear(strip.motion.pose(static_cast<double>(i) / poses));
      run = good ? run + 1 : 0;
      if (run <= longest) continue;
      longest = run;
      first = i - run + 1;
    }
    // The new ends lie a step within: right at the edge of what is allowed the next step may be beyond it.
    const double t0 = (first + (first > 0 ? 1.0 : 0.0)) / poses;
    const double t1 = (first + longest - (first + longest <= poses ? 2.0 : 1.0)) / poses;
    if (t1 - t0 < kShortestStretch) return {};
    strip = measure_strip(samples, part_of_motion(strip.motion, t0, t1), radial, fitter);
  }
  return is_certified(guard, strip, tolerance) ? strip : CoverStrip{};
}

std::vector<CoverStrip> cut_at_kinks(const CoverSamples& samples, const PoseGuard& guard, CoverStrip strip,
                                     const RadialFunction& radial, LineFitter& fitter, const TurnLimit& limit) {
  constexpr int kTries = 3;  ///< a stretch is a new approximation, which may turn once more
  const double tolerance = fitter.options().tolerance_mm;
  const auto kinked = [&](const CoverStrip& piece) { return has_kink(piece.motion, limit, tolerance); };
  std::vector<CoverStrip> steady, open;
  (kinked(strip) ? open : steady).push_back(std::move(strip));
  for (int k = 0; k < kTries && !open.empty(); ++k)
    for (const CoverStrip& piece : std::exchange(open, {}))
      for (const TimeRange& stretch : stretches_between_kinks(piece.motion, limit, tolerance)) {
        const RuledMotion part = part_of_motion(piece.motion, stretch.first, stretch.last);
        CoverStrip cut = cut_to_certified(samples, guard, measure_strip(samples, part, radial, fitter), radial, fitter);
        if (!cut.cells.empty()) (kinked(cut) ? open : steady).push_back(std::move(cut));
      }
  return steady;
}

namespace {

/// Steps of the last look: several times those of the certificate (depth_poses: at most 384).
constexpr int kFinePoses = 1000;
/// Fewest fine steps of a stretch that is kept.
constexpr int kShortestFineRun = kFinePoses / 10;
static_assert(kShortestFineRun == static_cast<int>(kShortestStretch * kFinePoses));

/// First and last of the longest run of fine steps that are not too deep, and clear; last < first: there is none.
std::pair<int, int> longest_good(const PoseGuard& guard, const RuledMotion& motion, LineFitter& fitter) {
  const double limit = kToleranceBudget.target.last_look() * fitter.options().tolerance_mm;
  std::pair<int, int> best = {0, -1};
  fitter.forget();
  for (int i = 0, first = 0; i <= kFinePoses; ++i) {
    const Pose pose = motion.pose(static_cast<double>(i) / kFinePoses);
    (void)fitter.measure(pose);
    if (fitter.overcut(pose, limit) > limit || !guard.clear(pose))
      first = i + 1;
    else if (i - first > best.second - best.first)
      best = {first, i};
  }
  return best;
}

}  // namespace

CoverStrip cut_finely(const CoverSamples& samples, const PoseGuard& guard, CoverStrip strip,
                      const RadialFunction& radial, LineFitter& fitter) {
  // Lifts keep coverage, cuts lose it: half of the tries are for lifting, the others for cutting what that leaves.
  constexpr int kTries = 6, kLifts = 3;
  const double tolerance = fitter.options().tolerance_mm;
  // Without a tolerance for other faces (floor 0) there is none to use up here.
  const PoseGuard last_guard =
      guard.with_floor(guard.floor_mm() < 0.0 ? -kToleranceBudget.others.last_look * tolerance : guard.floor_mm());
  for (int k = 0; k < kTries; ++k) {
    const auto [first, last] = longest_good(last_guard, strip.motion, fitter);
    if (first == 0 && last == kFinePoses) return strip;
    if (k < kLifts) {
      const Shifts shifts = shifts_of(guard, strip, kToleranceBudget.target.certified * tolerance, kFinePoses, fitter);
      strip = measure_strip(samples, moved(strip.motion, shifts), radial, fitter);
      continue;
    }
    if (last - first < kShortestFineRun) return {};
    const double step = 1.0 / kFinePoses;
    const double t0 = (first + (first > 0 ? 1 : 0)) * step, t1 = (last - (last < kFinePoses ? 1 : 0)) * step;
    strip = measure_strip(samples, part_of_motion(strip.motion, t0, t1), radial, fitter);
    strip = cut_to_certified(samples, guard, std::move(strip), radial, fitter);
    if (strip.cells.empty()) return {};
  }
  return {};
}

}  // namespace flank::internal
