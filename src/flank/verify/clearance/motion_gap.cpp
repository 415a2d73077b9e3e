// Branch and bound over time and triangles. With D the farthest that any point of the body moves from its place in the
// middle of an interval, no distance falls by more than D in it. That bound is of first order and decides what is far.
// Near the minimum a second one does: with n the direction in which body and triangle are apart in the middle,
//
//     distance(tau) >= min over the triangle of <n, x> - h(tau),   h(tau) = support of the body's pose along n
//                    = max over its corners of <n, a(tau)> + z_i <n, u(tau)> + r_i |n x u(tau)|,
//
// which is exact in the middle and loses only by curvature. Where the body is entered and two of its sides are as near, the
// best mean of their two bounds is (triangle_gap.h). On the arc that u runs along, with its angle as parameter,
// <n, u>'' = -<n, u> and |n x u|'' >= -|n x u|, so h lies below its larger end value plus M (interval)^2 / 8, with
// M = max(|z| + r) (theta' ^2 + |theta''|), theta' <= |dw| / w^2 and |theta''| <= theta' |dw|^2 / w^2, w the least
// |w0 + tau dw|.
#include "flank/verify/clearance/motion_gap.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/verify/clearance/triangle_gap.h"

namespace flank::internal::verify {
namespace {

/// A segment is cut at once into intervals that move the body by no more than this: on longer ones the first-order
/// bound would open most of the tree, to no use. Or by no more than this share of the least clearance so far: what is farther away than
/// that the first-order bound decides at once. And into no more than so many, whatever a path's steps are.
constexpr double kFirstReachMm = 0.5, kFirstReach = 0.25;
constexpr int kMostIntervals = 1024;
constexpr double kDepthSlack = 0.25;  ///< of the bound that is allowed: error of the depth at one pose
constexpr int kFirstPoses = 48;       ///< looked at before all else, for a good value to compare with
constexpr std::size_t kBlock = 32;    ///< segments a task searches; fixed, so that threads change nothing

/// The tool's frame at a pose.
struct Frame {
  Vec3 origin, e1, e2, axis;

  explicit Frame(const Pose& pose) : origin(pose.tip), axis(pose.axis) {
    e1 = axis.unitOrthogonal();
    e2 = axis.cross(e1);
  }
  [[nodiscard]] Vec3 local(const Vec3& x) const {
    const Vec3 d = x - origin;
    return {e1.dot(d), e2.dot(d), axis.dot(d)};
  }
  [[nodiscard]] Vec3 turned(const Vec3& v) const { return v.x() * e1 + v.y() * e2 + v.z() * axis; }
};

struct Interval {
  int segment = 0;
  double low = 0.0, high = 1.0;

  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};

/// A triangle and one of the convex bodies.
struct Pair {
  int triangle = 0, body = 0;
};

}  // namespace

double gap_bound(double value, double accuracy_mm) { return std::max(accuracy_mm, -kDepthShare * value); }

MotionGap::MotionGap(const std::vector<Revolved>& body, const ObstacleTree& tree, const std::vector<Segment>& segments)
    : body_(body), tree_(tree), segments_(segments) {
  lowest_ = 1e300;
  highest_ = -1e300;
  for (const Revolved& part : body) {
    for (const Vec2& c : part.corners()) {
      lowest_ = std::min(lowest_, c.x());
      highest_ = std::max(highest_, c.x());
      widest_ = std::max(widest_, c.y());
    }
  }
}

/// The search of one task, with its scratch memory.
class GapSearch {
 public:
  /// `any`: the first place below the start is enough.
  GapSearch(const MotionGap& motion, double accuracy, const GapPlace& start, bool any = false)
      : motion_(motion), accuracy_(accuracy), any_(any), best_(start) {}

  [[nodiscard]] const GapPlace& best() const { return best_; }
  [[nodiscard]] bool ended() const { return any_ && best_.segment >= 0; }

  /// One pose alone: an interval of length 0, which gather() decides.
  void look_at(int segment, double tau) { gather({segment, tau, tau}); }

  void search(int segment) {
    const double reach = this->reach({segment, 0.0, 1.0});
    const double first = std::max(kFirstReachMm, kFirstReach * std::abs(best_.value));
    const int count = std::clamp(static_cast<int>(std::ceil(reach / first)), 1, kMostIntervals);
    for (int k = 0; k < count && !ended(); ++k) {
      const Interval interval{segment, static_cast<double>(k) / count, static_cast<double>(k + 1) / count};
      gather(interval);
      split(interval, 0);
    }
  }

 private:
  [[nodiscard]] const Segment& segment(const Interval& i) const {
    return motion_.segments_[static_cast<std::size_t>(i.segment)];
  }
  [[nodiscard]] double needed() const { return best_.value - gap_bound(best_.value, accuracy_); }
  [[nodiscard]] double reach(const Interval& interval) const;
  [[nodiscard]] double node_bound(const Frame& frame, const Sphere& sphere) const;
  [[nodiscard]] double later_support(const Interval& interval, const Revolved& body, const Vec3& n) const;
  [[nodiscard]] bool behind_slab(const Interval& interval, const Frame& frame, const ObstacleTree::Node& node) const;
  void gather(const Interval& interval);
  void check(const Interval& interval, const Frame& frame, double reach, Pair pair);
  void split(const Interval& interval, std::size_t begin);

  const MotionGap& motion_;
  double accuracy_;
  bool any_;
  GapPlace best_;
  std::vector<Pair> open_;  ///< pairs that an interval could not decide, a stack
  std::vector<std::pair<double, int>> nodes_;
};

/// Farthest that the interval takes a point of the body from where it is in the middle, turning the body about its own
/// axis as little as can be: a + z u + rho e with |d u| = |d e|. The change of u is linear but for that of |w|, whose
/// slope is at most |dw|^2 / (2 |w|).
double GapSearch::reach(const Interval& interval) const {
  const Segment& g = segment(interval);
  const double half = 0.5 * (interval.high - interval.low), turn = g.dw.norm();
  if (half == 0.0) return 0.0;
  const double least = std::sqrt(1.0 - 0.25 * turn * turn);
  const double middle = (g.w0 + interval.middle() * g.dw).norm();
  const double slack = half * turn * turn / (2.0 * least * least), sideways = half * turn / least;
  double farthest = 0.0;
  for (double z : {motion_.lowest_, motion_.highest_})
    farthest = std::max(farthest, half * (g.da + (z / middle) * g.dw).norm() + std::abs(z) * slack);
  return farthest + motion_.widest_ * sideways;
}

double GapSearch::node_bound(const Frame& frame, const Sphere& sphere) const {
  const Vec3 d = sphere.center - frame.origin;
  const double z = d.dot(frame.axis), rho = std::sqrt(std::max(0.0, d.squaredNorm() - z * z));
  double least = 1e300;
  for (const Revolved& body : motion_.body_) least = std::min(least, body.floor(z, rho));
  return least - sphere.radius;
}

/// Upper bound of the body's support along n over the interval: h of the derivation on top, ends and curvature.
double GapSearch::later_support(const Interval& interval, const Revolved& body, const Vec3& n) const {
  const Segment& g = segment(interval);
  double ends = -1e300, sizes = 0.0;
  for (double tau : {interval.low, interval.high}) {
    const Pose pose = g.at(tau);
    const double along = n.dot(pose.axis), across = n.cross(pose.axis).norm();
    const Vec2& c = body.support(along, across);
    ends = std::max(ends, n.dot(pose.tip) + c.x() * along + c.y() * across + body.rounding());
  }
  for (const Vec2& c : body.corners()) sizes = std::max(sizes, std::abs(c.x()) + c.y());
  const double squared = g.dw.squaredNorm(), least = 1.0 - 0.25 * squared;
  const double turn = std::sqrt(squared) / least, bend = turn * (turn + squared / least) * sizes;
  const double open = interval.high - interval.low;
  return ends + 0.125 * bend * open * open;
}

/// Whether the slab alone keeps every triangle of the node far enough for the whole interval: faces that the body runs
/// along in parallel are settled by it at once.
bool GapSearch::behind_slab(const Interval& interval, const Frame& frame, const ObstacleTree::Node& node) const {
  const double middle = 0.5 * (motion_.lowest_ + motion_.highest_);
  const bool above = 2.0 * node.normal.dot(frame.origin + middle * frame.axis) > node.low + node.high;
  const Vec3 n = above ? Vec3(-node.normal) : node.normal;
  const double near = above ? -node.high : node.low;
  for (const Revolved& body : motion_.body_)
    if (near - later_support(interval, body, n) < needed()) return false;
  return true;
}

void GapSearch::check(const Interval& interval, const Frame& frame, double reach, Pair pair) {
  const Revolved& body = motion_.body_[static_cast<std::size_t>(pair.body)];
  const Sphere sphere = motion_.tree_.sphere(pair.triangle);
  const Vec3 center = frame.local(sphere.center);
  // Depths need not be exact: what they lack counts as reach.
  const double slack = best_.value < 0.0 ? kDepthSlack * gap_bound(best_.value, accuracy_) : kDepthErrorMm;
  const double enough = needed() + reach + slack;
  if (body.floor(center.z(), center.head<2>().norm()) - sphere.radius >= enough) return;
  const std::array<Vec3, 3> corners = motion_.tree_.corners(pair.triangle);
  const TriangleGap gap =
      triangle_gap(body, {frame.local(corners[0]), frame.local(corners[1]), frame.local(corners[2])}, enough, slack);
  if (gap.value >= enough) return;
  if (gap.value < best_.value) {
    const Vec3 on_body = gap.point - gap.value * gap.normal;
    best_ = {gap.value,
             interval.segment,
             interval.middle(),
             motion_.tree_.number(pair.triangle),
             frame.origin + frame.turned(gap.point),
             on_body.z(),
             on_body.head<2>().norm()};
  }
  if (reach == 0.0 || gap.value - slack - reach >= needed()) return;
  std::array<std::array<double, 3>, 2> apart;
  std::array<Vec3, 2> normals{gap.normal, gap.normal};
  if (gap.value < 0.0) normals = facing_normals(body, gap.point);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 n = frame.turned(normals[i]);
    const double support = later_support(interval, body, n);
    for (std::size_t k = 0; k < 3; ++k) apart[i][k] = n.dot(corners[k]) - support;
  }
  if (least_of_larger(apart[0], apart[1]) >= needed()) return;
  open_.push_back(pair);
}

/// Looks through the tree; what the interval leaves undecided is in open_.
void GapSearch::gather(const Interval& interval) {
  open_.clear();
  const Frame frame(segment(interval).at(interval.middle()));
  const double reach = this->reach(interval);
  nodes_.assign(1, {node_bound(frame, motion_.tree_.node(0).sphere), 0});
  while (!nodes_.empty() && !ended()) {
    const auto [bound, index] = nodes_.back();
    nodes_.pop_back();
    if (bound >= needed() + reach) continue;
    const ObstacleTree::Node& node = motion_.tree_.node(index);
    if (node.flat && behind_slab(interval, frame, node)) continue;
    if (node.second < 0) {
      for (int k = node.first; k < node.end; ++k)
        for (int b = 0; b < static_cast<int>(motion_.body_.size()); ++b) check(interval, frame, reach, {k, b});
      continue;
    }
    std::pair<double, int> near{node_bound(frame, motion_.tree_.node(index + 1).sphere), index + 1};
    std::pair<double, int> far{node_bound(frame, motion_.tree_.node(node.second).sphere), node.second};
    if (far.first < near.first) std::swap(near, far);
    nodes_.push_back(far);
    nodes_.push_back(near);
  }
}

/// Halves the interval for the pairs open_[begin...]. An end is reached: once the body moves by less than the accuracy
/// in it, the first-order bound decides.
void GapSearch::split(const Interval& interval, std::size_t begin) {
  const std::size_t end = open_.size();
  if (begin == end || ended()) return;
  const double middle = interval.middle();
  for (const Interval& half :
       {Interval{interval.segment, interval.low, middle}, Interval{interval.segment, middle, interval.high}}) {
    const Frame frame(segment(half).at(half.middle()));
    const double reach = this->reach(half);
    for (std::size_t k = begin; k < end; ++k) check(half, frame, reach, open_[k]);
    split(half, end);
    open_.resize(end);
  }
}

double MotionGap::at(int segment, double tau, double accuracy_mm, double limit_mm) const {
  FLANK_ASSERT(segment >= 0 && static_cast<std::size_t>(segment) < segments_.size());
  FLANK_ASSERT(0.0 <= tau && tau <= 1.0);
  GapPlace start;
  start.value = limit_mm;
  if (body_.empty() || tree_.empty()) return limit_mm;
  GapSearch search(*this, accuracy_mm, start);
  search.look_at(segment, tau);
  return search.best().value;
}

GapPlace MotionGap::search(GapPlace start, double accuracy_mm, bool any) const {
  FLANK_ASSERT(accuracy_mm > 0.0);
  if (body_.empty() || tree_.empty() || segments_.empty()) return start;
  // A good value early makes the bounds of all tasks bite: a few poses spread over the path, before any interval.
  GapSearch first(*this, accuracy_mm, start, any);
  const std::size_t poses = std::min<std::size_t>(kFirstPoses, segments_.size());
  for (std::size_t k = 0; k < poses && !first.ended(); ++k)
    first.look_at(static_cast<int>(k * segments_.size() / poses), 0.5);
  start = first.best();
  std::atomic<bool> ended = first.ended();
  std::vector<GapPlace> found((segments_.size() + kBlock - 1) / kBlock);
  parallel_blocks(segments_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    GapSearch search(*this, accuracy_mm, start, any);
    for (std::size_t k = begin; k < end && !ended; ++k) {
      search.search(static_cast<int>(k));
      if (search.ended()) ended = true;
    }
    found[begin / kBlock] = search.best();
  });
  for (const GapPlace& place : found)
    if (place.value < start.value) start = place;
  return start;
}

GapPlace MotionGap::least(double accuracy_mm, double limit_mm) const {
  return search({.value = limit_mm}, accuracy_mm, false);
}

bool MotionGap::stays_above(double least_mm, double accuracy_mm) const {
  return search({.value = least_mm + 2.0 * gap_bound(least_mm, accuracy_mm)}, accuracy_mm, true).segment < 0;
}

}  // namespace flank::internal::verify
