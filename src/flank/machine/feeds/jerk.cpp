#include "flank/machine/feeds/jerk.h"

#include <algorithm>
#include <cmath>

#include "flank/machine/feeds/feed_motion.h"

namespace flank::internal {
namespace {

/// Of a limit of jerk: what third differences cannot tell from the limit itself.
constexpr double kJerkSlack = 0.01;
/// Of the other limits, which the unsmoothed plan keeps between its nodes, too.
constexpr double kSlack = 1e-3;

double length_of(const FeedPlan& plan) {
  double length = 0.0;
  for (const double step : plan.step) length += step;
  return length;
}

/// The place along the path every millisecond, mm, from rest at its beginning to rest at its end.
std::vector<double> way_of(const FeedPlan& plan) {
  std::vector<double> begins(plan.step.size(), 0.0);
  for (std::size_t i = 2; i < plan.step.size(); ++i) begins[i] = begins[i - 1] + plan.step[i - 1];
  const double length = length_of(plan);
  std::vector<double> way{0.0};
  FeedClock clock(plan);
  for (std::size_t k = 1; way.back() < length; ++k) {
    const FeedPlace place = clock.at(k);
    way.push_back(place.node < plan.step.size() ? begins[place.node] + place.share * plan.step[place.node] : length);
  }
  return way;
}

/// The mean of the last `count` places, from rest to rest.
std::vector<double> averaged(const std::vector<double>& way, std::size_t count) {
  std::vector<double> out;
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < way.size() + count; ++k) {
    sum += way[std::min(k, way.size() - 1)];
    if (k >= count) sum -= way[std::min(k - count, way.size() - 1)];
    out.push_back(std::min(sum / static_cast<double>(count), way.back()));
    if (out.size() > 1) out.back() = std::max(out.back(), out[out.size() - 2]);
  }
  out.back() = way.back();
  return out;
}

/// Times and speeds at the nodes, from the places at the milliseconds.
void take_times(FeedPlan& plan) {
  const std::vector<double>& way = plan.way;
  std::size_t k = 1;
  double at = 0.0, before_s = 0.0;
  for (std::size_t i = 1; i < plan.step.size(); ++i) {
    at += plan.step[i];
    while (k + 1 < way.size() && way[k] < at) ++k;
    const double step = way[k] - way[k - 1], share = step > 0.0 ? std::clamp((at - way[k - 1]) / step, 0.0, 1.0) : 1.0;
    const double here_s = (static_cast<double>(k - 1) + share) * kFeedTick;
    plan.seconds[i] = here_s - before_s;
    plan.speed[i] = i + 1 < plan.step.size() ? step / kFeedTick : 0.0;
    before_s = here_s;
  }
  plan.time_s = before_s;
}

/// Derivatives of a joint by the length.
struct Bends {
  double rate = 0.0, second = 0.0, third = 0.0;

  [[nodiscard]] double acceleration(double v, double a) const { return std::abs(rate * a + second * v * v); }
  [[nodiscard]] double jerk(double v, double a, double j) const {
    return std::abs(rate * j + 3.0 * second * v * a + third * v * v * v);
  }
};

/// The way as the curve that its nodes are places of. What is shorter than the ways between nodes, the parabola at a corner, has its own
/// second derivative, and counts for the acceleration alone.
class Geometry {
 public:
  Geometry(std::span<const FeedNode> nodes, const FeedPlan& plan) : nodes_(nodes), plan_(plan) {}

  [[nodiscard]] Bends bends(const FeedPlace& place, std::size_t joint) const {
    const std::size_t i = place.node;
    const double before = curve_at(i - 1, joint), after = curve_at(i, joint);
    return {rate(i, joint), std::lerp(before, after, place.share), (after - before) / plan_.step[i]};
  }
  [[nodiscard]] Bends corner(std::size_t node, std::size_t joint) const {
    if (is_end(node) || !(plan_.bend[node] > 0.0)) return {};
    return {rate(node + 1, joint), jump(node, joint) / plan_.bend[node], 0.0};
  }

 private:
  [[nodiscard]] bool is_end(std::size_t node) const { return node == 0 || node + 1 >= nodes_.size(); }
  [[nodiscard]] double rate(std::size_t i, std::size_t joint) const {
    return (nodes_[i].joints[joint] - nodes_[i - 1].joints[joint]) / plan_.step[i];
  }
  [[nodiscard]] double jump(std::size_t i, std::size_t joint) const { return rate(i + 1, joint) - rate(i, joint); }
  [[nodiscard]] double curve_at(std::size_t i, std::size_t joint) const {
    return is_end(i) ? 0.0 : jump(i, joint) / (0.5 * (plan_.step[i] + plan_.step[i + 1]));
  }

  std::span<const FeedNode> nodes_;
  const FeedPlan& plan_;
};

/// How a smoothed plan goes along the path at a millisecond.
struct Going {
  double v = 0.0, a = 0.0, j = 0.0;
};

Going going_at(const std::vector<double>& ways, std::size_t tick) {
  const auto way = [&](std::ptrdiff_t k) {
    const auto last = static_cast<std::ptrdiff_t>(ways.size()) - 1;
    return ways[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(tick) + k, 0, last))];
  };
  const double h = kFeedTick;
  return {(way(1) - way(-1)) / (2.0 * h), (way(1) - 2.0 * way(0) + way(-1)) / (h * h),
          (way(2) - 2.0 * way(1) + 2.0 * way(-1) - way(-2)) / (2.0 * h * h * h)};
}

/// Of the limits, the largest of all joints.
struct Shares {
  double speed = 0.0, acceleration = 0.0, jerk = 0.0;
};

/// visit(tick, place, shares) every millisecond, the corners on the way to it included.
template <class Visit>
void look(const Machine& machine, std::span<const FeedNode> nodes, const FeedPlan& plan, const Visit& visit) {
  const Geometry geometry(nodes, plan);
  FeedClock clock(plan);
  std::size_t before = 1;
  for (std::size_t k = 0; k < plan.way.size(); ++k) {
    const FeedPlace place = clock.at(k);
    if (place.node >= nodes.size()) break;
    const auto [v, a, j] = going_at(plan.way, k);
    Shares shares;
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      const Joint& limits = machine.joints[joint];
      const Bends bends = geometry.bends(place, joint);
      double acceleration = bends.acceleration(v, a);
      for (std::size_t node = before; node < place.node; ++node)
        acceleration = std::max(acceleration, geometry.corner(node, joint).acceleration(v, a));
      shares.speed = std::max(shares.speed, std::abs(bends.rate) * v / limits.speed);
      shares.acceleration = std::max(shares.acceleration, acceleration / limits.acceleration);
      shares.jerk = std::max(shares.jerk, bends.jerk(v, a, j) / limits.jerk);
    }
    before = place.node;
    visit(k, place, shares);
  }
}

}  // namespace

bool has_jerk_limits(const Machine& machine) {
  return std::any_of(machine.joints.begin(), machine.joints.end(),
                     [](const Joint& joint) { return std::isfinite(joint.jerk); });
}

FeedPlan smoothed(const Machine& machine, std::span<const FeedNode> nodes, FeedPlan plan) {
  const FeedCheck check = check_feed(machine, nodes, plan);
  double seconds = 0.0;
  for (std::size_t k = 0; k < kJointCount; ++k)
    seconds =
        std::max(seconds, std::min(check.acceleration[k], machine.joints[k].acceleration) / machine.joints[k].jerk);
  plan.average = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(seconds / kFeedTick - 1e-6)));
  plan.way = averaged(way_of(plan), plan.average);
  take_times(plan);
  return plan;
}

std::vector<TooFast> too_fast(const Machine& machine, std::span<const FeedNode> nodes, const FeedPlan& smoothed) {
  std::vector<TooFast> places;
  std::vector<std::size_t> node_at;
  FeedClock ahead(smoothed);
  // The average is of the places half its time before and after.
  const std::size_t half = smoothed.average / 2 + 1;
  look(machine, nodes, smoothed, [&](std::size_t tick, const FeedPlace& place, const Shares& shares) {
    node_at.push_back(place.node);
    const std::size_t first = node_at[tick - std::min(tick, half)] - 1;
    const std::size_t last = std::min(ahead.at(tick + half).node, nodes.size() - 1);
    if (std::max(shares.speed, shares.acceleration) <= 1.0 + kSlack && shares.jerk <= 1.0 + kJerkSlack) return;
    const double over =
        std::max({shares.speed * shares.speed, shares.acceleration, std::cbrt(shares.jerk * shares.jerk)});
    if (!places.empty() && places.back().first == first && places.back().last == last)
      places.back().over = std::max(places.back().over, over);
    else
      places.push_back({first, last, over});
  });
  return places;
}

FeedPlan stretched(const Machine& machine, std::span<const FeedNode> nodes, FeedPlan smoothed) {
  double over = 1.0;
  look(machine, nodes, smoothed, [&](std::size_t, const FeedPlace&, const Shares& shares) {
    over = std::max({over, shares.speed, std::sqrt(shares.acceleration), std::cbrt(shares.jerk / (1.0 + kJerkSlack))});
  });
  const std::vector<double> way = std::move(smoothed.way);
  smoothed.way.clear();
  const auto count = static_cast<std::size_t>(std::ceil(static_cast<double>(way.size()) * over)) + 1;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = std::min(static_cast<double>(k) / over, static_cast<double>(way.size() - 1));
    const auto before = std::min(static_cast<std::size_t>(at), way.size() - 2);
    smoothed.way.push_back(std::lerp(way[before], way[before + 1], at - static_cast<double>(before)));
  }
  take_times(smoothed);
  return smoothed;
}

}  // namespace flank::internal
