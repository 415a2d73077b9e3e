#include "flank/strip/strip_order.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flank::internal {
namespace {

/// mm. An order has to be shorter by this: else round-off, which differs with the order of a sum, could make 2-opt go
/// round in circles, and ties would not go to the first.
constexpr double kShorter = 1e-9;

double way(const Pose& a, const Pose& b, double axis_length) {
  return 0.5 * ((a.tip - b.tip).norm() + (a.at(axis_length) - b.at(axis_length)).norm());
}

/// First and last poses of all strips.
struct Ends {
  std::vector<std::array<Pose, 2>> poses;
  double axis_length = 0.0;
  [[nodiscard]] double link(std::size_t from, char from_turned, std::size_t to, char to_turned) const {
    return way(poses[from][from_turned != 0 ? 0 : 1], poses[to][to_turned != 0 ? 1 : 0], axis_length);
  }
  [[nodiscard]] double length(const StripOrder& order) const {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < order.index.size(); ++i)
      sum += link(order.index[i], order.turned[i], order.index[i + 1], order.turned[i + 1]);
    return sum;
  }
};

StripOrder nearest_neighbours(const Ends& ends, std::size_t first, char turned) {
  StripOrder order{{first}, {turned}};
  std::vector<char> used(ends.poses.size(), 0);
  used[first] = 1;
  while (order.index.size() < ends.poses.size()) {
    double least = 1e300;
    std::size_t next = 0;
    char next_turned = 0;
    for (std::size_t k = 0; k < ends.poses.size(); ++k) {
      for (const char t : {char{0}, char{1}}) {
        if (used[k] != 0) continue;
        const double d = ends.link(order.index.back(), order.turned.back(), k, t);
        if (d >= least) continue;
        least = d;
        next = k;
        next_turned = t;
      }
    }
    used[next] = 1;
    order.index.push_back(next);
    order.turned.push_back(next_turned);
  }
  return order;
}

/// 2-opt: a stretch reversed as a whole, each of its strips turned, changes only the two links at its ends. i = j turns
/// one strip. The whole length is computed anew: there are few strips, and a sum of differences would drift.
void improve(const Ends& ends, StripOrder& order) {
  const auto n = static_cast<std::ptrdiff_t>(order.index.size());
  double length = ends.length(order);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      for (std::ptrdiff_t j = i; j < n; ++j) {
        StripOrder trial = order;
        std::reverse(trial.index.begin() + i, trial.index.begin() + j + 1);
        std::reverse(trial.turned.begin() + i, trial.turned.begin() + j + 1);
        for (std::ptrdiff_t k = i; k <= j; ++k) trial.turned[static_cast<std::size_t>(k)] ^= 1;
        const double d = ends.length(trial);
        if (d >= length - kShorter) continue;
        length = d;
        order = trial;
        changed = true;
      }
    }
  }
}

}  // namespace

RuledMotion reversed(const RuledMotion& motion) {
  RuledMotion back = motion;
  // t -> a + b - t on a B-spline: control points and knots in reverse order.
  for (BSplineCurve3* rail : {&back.tip, &back.direction}) {
    rail->poles = rail->poles.rowwise().reverse().eval();
    const double sum = rail->knots.front() + rail->knots.back();
    std::reverse(rail->knots.begin(), rail->knots.end());
    for (double& knot : rail->knots) knot = sum - knot;
  }
  return back;
}

double link_length(const RuledMotion& from, const RuledMotion& to) {
  return way(from.pose(1.0), to.pose(0.0), from.axis_length);
}

double link_length(const std::vector<RuledMotion>& motions) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < motions.size(); ++k) sum += link_length(motions[k], motions[k + 1]);
  return sum;
}

StripOrder strip_order(const std::vector<RuledMotion>& motions) {
  StripOrder best;
  if (motions.empty()) return best;
  Ends ends;
  ends.axis_length = motions.front().axis_length;
  for (const RuledMotion& motion : motions) ends.poses.push_back({motion.pose(0.0), motion.pose(1.0)});
  // Nearest neighbours depend much on where they begin, so every beginning is tried.
  double least = 1e300;
  for (std::size_t first = 0; first < motions.size(); ++first) {
    for (const char turned : {char{0}, char{1}}) {
      StripOrder order = nearest_neighbours(ends, first, turned);
      improve(ends, order);
      const double length = ends.length(order);
      if (length >= least - kShorter) continue;
      least = length;
      best = order;
    }
  }
  return best;
}

std::vector<RuledMotion> ordered(const std::vector<RuledMotion>& motions) {
  const StripOrder order = strip_order(motions);
  std::vector<RuledMotion> result;
  for (std::size_t i = 0; i < order.index.size(); ++i)
    result.push_back(order.turned[i] != 0 ? reversed(motions[order.index[i]]) : motions[order.index[i]]);
  return result;
}

}  // namespace flank::internal
