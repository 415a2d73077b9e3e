#include "flank/machine/linearise.h"

#include <algorithm>
#include <cmath>

#include "flank/path/joined_pose.h"

namespace flank::internal {
namespace {

/// Of the bound: what may lie between two looks at a block.
constexpr double kUnseenShare = 0.25;
/// Of the bound: how far an inserted point may itself be off.
constexpr double kConeShare = 0.25;
/// Looks at one planned step, at most: a block that needs more is divided instead.
constexpr int kMostLooks = 32;
/// A step is halved at most this often: then it is shorter than any unit of a program.
constexpr int kMostHalvings = 40;

class Lineariser {
 public:
  Lineariser(const Kinematics& kinematics, const ControlMotion& control, std::span<const Pose> poses,
             std::span<const JointValues> joints, const ToolSpan& span, const LineariseOptions& options)
      : kinematics_(kinematics), control_(control), poses_(poses), joints_(joints), span_(span), options_(options) {
    measure_steps();
  }

  LinearisedStrip run() {
    push(0.0, end_at(0));
    std::size_t i = 0;
    while (i + 1 < poses_.size() && strip_.complete) {
      const std::size_t j = farthest(i);
      if (j > i)
        push(static_cast<double>(j), end_at(j));
      else
        divide(i, 0.0, end_at(i), 1.0, end_at(i + 1), 0);
      i = std::max(j, i + 1);
    }
    const std::size_t planned = strip_.blocks.size() - strip_.inserted;
    strip_.left_out = poses_.size() - planned;
    return std::move(strip_);
  }

 private:
  /// Poses are of the controlled point; what the path joins straight is the axis point s = 0.
  Pose axis_point(const Pose& p) const { return {p.at(span_.low), p.axis}; }

  void measure_steps() {
    length_.assign(poses_.size(), 0.0);
    for (std::size_t k = 1; k < poses_.size(); ++k) {
      const Pose &a = poses_[k - 1], &b = poses_[k];
      length_[k] = length_[k - 1] +
                   std::max((b.at(span_.low) - a.at(span_.low)).norm(), (b.at(span_.high) - a.at(span_.high)).norm());
    }
  }

  BlockEnd end_at(std::size_t k) const { return {poses_[k], joints_[k]}; }

  /// The planned pose of the axis point s = 0 between two planned poses.
  Pose planned(std::size_t step, double t) const {
    return joined_pose(axis_point(poses_[step]), axis_point(poses_[step + 1]), t);
  }

  double off(const Pose& truth, const Pose& plan) const {
    // Affine along the axis: the largest is at one of the ends.
    const Vec3 low = truth.at(span_.low) - plan.tip;
    const Vec3 high = truth.at(span_.high) - plan.at(span_.high - span_.low);
    return std::sqrt(std::max(low.squaredNorm(), high.squaredNorm()));
  }

  /// Bound of the deviation of one block over the part [t0, t1] of a planned step, which is [b0, b1] of the block;
  /// infinite as soon as it exceeds what is allowed.
  double over_step(const BlockEnd& from, const BlockEnd& to, double bend, std::size_t step, double t0, double t1,
                   double b0, double b1) const {
    const double dt = t1 - t0, db = b1 - b0;
    const double planned_bend = (span_.high - span_.low) * joined_bend(poses_[step], poses_[step + 1]) * dt * dt;
    const double both = planned_bend + bend * db * db;
    const double allowed = options_.deviation;
    const double wanted = std::ceil(std::sqrt(both / (8.0 * kUnseenShare * allowed)));
    const int looks = static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(kMostLooks)));
    const double unseen = both / (8.0 * looks * looks);
    double worst = 0.0;
    for (int k = 0; k <= looks; ++k) {
      const double x = static_cast<double>(k) / looks;
      worst = std::max(worst, off(control_.pose(from, to, b0 + x * db), planned(step, t0 + x * dt)));
      if (worst + unseen > allowed) return std::numeric_limits<double>::infinity();
    }
    return worst + unseen;
  }

  double bend_of(const BlockEnd& from, const BlockEnd& to) const {
    return std::max(control_.bend(from, to, span_.low), control_.bend(from, to, span_.high));
  }

  /// Of a block over whole planned steps.
  double over(std::size_t i, std::size_t j) const {
    const BlockEnd from = end_at(i), to = end_at(j);
    const double bend = bend_of(from, to), whole = length_[j] - length_[i];
    double worst = 0.0;
    for (std::size_t k = i; k < j && worst <= options_.deviation; ++k) {
      // Steps of no length (a pose given twice) share the block evenly.
      const auto share = [&](std::size_t n) {
        return whole > 0.0 ? (length_[n] - length_[i]) / whole
                           : static_cast<double>(n - i) / static_cast<double>(j - i);
      };
      worst = std::max(worst, over_step(from, to, bend, k, 0.0, 1.0, share(k), share(k + 1)));
    }
    return worst;
  }

  bool keeps(std::size_t i, std::size_t j) const { return over(i, j) <= options_.deviation; }

  /// The last planned pose that one block from pose i reaches; i if not even the next one.
  std::size_t farthest(std::size_t i) {
    const std::size_t last = poses_.size() - 1;
    if (!keeps(i, i + 1)) return i;
    std::size_t good = i + 1, step = 1;
    while (good < last) {
      const std::size_t next = std::min(last, good + step);
      if (!keeps(i, next)) break;
      good = next;
      step *= 2;
    }
    // Between what held and what did not, by halves.
    for (std::size_t bad = std::min(last + 1, good + step); bad - good > 1;) {
      const std::size_t middle = good + (bad - good) / 2;
      (keeps(i, middle) ? good : bad) = middle;
    }
    note(over(i, good));
    return good;
  }

  void note(double deviation) { strip_.deviation_mm = std::max(strip_.deviation_mm, deviation); }

  void push(double at, const BlockEnd& end) {
    strip_.at.push_back(at);
    strip_.blocks.push_back(end);
    if (strip_.blocks.size() > options_.most_blocks) strip_.complete = false;
  }

  /// The planned pose at t of a step, with joints between those of two ends. Where the middle of the rotary joints turns
  /// the tool into the planned direction as nearly as matters, it is taken as it is: in the singular cone the angle that
  /// belongs to a direction says little, and joints that run evenly say more.
  BlockEnd between(std::size_t step, double t, const BlockEnd& from, const BlockEnd& to) const {
    const Pose plan = planned(step, t);
    const RotaryValues a = kinematics_.rotary_of(from.joints), b = kinematics_.rotary_of(to.joints);
    const RotaryValues middle{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
    if (control_.states_rotary()) {
      const Vec3 turned = kinematics_.direction(middle);
      if ((turned - plan.axis).norm() <= singular_cone(span_, options_.deviation)) {
        const Vec3 tip = plan.tip - span_.low * turned;
        return {{tip, turned}, kinematics_.joints(tip, middle)};
      }
    }
    const Pose pose{plan.at(-span_.low), plan.axis};
    return {pose, kinematics_.joints(pose.tip, nearest_rotary(kinematics_, pose.axis, middle))};
  }

  void divide(std::size_t step, double t0, const BlockEnd& from, double t1, const BlockEnd& to, int depth) {
    if (!strip_.complete) return;
    const double deviation = over_step(from, to, bend_of(from, to), step, t0, t1, 0.0, 1.0);
    if (deviation <= options_.deviation || depth == kMostHalvings) {
      note(deviation);
      push(static_cast<double>(step) + t1, to);
      if (t1 < 1.0) ++strip_.inserted;
      return;
    }
    const double t = 0.5 * (t0 + t1);
    const BlockEnd middle = between(step, t, from, to);
    divide(step, t0, from, t, middle, depth + 1);
    divide(step, t, middle, t1, to, depth + 1);
  }

  const Kinematics& kinematics_;
  const ControlMotion& control_;
  std::span<const Pose> poses_;
  std::span<const JointValues> joints_;
  ToolSpan span_;
  LineariseOptions options_;
  std::vector<double> length_;
  LinearisedStrip strip_;
};

}  // namespace

double singular_cone(const ToolSpan& span, double deviation) { return kConeShare * deviation / (span.high - span.low); }

LinearisedStrip linearise(const Kinematics& kinematics, const ControlMotion& control, std::span<const Pose> poses,
                          std::span<const JointValues> joints, const ToolSpan& span, const LineariseOptions& options) {
  return Lineariser(kinematics, control, poses, joints, span, options).run();
}

}  // namespace flank::internal
