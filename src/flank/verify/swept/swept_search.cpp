// The node whose bound is lower first; a leaf is minimised by descent in (tau, s). docs/algorithms/judge.md derives the
// bounds.
#include "flank/verify/swept/swept_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "flank/base/assert.h"

namespace flank::internal::verify {
namespace {

constexpr double kSlackMm = 1e-11;  ///< a node must promise to be lower than the best by more than this to be opened
/// 1 - rho max q' (docs/algorithms/judge.md) has to be above this for one minimum over s to be relied on; at 0 a second
/// one appears. The reserve is for the moves of a piece.
constexpr double kLeastSingle = 0.1;
/// Least 1 - rho max q' at which the grid's s is as near to the minimiser as it says: nearer to 0 the minimiser moves ever
/// faster from node to node.
constexpr double kLeastSteady = 0.7;
constexpr double kSafety = 1.5;          ///< on the term of second order in a node's bound
constexpr double kCurvatureShare = 0.5;  ///< of the curvature across the motion that a node's bound counts on
/// A point nearer to the axis than this many reaches of a piece is not left to descent: its direction to the axis may
/// turn round.
constexpr double kNearReaches = 4.0;
/// Reaches of a node below which the second-order bound is not used: its terms divide by the distance.
constexpr double kFarReaches = 2.0;
constexpr int kMaxHops = 16;  ///< pieces, or strides of them, that a descent follows
/// Of the length that a piece may have so many make a dense path, which is looked at in stretches of that length first.
constexpr int kManyPieces = 32;
/// Two per level: enough for 2^40 pieces and as many strips; and the roots.
constexpr int kStackSize = 128 + SweptSearch::kMostRoots;

/// F of the node's linear motion at its middle: R(s) + y (half_tip + s half_turn), derivatives by y and s at y = 0.
DistanceJet linear_jet(const PoseNode& node, const RadialTable& radial, const Vec3& x, double s) {
  const Vec3 d = x - node.tip - s * node.axis, v = node.half_tip + s * node.half_turn;
  const RadialJet j = radial.at(s);
  DistanceJet out;
  out.distance = d.norm();
  const double inverse = 1.0 / out.distance;
  const Vec3 n = d * inverse;
  const double nv = n.dot(v), nu = n.dot(node.axis);
  out.f = out.distance - j.r;
  out.dt = -nv;
  out.ds = -nu - j.d1;
  out.dtt = (v.squaredNorm() - nv * nv) * inverse;
  out.dts = (v.dot(node.axis) - nv * nu) * inverse - n.dot(node.half_turn);
  out.dss = (1.0 - nu * nu) * inverse - j.d2;
  return out;
}

/// The least value within `half` of the middle by the model of second order with half its curvature; -1e300 if there is none.
double least_nearby(const DistanceJet& jet, double half) {
  if (!(jet.dss > 0.0)) return -1e300;
  const double curvature = jet.dtt - jet.dts * jet.dts / jet.dss;
  if (!(curvature > 0.0)) return jet.f + half * (curvature * half - std::abs(jet.dt));
  const double y = std::min(half, std::abs(jet.dt) / (0.5 * curvature));
  return jet.f + y * (0.25 * curvature * y - std::abs(jet.dt));
}

}  // namespace

// A sphere that is not nearer than the best value by more than the moves stays above it.
double SweptSearch::room(double z, double rho, double moves) const {
  const double everywhere = 1.0 - (rho + moves) * tool_.focal_curvature();
  if (everywhere > kLeastSteady) return everywhere;
  return 1.0 - (rho + moves) * tool_.focal_curvature(z, rho, best_.f + moves);
}

bool SweptSearch::single(const PlanePoint& at, double moves) const { return room(at.z, at.rho, moves) > kLeastSingle; }

// The second-order bound of docs/algorithms/judge.md, or the first-order one where that does not hold or is not needed.
// Spheres that stay above the best value are left out of it, so that it promises no more than that.
double SweptSearch::bound(const PoseNode& node) const {
  const Vec3 d = x_ - node.tip;
  const double z = d.dot(node.axis);
  const double squared_rho = std::max(0.0, d.squaredNorm() - z * z);
  const double rho = std::sqrt(squared_rho);
  // Mostly no sphere of these poses comes near enough, and that needs no grid.
  const double wide = tool_.least_of_wider(z, rho, node.low_reach, node.high_reach);
  if (wide >= best_.f - kSlackMm) return wide;
  const Estimate estimate = tool_.estimate(z, rho);
  const double plain = estimate.bound - node.reach;
  if (plain >= best_.f - kSlackMm) return plain;
  const double distance = std::sqrt((z - estimate.s) * (z - estimate.s) + squared_rho);
  if (distance < kFarReaches * node.reach) return plain;
  // The grid's s is made of the nearest spheres at the corners of a cell: they count as well.
  const double steady = room(z, rho, node.reach + 2.0 * estimate.cell);
  if (!(steady > kLeastSteady)) return plain;
  // The sphere at about the minimiser is above g by no more than its curvature over s allows; closer than the grid's
  // own bound.
  double least = estimate.bound;
  if (!estimate.near_end) {
    const double bend = 1.0 / distance + tool_.radial().largest_bend();
    least = std::max(least, distance - tool_.radial().radius(estimate.s) - bend * estimate.s_error * estimate.s_error);
  }
  const double inverse = 1.0 / distance;
  const Vec3 n = inverse * (d - estimate.s * node.axis);
  const Vec3 v = node.half_tip + estimate.s * node.half_turn;
  const double nv = std::abs(n.dot(v)), nu = inverse * (z - estimate.s);
  const double growth =
      steady * squared_rho * inverse * inverse * inverse - kSafety * 2.0 * inverse * (node.reach * inverse + node.turn);
  if (!(growth > 0.0)) return plain;
  const double change = (std::abs(v.dot(node.axis)) + nu * nv) * inverse + std::abs(n.dot(node.half_turn));
  const double slack =
      kSafety * 0.5 * change * change / growth + (change + growth * estimate.s_error) * estimate.s_error;
  const double rise = kCurvatureShare * (v.squaredNorm() - nv * nv) * inverse;
  const double fall = nv < rise ? 0.5 * nv * nv / rise : nv - 0.5 * rise;
  return std::max(plain, std::min(best_.f, least - fall - node.bend - slack));
}

// As open_leaf and open_single do with a piece: what a path of short steps is made of is not opened step by step.
double SweptSearch::close_bound(const PoseNode& node) const {
  const PlanePoint at = plane_point(node.tip, node.axis, x_);
  const NearestSphere sphere = tool_.nearest(at.z, at.rho);
  const double plain = sphere.g - node.reach;
  if (plain >= best_.f - kSlackMm || !single(at, node.reach)) return plain;
  if (std::hypot(at.z - sphere.s, at.rho) < kNearReaches * node.reach) return plain;
  const double least = least_nearby(linear_jet(node, tool_.radial(), x_, sphere.s), 1.0) - node.bend;
  return std::max(plain, std::min(best_.f, least));
}

bool SweptSearch::neighbours(int k, int next) const {
  return next >= 0 && next < static_cast<int>(tree_.pieces.size()) &&
         segment(piece(k)).strip == segment(piece(next)).strip;
}

int SweptSearch::stride_from(int at) const {
  const Piece& p = piece(at);
  const Segment& g = segment(p);
  const double moved = (p.high - p.low) * std::max(g.da.norm(), (g.da + tool_.radial().length() * g.dw).norm());
  const double pieces = 2.0 * tree_.reach_limit / std::max(moved, 2e-6 * tree_.reach_limit);
  return pieces < kManyPieces ? 1 : static_cast<int>(pieces);
}

// A minimum at the end of its piece may go on in the next one.
void SweptSearch::follow(int at, SegmentMinimum found) {
  int stride = stride_from(at);
  for (int hop = 0; hop < kMaxHops;) {
    const Piece& here = piece(at);
    const int next = found.tau >= here.high ? at + stride : found.tau <= here.low ? at - stride : -1;
    SegmentMinimum trial = found;
    if (neighbours(at, next)) {
      const Piece& there = piece(next);
      trial.tau = next > at ? there.low : there.high;
      if (!descend(segment(there), tool_.radial(), x_, there.low, there.high, trial)) trial.f = found.f;
    }
    if (trial.f < found.f) {
      found = trial;
      at = next;
      ++hop;
    } else if (stride == 1) {
      break;
    } else {
      stride = (stride + 1) / 2;
    }
  }
  if (found.f >= best_.f) return;
  keep(found, at);
  const Pose pose = segment(piece(at)).at(found.tau);
  settled_ = single(plane_point(pose.tip, pose.axis, x_), 2.0 * tree_.piece_reach) ? at : -1;
}

void SweptSearch::open_single(const PoseNode& node, const NearestSphere& sphere) {
  const Piece& p = piece(node.first_piece);
  SegmentMinimum found{sphere.g, 0.5 * (p.low + p.high), sphere.s};
  const DistanceJet jet = distance_jet(segment(p), tool_.radial(), x_, found.tau, found.s);
  if (least_nearby(jet, 0.5 * (p.high - p.low)) >= best_.f - kSlackMm) return;
  if (descend(segment(p), tool_.radial(), x_, p.low, p.high, found)) {
    follow(node.first_piece, found);
  } else {
    keep(bracketed_minimum(segment(p), tool_, x_, p.low, p.high), node.first_piece);
  }
}

// Where several minima over s compete, each one seen at the ends or in the middle of the piece is followed down.
void SweptSearch::open_forked(const PoseNode& node) {
  const Piece& p = piece(node.first_piece);
  std::array<double, ToolDistance::kMostMinima> starts;
  for (double tau : {0.5 * (p.low + p.high), p.low, p.high}) {
    const Pose pose = segment(p).at(tau);
    const PlanePoint at = plane_point(pose.tip, pose.axis, x_);
    const int count = tool_.minima(at.z, at.rho, best_.f + 2.0 * node.reach, starts);
    for (int i = 0; i < count; ++i) {
      SegmentMinimum found{0.0, tau, starts[static_cast<std::size_t>(i)]};
      if (!descend(segment(p), tool_.radial(), x_, p.low, p.high, found)) {
        keep(bracketed_minimum(segment(p), tool_, x_, p.low, p.high), node.first_piece);
        return;
      }
      keep(found, node.first_piece);
    }
  }
}

void SweptSearch::open_leaf(const PoseNode& node) {
  if (node.first_piece == settled_) return;
  const PlanePoint at = plane_point(node.tip, node.axis, x_);
  const NearestSphere sphere = tool_.nearest(at.z, at.rho);
  if (sphere.g - node.reach >= best_.f - kSlackMm) return;
  const double distance = std::hypot(at.z - sphere.s, at.rho);
  if (distance < kNearReaches * node.reach) {
    const Piece& p = piece(node.first_piece);
    keep(bracketed_minimum(segment(p), tool_, x_, p.low, p.high), node.first_piece);
  } else if (single(at, node.reach)) {
    open_single(node, sphere);
  } else {
    open_forked(node);
  }
}

void SweptSearch::start_at(const SweptPlace& near) {
  const Piece& p = piece(near.piece);
  SegmentMinimum found{0.0, std::clamp(near.tau, p.low, p.high), near.s};
  if (descend(segment(p), tool_.radial(), x_, p.low, p.high, found)) follow(near.piece, found);
}

double SweptSearch::least() const {
  if (tree_.nodes.empty()) return 1e300;
  const PoseNode& node = tree_.nodes.front();
  const PlanePoint at = plane_point(node.tip, node.axis, x_);
  return tool_.least_of_wider(at.z, at.rho, node.low_reach, node.high_reach);
}

SweptPlace SweptSearch::descend_from(const SweptPlace& near) {
  best_ = {1e300, -1, 0.0, 0.0};
  start_at(near);
  return best_;
}

SweptSearch::Open SweptSearch::promise_of(int k) const {
  const PoseNode& node = tree_.nodes[static_cast<std::size_t>(k)];
  // The node that holds the best place so far cannot be left out: its bound is not worth asking for.
  if (best_.piece >= node.first_piece && best_.piece < node.end_piece) return {k, -1e300};
  double promised = bound(node);
  const bool dense = node.end_piece - node.first_piece >= kManyPieces && node.reach <= tree_.reach_limit;
  if (dense && promised < best_.f - kSlackMm) promised = std::max(promised, close_bound(node));
  return {k, promised};
}

SweptPlace SweptSearch::run(double horizon, const SweptPlace& near) {
  constexpr std::array<int, 1> kWhole{0};
  return run(horizon, near, kWhole);
}

SweptPlace SweptSearch::run(double horizon, const SweptPlace& near, std::span<const int> roots) {
  FLANK_ASSERT(roots.size() <= kMostRoots);
  best_ = {horizon, -1, 0.0, 0.0};
  settled_ = -1;
  if (tree_.nodes.empty()) return best_;
  if (near.piece >= 0) start_at(near);
  std::array<Open, kStackSize> stack;
  int size = 0;
  for (const int root : roots) {
    const Open open = root == 0 ? Open{0, -1e300} : promise_of(root);
    if (open.promised < best_.f - kSlackMm) stack[size++] = open;
  }
  // The lowest is opened first.
  std::sort(stack.begin(), stack.begin() + size, [](const Open& a, const Open& b) {
    return a.promised != b.promised ? a.promised > b.promised : a.node > b.node;
  });
  while (size > 0) {
    const Open top = stack[--size];
    if (top.promised >= best_.f - kSlackMm) continue;
    const PoseNode& node = tree_.nodes[static_cast<std::size_t>(top.node)];
    if (node.second < 0) {
      open_leaf(node);
      continue;
    }
    Open first = promise_of(top.node + 1), second = promise_of(node.second);
    if (second.promised < first.promised) std::swap(first, second);
    if (second.promised < best_.f - kSlackMm) stack[size++] = second;
    if (first.promised < best_.f - kSlackMm) stack[size++] = first;
  }
  return best_;
}

std::vector<int> SweptSearch::roots_below(double value, double reach) {
  best_ = {value, -1, 0.0, 0.0};
  std::vector<int> out;
  if (tree_.nodes.empty()) return out;
  std::array<int, kStackSize> stack{0};
  int size = 1;
  while (size > 0) {
    const int k = stack[--size];
    const PoseNode& node = tree_.nodes[static_cast<std::size_t>(k)];
    if (bound(node) >= best_.f) continue;
    if (node.second >= 0 && node.reach > reach) {
      stack[size++] = node.second;
      stack[size++] = k + 1;
      continue;
    }
    if (out.size() == kMostRoots) return {0};
    out.push_back(k);
  }
  return out;
}

}  // namespace flank::internal::verify
