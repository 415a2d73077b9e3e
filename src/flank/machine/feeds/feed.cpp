#include "flank/machine/feeds/feed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/error.h"
#include "flank/machine/feeds/jerk.h"

namespace flank::internal {
namespace {

/// A way without contact length (a joint turns, the tool stays) still passes: this much length a second of its joints.
constexpr double kIdle = 1e-3;
constexpr int kMostPasses = 30;
/// Of a squared speed in one pass: what the neighbours of a node do counts, too.
constexpr double kMostSlowing = 4.0;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// low <= u <= high, both linear in x: low(x) = low0 + low1 x.
struct Line {
  double at0, slope;
};

/// Reachability over the squared speed x = (ds/dt)^2 (docs/algorithms/machine.md, Feeds).
class Planner {
 public:
  Planner(const Machine& machine, std::span<const FeedNode> nodes, double rounding) : machine_(machine), nodes_(nodes) {
    const std::size_t n = nodes.size();
    step_.assign(n, 0.0);
    rate_.assign(n, JointValues{});
    cap_.assign(n, kInfinite);
    for (std::size_t i = 1; i < n; ++i) measure(i);
    bend_.assign(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) bend_[i] = bend_length(i, rounding);
    for (std::size_t i = 0; i < n; ++i) cap_[i] = speed_cap(i);
    cap_.front() = cap_.back() = 0.0;  // from rest to rest
    share_.assign(n, 1.0);
  }

  FeedPlan run() {
    FeedPlan plan = solve();
    for (int pass = 0; pass < kMostPasses; ++pass)
      if (!slow_down_where_needed(plan))
        return has_jerk_limits(machine_) ? with_jerk_limits(std::move(plan)) : plan;
      else
        plan = solve();
    stretch(plan);
    return has_jerk_limits(machine_) ? with_jerk_limits(std::move(plan)) : plan;
  }

  /// Of every node: the squared speed that the joints' speeds and the bend of their way allow, without speeding up.
  double constant() const {
    double x = kInfinite;
    for (std::size_t i = 1; i + 1 < nodes_.size(); ++i) {
      x = std::min(x, cap_[i]);
      for (std::size_t k = 0; k < kJointCount; ++k) {
        const double bend = std::abs(bend_at(i, k));
        if (bend > 0.0) x = std::min(x, machine_.joints[k].acceleration / bend);
      }
    }
    return std::sqrt(x);
  }

 private:
  /// Length and the joints' change per length of the way to node i.
  void measure(std::size_t i) {
    double idle = 0.0;
    for (std::size_t k = 0; k < kJointCount; ++k)
      idle = std::max(idle, std::abs(nodes_[i].joints[k] - nodes_[i - 1].joints[k]) / machine_.joints[k].speed);
    // Never 0: rates and times divide by it. Two equal nodes become a way that is too short to count.
    step_[i] = std::max(nodes_[i].length + kIdle * idle, 1e-12);
    for (std::size_t k = 0; k < kJointCount; ++k)
      rate_[i][k] = (nodes_[i].joints[k] - nodes_[i - 1].joints[k]) / step_[i];
  }

  /// Largest squared speed on the way to node i: its own cap, and what no joint's speed exceeds.
  double speed_cap_of_way(std::size_t i) const {
    double v = nodes_[i].cap;
    for (std::size_t k = 0; k < kJointCount; ++k)
      if (rate_[i][k] != 0.0) v = std::min(v, machine_.joints[k].speed / std::abs(rate_[i][k]));
    return v * v;
  }

  double speed_cap(std::size_t i) const {
    double x = kInfinite;
    if (i > 0) x = std::min(x, speed_cap_of_way(i));
    if (i + 1 < nodes_.size()) x = std::min(x, speed_cap_of_way(i + 1));
    return x;
  }

  /// Of the parabola at a node: a corner whose rates jump by d is left by length d / 8.
  double bend_length(std::size_t i, double rounding) const {
    double jump = 0.0;
    for (std::size_t k = 0; k < kJointCount; ++k) {
      const double lever = machine_.joints[k].kind == JointKind::kRotary ? kFeedLeverMm : 1.0;
      jump = std::max(jump, lever * std::abs(rate_[i + 1][k] - rate_[i][k]));
    }
    const double room = std::min(step_[i], step_[i + 1]);
    return jump > 0.0 ? std::min(room, 8.0 * rounding / jump) : room;
  }

  double bend_at(std::size_t i, std::size_t k) const { return (rate_[i + 1][k] - rate_[i][k]) / bend_[i]; }

  /// The limits of u at node i: |q' u + q'' x| <= a of each joint, on both sides of the parabola. Lines from below and
  /// from above; `cap` where a joint does not depend on u.
  struct Bounds {
    std::array<Line, 2 * kJointCount + 1> low, high;
    std::size_t count = 0;
    double cap = kInfinite;
  };
  Bounds bounds_at(std::size_t i) const {
    Bounds b;
    for (std::size_t k = 0; k < kJointCount; ++k) {
      const double a = share_[i] * machine_.joints[k].acceleration, bend = i == 0 ? 0.0 : bend_at(i, k);
      if (bend != 0.0) b.cap = std::min(b.cap, a / std::abs(bend));
      add_side(b, rate_[i + 1][k], bend, a);
      if (i > 0) add_side(b, rate_[i][k], bend, a);
    }
    return b;
  }
  /// Solves |rate u + bend x| <= a for u: a band round the line -bend x / rate, of the half width a / |rate|.
  static void add_side(Bounds& b, double rate, double bend, double a) {
    if (std::abs(rate) < 1e-12) return;  // no u of ours moves this joint
    const double half = a / std::abs(rate), slope = -bend / rate;
    b.low[b.count] = {-half, slope};
    b.high[b.count] = {half, slope};
    ++b.count;
  }

  /// The largest x <= cap for which some u lies above all low lines and below all high lines.
  static double largest_feasible(const Bounds& b, std::size_t low_count, std::size_t high_count, double cap) {
    double x = std::min(cap, b.cap);
    for (std::size_t j = 0; j < low_count; ++j)
      for (std::size_t k = 0; k < high_count; ++k) {
        const double closing = b.low[j].slope - b.high[k].slope, room = b.high[k].at0 - b.low[j].at0;
        if (closing > 0.0) x = std::min(x, std::max(0.0, room) / closing);
      }
    return x;
  }

  FeedPlan solve() const {
    const std::size_t n = nodes_.size();
    // Backward: the largest squared speed from which the end can be reached.
    std::vector<double> reach(n, 0.0);
    for (std::size_t i = n - 1; i-- > 0;) {
      Bounds b = bounds_at(i);
      // 0 <= x + 2 step u <= reach of the next node.
      const double inverse = 1.0 / (2.0 * step_[i + 1]);
      b.low[b.count] = {0.0, -inverse};
      b.high[b.count] = {reach[i + 1] * inverse, -inverse};
      reach[i] = largest_feasible(b, b.count + 1, b.count + 1, cap_[i]);
    }
    // Forward: as fast as the joints speed up, never beyond what was found.
    std::vector<double> x(n, 0.0);
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const Bounds b = bounds_at(i);
      double u = kInfinite;
      for (std::size_t k = 0; k < b.count; ++k) u = std::min(u, b.high[k].at0 + b.high[k].slope * x[i]);
      x[i + 1] = std::clamp(x[i] + 2.0 * step_[i + 1] * u, 0.0, reach[i + 1]);
    }
    FeedPlan plan;
    plan.step = step_;
    plan.bend = bend_;
    plan.speed.resize(n);
    plan.seconds.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) plan.speed[i] = std::sqrt(x[i]);
    for (std::size_t i = 1; i < n; ++i) {
      const double sum = plan.speed[i] + plan.speed[i - 1];
      // From rest to rest over one way: as fast as it could be run up to its middle and stopped again.
      plan.seconds[i] = sum > 0.0 ? 2.0 * step_[i] / sum : rest_to_rest(i);
      plan.time_s += plan.seconds[i];
    }
    return plan;
  }

  /// Seconds of a way whose two ends stand: constant acceleration to its middle and back to rest needs 2 step / v for
  /// the speed limit and 2 sqrt(D / a) for a joint that goes D. The latter is doubled as well, which is on the safe
  /// side.
  double rest_to_rest(std::size_t i) const {
    double seconds = step_[i] / std::sqrt(speed_cap_of_way(i));
    for (std::size_t k = 0; k < kJointCount; ++k)
      seconds = std::max(seconds, 2.0 * std::sqrt(std::abs(rate_[i][k]) * step_[i] / machine_.joints[k].acceleration));
    return 2.0 * seconds;
  }

  /// Lowers caps and shares where a millisecond shows more than a limit; false if none does.
  bool slow_down_where_needed(const FeedPlan& plan);
  /// Slows the whole down until the limits hold.
  void stretch(FeedPlan& plan) const;
  /// The speeds again, smoothed until the jerk of no joint is too large.
  FeedPlan with_jerk_limits(FeedPlan plan);

  const Machine& machine_;
  std::span<const FeedNode> nodes_;
  std::vector<double> step_, cap_;  ///< length of the way to each node; largest squared speed at it
  std::vector<double> bend_;        ///< length of the parabola at each node
  std::vector<double> share_;       ///< of the accelerations that the plan may take at each node
  std::vector<JointValues> rate_;   ///< of the joints per length, on the way to each node
};

bool Planner::slow_down_where_needed(const FeedPlan& plan) {
  bool any = false;
  const std::vector<double> share = share_;
  sample(nodes_, plan,
         [&](std::size_t first, std::size_t last, const JointValues& b, const JointValues& h, const JointValues& n) {
           const JointShares s = joint_shares(machine_, b, h, n);
           if (std::max(s.speed, s.acceleration) <= 1.0 + kFeedSlack) return;
           any = true;
           for (std::size_t i = first; i <= last && i + 1 < nodes_.size(); ++i)
             if (s.speed > 1.0 + kFeedSlack || bend_[i] < plan.speed[i] * kFeedTick) {
               // A jump that is shorter than a tick falls with the speed, not with its square.
               const double over = std::max(s.speed * s.speed, s.acceleration);
               cap_[i] = std::min(cap_[i], plan.speed[i] * plan.speed[i] / std::min(1.02 * over * over, kMostSlowing));
             } else {
               // Along a parabola the squared speed is not that of its node. Less acceleration mends it where it is; a
               // lower speed would only have to be reached sooner, at the places before.
               share_[i] = std::min(share_[i], share[i] / (1.001 * s.acceleration));
             }
         });
  return any;
}

void Planner::stretch(FeedPlan& plan) const {
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const FeedCheck check = check_feed(machine_, nodes_, plan);
    const double over = std::max(check.worst_speed, check.worst_acceleration);
    if (over <= 1.0 + kFeedSlack) return;
    // Accelerations fall with the square of the time, so this is more than enough for them; a little more, lest
    // rounding asks for another pass.
    const double factor = over * (1.0 + 1e-3);
    plan.time_s = 0.0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      plan.seconds[i] *= factor;
      plan.speed[i] /= factor;
      plan.time_s += plan.seconds[i];
    }
  }
}

FeedPlan Planner::with_jerk_limits(FeedPlan plan) {
  constexpr int kMostJerkPasses = 200;
  // Smoothing fills the dips of the speed and lifts nothing else: where that is too much they become flat, and where the acceleration
  // changes its sign there is a stretch of constant speed.
  constexpr double kMostOver = 1.1;
  FeedPlan smooth = smoothed(machine_, nodes_, plan);
  for (int pass = 0; pass < kMostJerkPasses; ++pass) {
    const std::vector<TooFast> places = too_fast(machine_, nodes_, smooth);
    if (places.empty()) return smooth;
    for (const TooFast& place : places) {
      double fastest = 0.0;
      for (std::size_t i = place.first; i <= place.last; ++i) fastest = std::max(fastest, plan.speed[i]);
      const double most = fastest * fastest / std::min(1.001 * place.over, kMostOver);
      for (std::size_t i = place.first; i <= place.last; ++i) cap_[i] = std::min(cap_[i], most);
    }
    plan = solve();
    smooth = smoothed(machine_, nodes_, plan);
  }
  return stretched(machine_, nodes_, std::move(smooth));
}

}  // namespace

FeedPlan plan_feed(const Machine& machine, std::span<const FeedNode> nodes, double rounding) {
  if (nodes.size() < 2 || !(rounding > 0.0))
    throw InternalError("a feed needs at least two points of the path and a corner tolerance > 0");
  return Planner(machine, nodes, rounding).run();
}

double constant_speed(const Machine& machine, std::span<const FeedNode> nodes, double rounding) {
  return Planner(machine, nodes, rounding).constant();
}

}  // namespace flank::internal
