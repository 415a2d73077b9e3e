/// One query of the swept distance: branch and bound over the pose tree.
#pragma once

#include <span>
#include <vector>

#include "flank/verify/swept/pose_tree.h"
#include "flank/verify/swept/segment_minimum.h"
#include "flank/verify/swept/tool_distance.h"

namespace flank::internal::verify {

/// A place on the path: piece of the tree, parameter of its segment, axis arc length; and f there, mm.
struct SweptPlace {
  double f = 0.0;
  int piece = -1;  ///< -1: nothing below the horizon
  double tau = 0.0, s = 0.0;
};

/// One object per query; it keeps references, so tool, tree and x must outlive it. What is proved of its bounds, and
/// what is only tested, is in docs/algorithms/judge.md.
class SweptSearch {
 public:
  SweptSearch(const ToolDistance& tool, const PoseTree& tree, const Vec3& x) : tool_(tool), tree_(tree), x_(x) {}

  /// The least f below `horizon`. `near` (piece -1: none) is where to look first: it changes the time, not the value.
  [[nodiscard]] SweptPlace run(double horizon, const SweptPlace& near);
  /// The same below these nodes of the tree alone, at most kMostRoots.
  [[nodiscard]] SweptPlace run(double horizon, const SweptPlace& near, std::span<const int> roots);
  static constexpr int kMostRoots = 128;
  /// Nodes that hold all poses with f below a value, and none that reaches farther than `reach` but for leaves: where searches
  /// about points near x, whose horizons are lower than that by their distance from x, begin. The root
  /// of all where more are needed than there may be.
  [[nodiscard]] std::vector<int> roots_below(double value, double reach);
  /// No f is lower, told without opening a node.
  [[nodiscard]] double least() const;
  /// What descent from `near` finds: a local minimum, never below the least f; piece -1 where it does not settle.
  [[nodiscard]] SweptPlace descend_from(const SweptPlace& near);

 private:
  /// A node that may have to be opened, and what it promises.
  struct Open {
    int node;
    double promised;
  };
  [[nodiscard]] Open promise_of(int node) const;
  [[nodiscard]] double bound(const PoseNode& node) const;        ///< <= f over all poses of the node
  [[nodiscard]] double close_bound(const PoseNode& node) const;  ///< the same for nodes no longer than a piece may be
  /// The least of 1 - rho q' (docs/algorithms/judge.md) over the spheres that can be nearer than the best value at any
  /// pose that moves them by at most `moves` from a pose that has the point at (z, rho), mm.
  [[nodiscard]] double room(double z, double rho, double moves) const;
  /// One minimum over s is certain: of those below the best value, at all such poses.
  [[nodiscard]] bool single(const PlanePoint& at, double moves) const;
  [[nodiscard]] const Piece& piece(int k) const { return tree_.pieces[static_cast<std::size_t>(k)]; }
  [[nodiscard]] const Segment& segment(const Piece& p) const {
    return tree_.segments[static_cast<std::size_t>(p.segment)];
  }
  /// Whether piece `next` continues piece k without a gap.
  [[nodiscard]] bool neighbours(int k, int next) const;
  /// A first value to prune with, by a descent from `near`.
  void start_at(const SweptPlace& near);
  /// Minimises F on a piece: from one start if one minimum over s is certain, else from every one.
  void open_leaf(const PoseNode& node);
  void open_single(const PoseNode& node, const NearestSphere& sphere);
  void open_forked(const PoseNode& node);
  /// Pieces that a first hop from here skips: one, unless many of them make up the length that a piece may have.
  [[nodiscard]] int stride_from(int at) const;
  /// Continues a minimum that was found at an end of a piece into the next piece.
  void follow(int at, SegmentMinimum found);
  void keep(const SegmentMinimum& found, int at) {
    if (found.f < best_.f) best_ = {found.f, at, found.tau, found.s};
  }

  /// Not owned.
  const ToolDistance& tool_;
  const PoseTree& tree_;
  const Vec3& x_;
  SweptPlace best_;
  int settled_ = -1;  ///< a piece whose least value is already in best_
};

}  // namespace flank::internal::verify
