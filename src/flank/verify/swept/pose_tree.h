/// A hierarchy over the pieces of a path: one pose stands for all poses of a node, with a bound on how far they move
/// the axis.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/verify/swept/segment.h"

namespace flank::internal::verify {

/// The poses of a node: every one takes the axis point R(s) = tip + s axis, 0 <= s <= L, to R(s) + y (half_tip + s
/// half_turn) + e with some |y| <= 1 and |e| <= bend, and in all no farther than `reach`, nor than what goes
/// evenly from `low_reach` at the tip to `high_reach` at the upper end: passes of a tip are far nearer to each other there.
struct PoseNode {
  Vec3 tip, axis;
  Vec3 half_tip = Vec3::Zero(), half_turn = Vec3::Zero();
  double bend = 0.0, reach = 0.0, turn = 0.0;  ///< turn = |half_turn|
  double low_reach = 0.0, high_reach = 0.0;
  int second = -1;                     ///< index of the second child (the first one follows its parent); -1: a leaf
  int first_piece = 0, end_piece = 0;  ///< the node's pieces; none of a group of parts of several strips
};

/// Part [low, high] of a segment: short enough for its minimum to be found by descent.
struct Piece {
  int segment = 0;
  double low = 0.0, high = 1.0;
};

/// Immutable after construction. The pieces of a few strips are halved in their order, those of many by where they are: a group's
/// bounds have no linear motion. A strip of one pose is one segment without length; links between strips are in no
/// segment, since nothing is cut along them.
struct PoseTree {
  std::vector<Segment> segments;  ///< in the order of strips and poses
  std::vector<Piece> pieces;      ///< in the order of the segments
  double piece_reach = 0.0;       ///< largest reach of a leaf
  double reach_limit = 0.0;       ///< what it may be at most: pieces of a dense path are far shorter
  std::vector<PoseNode> nodes;    ///< in depth-first order; empty for an empty path

  /// The segment that a piece is a part of.
  [[nodiscard]] const Segment& segment_of(int piece) const {
    return segments[static_cast<std::size_t>(pieces[static_cast<std::size_t>(piece)].segment)];
  }

  /// Pieces move the axis by at most `reach_mm` from their middle. Throws InputError, naming strip and pose, for a pose
  /// that is not finite or an axis that is no unit vector or turns round within one step.
  PoseTree(const Path& path, double axis_length_mm, double reach_mm);
};

}  // namespace flank::internal::verify
