#include "flank/machine/feeds/feed_motion.h"

namespace flank::internal {

JointValues joints_at(std::span<const FeedNode> nodes, const FeedPlan& plan, std::size_t i, double share) {
  const std::size_t near = share < 0.5 ? i - 1 : i;
  const double off = (share < 0.5 ? share : 1.0 - share) * plan.step[i], half = 0.5 * plan.bend[near];
  const double lift = off < half ? (half - off) * (half - off) / (4.0 * half) : 0.0;
  JointValues q{};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    q[j] = nodes[i - 1].joints[j] + share * (nodes[i].joints[j] - nodes[i - 1].joints[j]);
    if (lift > 0.0)
      q[j] += lift * ((nodes[near + 1].joints[j] - nodes[near].joints[j]) / plan.step[near + 1] -
                      (nodes[near].joints[j] - nodes[near - 1].joints[j]) / plan.step[near]);
  }
  return q;
}

FeedPlace FeedClock::at(std::size_t tick) {
  const bool by_way = !plan_.way.empty();
  const double at = by_way ? plan_.way[std::min(tick, plan_.way.size() - 1)] : static_cast<double>(tick) * kFeedTick;
  const std::vector<double>& spans = by_way ? plan_.step : plan_.seconds;
  while (node_ < spans.size() && begun_ + spans[node_] <= at) begun_ += spans[node_++];
  if (node_ >= spans.size()) return {node_, 0.0};
  const double tau = (at - begun_) / spans[node_];
  if (by_way) return {node_, std::clamp(tau, 0.0, 1.0)};
  // The speed runs linearly in time: the share of the way is quadratic.
  const double v0 = plan_.speed[node_ - 1], v1 = plan_.speed[node_];
  const double share = v0 + v1 > 0.0 ? tau * (2.0 * v0 + (v1 - v0) * tau) / (v0 + v1)
                                     : (tau < 0.5 ? 2.0 * tau * tau : 1.0 - 2.0 * (1.0 - tau) * (1.0 - tau));
  return {node_, std::clamp(share, 0.0, 1.0)};
}

JointShares joint_shares(const Machine& machine, const JointValues& before, const JointValues& here,
                         const JointValues& next) {
  JointShares s;
  for (std::size_t k = 0; k < kJointCount; ++k) {
    s.speed = std::max(s.speed, std::abs(next[k] - here[k]) / kFeedTick / machine.joints[k].speed);
    s.acceleration = std::max(s.acceleration, std::abs(next[k] - 2.0 * here[k] + before[k]) / (kFeedTick * kFeedTick) /
                                                  machine.joints[k].acceleration);
  }
  return s;
}

FeedCheck check_feed(const Machine& machine, std::span<const FeedNode> nodes, const FeedPlan& plan) {
  FeedCheck check;
  sample(nodes, plan, [&](std::size_t, std::size_t, const JointValues& b, const JointValues& h, const JointValues& n) {
    ++check.samples;
    const JointShares s = joint_shares(machine, b, h, n);
    check.worst_speed = std::max(check.worst_speed, s.speed);
    check.worst_acceleration = std::max(check.worst_acceleration, s.acceleration);
    for (std::size_t k = 0; k < kJointCount; ++k) {
      check.speed[k] = std::max(check.speed[k], std::abs(n[k] - h[k]) / kFeedTick);
      check.acceleration[k] =
          std::max(check.acceleration[k], std::abs(n[k] - 2.0 * h[k] + b[k]) / (kFeedTick * kFeedTick));
    }
  });
  return check;
}

}  // namespace flank::internal
