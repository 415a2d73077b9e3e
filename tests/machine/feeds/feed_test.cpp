// Feeds: limits are kept at every millisecond, and what is found is near what an independent search finds.
#include "flank/machine/feeds/feed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"
#include "flank/machine/feeds/s_curve.h"
#include "flank/machine/model/machine_file.h"

namespace flank::internal {
namespace {

/// Corners of smooth ways are smooth again.
constexpr double kRounding = 0.1;

/// Joint 2 alone, from 0 to `length` in `count` ways.
std::vector<FeedNode> straight(double length, int count, double cap) {
  std::vector<FeedNode> nodes;
  for (int k = 0; k <= count; ++k) {
    FeedNode node;
    node.joints[2] = length * k / count;
    node.length = k == 0 ? 0.0 : length / count;
    node.cap = cap;
    node.block = k - 1;
    nodes.push_back(node);
  }
  return nodes;
}

Machine machine_of(double speed, double acceleration) {
  Machine machine = read_machine("fanuc-ac");
  for (Joint& joint : machine.joints) joint.speed = speed, joint.acceleration = acceleration;
  return machine;
}

/// A bent way in two joints, smooth.
std::vector<FeedNode> bent(int count, double cap) {
  std::vector<FeedNode> nodes;
  for (int k = 0; k <= count; ++k) {
    const double t = static_cast<double>(k) / count;
    FeedNode node;
    node.joints[2] = 60.0 * t;
    node.joints[3] = 15.0 * std::sin(5.0 * t) + 4.0 * std::sin(17.0 * t);
    node.cap = cap;
    if (k > 0)
      node.length = std::hypot(node.joints[2] - nodes.back().joints[2], node.joints[3] - nodes.back().joints[3]);
    nodes.push_back(node);
  }
  return nodes;
}

TEST(Feed, AStraightWayIsATrapezoid) {
  // 100 mm at 50 mm/s with 500 mm/s^2: 0.1 s up, 0.1 s down, 2.5 mm in each; 95 mm at full speed.
  const Machine machine = machine_of(50.0, 500.0);
  const auto nodes = straight(100.0, 400, 1e9);
  const FeedPlan plan = plan_feed(machine, nodes, kRounding);
  EXPECT_NEAR(plan.time_s, 2.1, 0.02);
  EXPECT_GE(plan.time_s, 2.1 - 1e-9);
  EXPECT_LE(check_feed(machine, nodes, plan).worst_acceleration, 1.0 + 1e-5);
  // Too short to reach full speed: two parabolas.
  const auto little = straight(2.0, 400, 1e9);
  EXPECT_NEAR(plan_feed(machine, little, kRounding).time_s, 2.0 * std::sqrt(2.0 / 500.0), 0.005);
  // A cap is a speed that is not exceeded.
  EXPECT_NEAR(plan_feed(machine, straight(100.0, 400, 20.0), kRounding).time_s, 100.0 / 20.0 + 20.0 / 500.0, 0.02);
}

Machine machine_of(double speed, double acceleration, double jerk) {
  Machine machine = machine_of(speed, acceleration);
  for (Joint& joint : machine.joints) joint.jerk = jerk;
  return machine;
}

/// Of joint 2 by the third differences of its place, every millisecond.
double largest_jerk(const FeedPlan& plan) {
  double largest = 0.0;
  for (std::size_t k = 3; k < plan.way.size(); ++k)
    largest =
        std::max(largest, std::abs(plan.way[k] - 3.0 * plan.way[k - 1] + 3.0 * plan.way[k - 2] - plan.way[k - 3]));
  return largest / 1e-9;
}

TEST(Feed, WithALimitOfJerkAStraightWayTakesTheTimeOfItsSevenParts) {
  for (const double jerk : {5000.0, 20000.0, 100000.0}) {
    const auto nodes = straight(100.0, 2000, 1e9);
    const FeedPlan plan = plan_feed(machine_of(50.0, 500.0, jerk), nodes, kRounding);
    const double least = seconds_from_rest_to_rest(100.0, {50.0, 500.0, jerk});
    EXPECT_NEAR(plan.time_s, least, 0.004) << jerk;
    EXPECT_LE(largest_jerk(plan), 1.01 * jerk);
    double seconds = 0.0;
    for (const double here : plan.seconds) seconds += here;
    EXPECT_NEAR(seconds, plan.time_s, 1e-9);
  }
}

TEST(Feed, WithALimitOfJerkAShortWayIsLittleSlowerThanTheFastest) {
  for (const double way : {0.5, 2.0, 6.0}) {
    const FeedPlan plan = plan_feed(machine_of(50.0, 500.0, 20000.0), straight(way, 400, 1e9), kRounding);
    const double least = seconds_from_rest_to_rest(way, {50.0, 500.0, 20000.0});
    EXPECT_GT(plan.time_s, least - 0.002) << way;
    EXPECT_LT(plan.time_s, 1.15 * least + 0.002) << way;
    EXPECT_LE(largest_jerk(plan), 1.01 * 20000.0) << way;
  }
}

TEST(Feed, WithALimitOfJerkNoOtherLimitIsExceededOnABentWay) {
  const Machine free = machine_of(120.0, 1500.0), machine = machine_of(120.0, 1500.0, 60000.0);
  const auto nodes = bent(3000, 80.0);
  const FeedPlan without = plan_feed(free, nodes, kRounding), plan = plan_feed(machine, nodes, kRounding);
  const FeedCheck check = check_feed(machine, nodes, plan);
  EXPECT_LE(check.worst_speed, 1.0 + 1e-3);
  EXPECT_LE(check.worst_acceleration, 1.05);
  EXPECT_GT(plan.time_s, without.time_s);
  EXPECT_LT(plan.time_s, 1.6 * without.time_s);
  // The joints' own third differences over 5 ms, which the bends of the way between its nodes do not hide.
  std::vector<double> ways{0.0};
  for (std::size_t i = 1; i < plan.step.size(); ++i) ways.push_back(ways.back() + plan.step[i]);
  const auto joint_at = [&](std::size_t k, std::size_t joint) {
    const double at = plan.way[std::min(k, plan.way.size() - 1)];
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(std::upper_bound(ways.begin(), ways.end(), at) - ways.begin(), 1,
                                   static_cast<std::ptrdiff_t>(ways.size()) - 1));
    return std::lerp(nodes[i - 1].joints[joint], nodes[i].joints[joint], (at - ways[i - 1]) / plan.step[i]);
  };
  constexpr std::size_t kApart = 5;
  for (std::size_t k = 0; k < plan.way.size(); ++k)
    for (const std::size_t joint : {std::size_t{2}, std::size_t{3}}) {
      const double third = joint_at(k + 3 * kApart, joint) - 3.0 * joint_at(k + 2 * kApart, joint) +
                           3.0 * joint_at(k + kApart, joint) - joint_at(k, joint);
      ASSERT_LE(std::abs(third) / std::pow(1e-3 * kApart, 3), 1.1 * 60000.0) << k;
    }
}

TEST(Feed, LimitsHoldEveryMillisecondOnAnyWay) {
  Random random(4);
  for (int trial = 0; trial < 6; ++trial) {
    const Machine machine = machine_of(random.uniform(20, 300), random.uniform(100, 4000));
    std::vector<FeedNode> nodes;
    JointValues at{};
    for (int k = 0; k < 60; ++k) {
      FeedNode node;
      const double step = std::pow(10.0, random.uniform(-3, -1));
      for (double& q : at) q += step * random.uniform(-1, 1);
      node.joints = at;
      node.length = k == 0 ? 0.0 : step;
      node.cap = random.uniform(5, 500);
      nodes.push_back(node);
    }
    const FeedPlan plan = plan_feed(machine, nodes, std::pow(10.0, random.uniform(-3, -1)));
    const FeedCheck check = check_feed(machine, nodes, plan);
    EXPECT_LE(check.worst_speed, 1.0 + 1e-5) << trial;
    EXPECT_LE(check.worst_acceleration, 1.0 + 1e-5) << trial;
    EXPECT_TRUE(std::isfinite(plan.time_s));
    EXPECT_EQ(plan.speed.front(), 0.0);
    EXPECT_EQ(plan.speed.back(), 0.0);
  }
}

/// The least time of a way by brute force: dynamic programming over speeds at every node, each step within the limits as
/// the definition has them. It shares nothing with the planner.
double searched_time(const Machine& machine, const std::vector<FeedNode>& nodes, double top, int levels) {
  const std::size_t n = nodes.size();
  std::vector<double> time(static_cast<std::size_t>(levels + 1), 1e300);
  time[0] = 0.0;
  const auto rate = [&](std::size_t i, std::size_t k) {
    return (nodes[i].joints[k] - nodes[i - 1].joints[k]) / nodes[i].length;
  };
  for (std::size_t i = 1; i < n; ++i) {
    std::vector<double> next(time.size(), 1e300);
    const double h = nodes[i].length;
    for (int a = 0; a <= levels; ++a) {
      if (time[static_cast<std::size_t>(a)] > 1e299) continue;
      for (int b = 0; b <= levels; ++b) {
        if (a + b == 0) continue;
        const double v0 = top * a / levels, v1 = top * b / levels, u = (v1 * v1 - v0 * v0) / (2.0 * h);
        bool allowed = true;
        for (std::size_t k = 0; k < kJointCount && allowed; ++k) {
          const Joint& joint = machine.joints[k];
          const double q1 = rate(i, k), v = std::max(v0, v1);
          const double q2 = i > 1 ? (q1 - rate(i - 1, k)) / std::min(h, nodes[i - 1].length) : 0.0;
          allowed = std::abs(q1) * v <= joint.speed && std::abs(q1 * u + q2 * v0 * v0) <= joint.acceleration;
        }
        if (allowed)
          next[static_cast<std::size_t>(b)] =
              std::min(next[static_cast<std::size_t>(b)], time[static_cast<std::size_t>(a)] + 2.0 * h / (v0 + v1));
      }
    }
    time = next;
  }
  return time[0];
}

/// The least time of a way by convex optimisation (Verscheure et al. 2009): over the squared speeds x at the nodes the time
/// is convex and every limit is linear, so a barrier method finds the one optimum. It shares nothing with the planner.
class Optimiser {
 public:
  Optimiser(const Machine& machine, const std::vector<FeedNode>& nodes) : nodes_(nodes), x_(nodes.size(), 1e-4) {
    x_.front() = x_.back() = 0.0;
    for (std::size_t i = 1; i < nodes.size(); ++i)
      for (std::size_t k = 0; k < kJointCount; ++k) add_limits(machine.joints[k], i, k);
  }

  double time() {
    // The time is above the optimum by no more than the number of limits over the weight.
    for (double weight = 1e2; static_cast<double>(limits_.size()) / weight > 1e-5; weight *= 5.0)
      for (int step = 0; step < 60 && newton(weight); ++step) continue;
    return time_of(x_);
  }

 private:
  /// before x_{i-1} + here x_i <= most.
  struct Limit {
    std::size_t i;
    double before, here, most;
  };

  double rate(std::size_t i, std::size_t k) const {
    return (nodes_[i].joints[k] - nodes_[i - 1].joints[k]) / nodes_[i].length;
  }
  void add_limits(const Joint& joint, std::size_t i, std::size_t k) {
    const double q1 = rate(i, k), h = nodes_[i].length;
    if (q1 != 0.0) {
      const double most = joint.speed * joint.speed / (q1 * q1);
      limits_.push_back({i, 0.0, 1.0, most});
      limits_.push_back({i, 1.0, 0.0, most});
    }
    const double q2 = i > 1 ? (q1 - rate(i - 1, k)) / std::min(h, nodes_[i - 1].length) : 0.0;
    for (const double sign : {1.0, -1.0})
      limits_.push_back({i, sign * (q2 - q1 / (2.0 * h)), sign * q1 / (2.0 * h), joint.acceleration});
  }
  double time_of(const std::vector<double>& x) const {
    double sum = 0.0;
    for (std::size_t i = 1; i < x.size(); ++i) sum += 2.0 * nodes_[i].length / (std::sqrt(x[i - 1]) + std::sqrt(x[i]));
    return sum;
  }
  double value(const std::vector<double>& x, double weight) const {
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
      if (!(x[i] > 0.0)) return 1e300;
    double sum = weight * time_of(x);
    for (const Limit& l : limits_) {
      const double room = l.most - l.before * x[l.i - 1] - l.here * x[l.i];
      if (!(room > 0.0)) return 1e300;
      sum -= std::log(room);
    }
    return sum;
  }
  /// One step; false where nothing is gained any more.
  bool newton(double weight) {
    const std::size_t n = x_.size();
    std::vector<double> gradient(n, 0.0), diagonal(n, 0.0), beside(n, 0.0);  // beside[i]: of i - 1 and i
    for (std::size_t i = 1; i < n; ++i) {
      const double a = x_[i - 1], b = x_[i], s = std::sqrt(a) + std::sqrt(b), h = weight * nodes_[i].length;
      for (const std::size_t j : {i - 1, i}) {
        const double y = x_[j];
        if (!(y > 0.0)) continue;
        gradient[j] -= h / (s * s * std::sqrt(y));
        diagonal[j] += h / (2.0 * s * s * y * std::sqrt(y)) + h / (s * s * s * y);
      }
      if (a > 0.0 && b > 0.0) beside[i] += h / (s * s * s * std::sqrt(a * b));
    }
    for (const Limit& l : limits_) {
      const double room = l.most - l.before * x_[l.i - 1] - l.here * x_[l.i];
      gradient[l.i - 1] += l.before / room, gradient[l.i] += l.here / room;
      diagonal[l.i - 1] += l.before * l.before / (room * room), diagonal[l.i] += l.here * l.here / (room * room);
      beside[l.i] += l.before * l.here / (room * room);
    }
    // The ends stand still; between them a tridiagonal system.
    std::vector<double> step(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      if (i > 1) {
        const double share = beside[i] / diagonal[i - 1];
        diagonal[i] -= share * beside[i];
        gradient[i] -= share * gradient[i - 1];
      }
    }
    for (std::size_t i = n - 2; i >= 1; --i)
      step[i] = (-gradient[i] - (i + 2 < n ? beside[i + 1] * step[i + 1] : 0.0)) / diagonal[i];
    const double now = value(x_, weight);
    for (double length = 1.0; length > 1e-10; length *= 0.5) {
      std::vector<double> next = x_;
      for (std::size_t i = 1; i + 1 < n; ++i) next[i] += length * step[i];
      const double then = value(next, weight);
      if (!(then < now)) continue;
      x_ = next;
      return now - then > 1e-9;
    }
    return false;
  }

  const std::vector<FeedNode>& nodes_;
  std::vector<double> x_;
  std::vector<Limit> limits_;
};

// Two rivals that share nothing with the planner: brute force, which no optimum is above, and the convex optimum itself.
TEST(Feed, IsNearTheOptimumThatOthersFind) {
  const Machine machine = machine_of(80.0, 800.0);
  const auto nodes = bent(200, 1e9);
  const double searched = searched_time(machine, nodes, 80.0, 240), optimum = Optimiser(machine, nodes).time();
  const FeedPlan plan = plan_feed(machine, nodes, kRounding);
  EXPECT_LE(optimum, searched);
  EXPECT_GT(optimum, 0.9 * searched) << "the search is fine enough to see a slip";
  EXPECT_LT(plan.time_s, 1.05 * optimum);
  RecordProperty("share_above_search", std::to_string(plan.time_s / searched - 1.0));
  RecordProperty("share_above_optimum", std::to_string(plan.time_s / optimum - 1.0));
}

TEST(Feed, OptimalBeatsTheBestConstantSpeed) {
  const Machine machine = machine_of(80.0, 800.0);
  const auto fast = bent(300, 1e9);
  const double constant = constant_speed(machine, fast, kRounding);
  const double optimal = plan_feed(machine, fast, kRounding).time_s,
               steady = plan_feed(machine, bent(300, constant), kRounding).time_s;
  EXPECT_LT(optimal, 0.95 * steady);
  RecordProperty("optimal_s", std::to_string(optimal));
  RecordProperty("constant_s", std::to_string(steady));
}

}  // namespace
}  // namespace flank::internal
