#include "flank/verify/swept/pose_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "flank/base/assert.h"
#include "flank/error.h"

namespace flank::internal::verify {
namespace {

constexpr double kUnitTolerance = 1e-3;  ///< |axis| may differ from 1 by this much (rounded files); it is normalised
constexpr int kMaxPieces = 4096;         ///< of one segment: bounds memory if a path jumps across the room
/// Cosine of the largest turn between two poses, 172 degrees: beyond it the straight join of the axis vectors passes
/// near zero, and what the controller would do is anybody's guess.
constexpr double kLeastCosine = -0.99;
/// A path of more strips is grouped by where its poses are: strips side by side are near to each other all along, and their order
/// says nothing of that.
constexpr int kFewStrips = 8;
/// Parts of a strip that are grouped reach so many times as far as a piece may: within them the order says most.
constexpr double kChunkReaches = 10.0;
/// Least |w|^2 that a bound divides by; kLeastCosine keeps it above 0.005.
constexpr double kLeastSquaredAxis = 1e-3;

std::string place(std::size_t strip, std::size_t pose) {
  return "path: pass " + std::to_string(strip + 1) + ", CL point " + std::to_string(pose + 1);
}

Pose checked(const Pose& pose, std::size_t strip, std::size_t index) {
  if (!pose.tip.allFinite() || !pose.axis.allFinite())
    throw InputError(place(strip, index) + " is not finite; expected six finite numbers");
  const double length = pose.axis.norm();
  if (std::abs(length - 1.0) > kUnitTolerance)
    throw InputError(place(strip, index) + " has an axis of length " + std::to_string(length) + "; it must be 1");
  return {pose.tip, pose.axis / length};
}

class Builder {
 public:
  Builder(PoseTree& tree, double length) : tree_(tree), length_(length) {}

  void add_segments(const Path& path) {
    for (std::size_t k = 0; k < path.strips.size(); ++k) {
      const auto& poses = path.strips[k].poses;
      const int strip = static_cast<int>(k);
      if (poses.size() == 1) {
        const Pose p = checked(poses[0], k, 0);
        tree_.segments.push_back({p.tip, Vec3::Zero(), p.axis, Vec3::Zero(), strip, 0});
      }
      for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
        const Pose p = checked(poses[i], k, i), q = checked(poses[i + 1], k, i + 1);
        if (p.axis.dot(q.axis) < kLeastCosine)
          throw InputError(place(k, i + 1) +
                           " turns the axis by more than 170 degrees in one step; insert poses between");
        tree_.segments.push_back({p.tip, q.tip - p.tip, p.axis, q.axis - p.axis, strip, static_cast<int>(i)});
      }
    }
  }

  void add_pieces(double reach) {
    for (std::size_t i = 0; i < tree_.segments.size(); ++i) {
      const Segment& g = tree_.segments[i];
      const double moved = std::max(g.da.norm(), (g.da + length_ * g.dw).norm()) + length_ * g.dw.squaredNorm();
      const int count = std::clamp(static_cast<int>(std::ceil(0.5 * moved / reach)), 1, kMaxPieces);
      for (int k = 0; k < count; ++k)
        tree_.pieces.push_back(
            {static_cast<int>(i), static_cast<double>(k) / count, static_cast<double>(k + 1) / count});
    }
  }

  /// All nodes.
  void add_nodes() {
    const int count = static_cast<int>(tree_.pieces.size());
    if (segment(count - 1).strip < kFewStrips) {
      add_node(0, count);
      return;
    }
    for (int first = 0, last = 0; first < count; first = last) {
      while (last < count && segment(last).strip == segment(first).strip) ++last;
      add_chunks(first, last);
    }
    add_group(chunks_.begin(), chunks_.end());
  }

 private:
  /// Pieces of a strip that follow each other, and where tip and upper end of their axes are.
  struct Chunk {
    int first = 0, last = 0;
    std::array<double, 6> place{};
  };
  using Chunks = std::vector<Chunk>::iterator;

  void add_chunks(int first, int last) {
    const PoseNode node = enclose(first, last);
    if (last - first > 1 && node.reach > kChunkReaches * tree_.reach_limit) {
      const int middle = (first + last) / 2;
      add_chunks(first, middle);
      add_chunks(middle, last);
      return;
    }
    const Vec3 high = node.tip + length_ * node.axis;
    chunks_.push_back({first, last, {node.tip.x(), node.tip.y(), node.tip.z(), high.x(), high.y(), high.z()}});
  }

  /// Node over chunks, halved where they lie farthest apart; returns its index.
  int add_group(Chunks begin, Chunks end) {
    if (end - begin == 1) return add_node(begin->first, begin->last);
    const int index = static_cast<int>(tree_.nodes.size());
    tree_.nodes.push_back(enclose(begin, end));
    const std::size_t k = widest(begin, end);
    const Chunks middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [k](const Chunk& a, const Chunk& b) {
      return a.place[k] != b.place[k] ? a.place[k] < b.place[k] : a.first < b.first;
    });
    add_group(begin, middle);
    const int second = add_group(middle, end);
    tree_.nodes[static_cast<std::size_t>(index)].second = second;
    return index;
  }

  [[nodiscard]] static std::size_t widest(Chunks begin, Chunks end) {
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [low, high] =
          std::minmax_element(begin, end, [k](const Chunk& a, const Chunk& b) { return a.place[k] < b.place[k]; });
      if (const double width = high->place[k] - low->place[k]; width > most) most = width, best = k;
    }
    return best;
  }

  /// Bounds for poses that do not follow each other: no motion of theirs is linear.
  [[nodiscard]] PoseNode enclose(Chunks begin, Chunks end) const {
    Box3 tips, highs;
    for (Chunks c = begin; c != end; ++c) {
      tips.add({c->place[0], c->place[1], c->place[2]});
      highs.add({c->place[3], c->place[4], c->place[5]});
    }
    PoseNode node;
    node.tip = tips.center();
    const Vec3 axis = highs.center() - node.tip;
    node.axis = axis.norm() > 1e-3 * length_ ? Vec3(axis.normalized()) : Vec3(Vec3::UnitZ());
    for (Chunks c = begin; c != end; ++c)
      for (int k = c->first; k < c->last; ++k) widen(node, k);
    return node;
  }

  /// Node over pieces [first, last); returns its index.
  int add_node(int first, int last) {
    const int index = static_cast<int>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    PoseNode node = enclose(first, last);
    node.first_piece = first;
    node.end_piece = last;
    if (last - first == 1) {
      tree_.piece_reach = std::max(tree_.piece_reach, node.reach);
    } else {
      const int split = split_at(first, last);
      add_node(first, split);
      node.second = add_node(split, last);
    }
    tree_.nodes[static_cast<std::size_t>(index)] = node;
    return index;
  }

  [[nodiscard]] const Piece& piece(int k) const { return tree_.pieces[static_cast<std::size_t>(k)]; }
  [[nodiscard]] const Segment& segment(int k) const {
    return tree_.segments[static_cast<std::size_t>(piece(k).segment)];
  }

  /// Bounds of PoseNode for the pieces: linear motion from the first pose to the last is taken off, what is left is
  /// `bend`.
  [[nodiscard]] PoseNode enclose(int first, int last) const {
    const Piece& middle = piece((first + last) / 2);
    const double tau = (last - first) % 2 == 1 ? 0.5 * (middle.low + middle.high) : middle.low;
    const Pose pose = segment((first + last) / 2).at(tau);
    const Pose begin = segment(first).at(piece(first).low), end = segment(last - 1).at(piece(last - 1).high);
    PoseNode node;
    node.tip = pose.tip;
    node.axis = pose.axis;
    node.half_tip = 0.5 * (end.tip - begin.tip);
    node.half_turn = 0.5 * (end.axis - begin.axis);
    node.turn = node.half_turn.norm();
    for (int k = first; k < last; ++k) widen(node, k);
    return node;
  }

  /// Makes the node's bounds hold for a piece.
  void widen(PoseNode& node, int k) const {
    const Pose p = segment(k).at(piece(k).low), q = segment(k).at(piece(k).high);
    const double slack = turning_slack(segment(k), p, q);
    for (const Pose& at : {p, q}) widen(node, at, slack);
  }

  /// Makes the node's bounds hold for a pose, and `slack` beyond it. Between two poses the deviation is linear but for
  /// the slack.
  void widen(PoseNode& node, const Pose& pose, double slack) const {
    const Vec3 low = pose.tip - node.tip, high = low + length_ * (pose.axis - node.axis);
    const Vec3 half_high = node.half_tip + length_ * node.half_turn;
    const double squares = node.half_tip.squaredNorm() + half_high.squaredNorm();
    const double y =
        squares > 0.0 ? std::clamp((low.dot(node.half_tip) + high.dot(half_high)) / squares, -1.0, 1.0) : 0.0;
    node.low_reach = std::max(node.low_reach, low.norm() + slack);
    node.high_reach = std::max(node.high_reach, high.norm() + slack);
    node.reach = std::max(node.low_reach, node.high_reach);
    node.bend = std::max(node.bend, std::max((low - y * node.half_tip).norm(), (high - y * half_high).norm()) + slack);
  }

  /// How far the axis leaves the chord of two poses: the sagitta of its arc, and the unequal speed along it of at most
  /// 1/|w|^2.
  [[nodiscard]] double turning_slack(const Segment& g, const Pose& p, const Pose& q) const {
    const double squared_turn = (q.axis - p.axis).squaredNorm();
    const double least = std::min(1.0, (g.w0 + 0.5 * g.dw).squaredNorm());
    return length_ * squared_turn / (4.0 * std::max(least, kLeastSquaredAxis));
  }

  /// At the change of strips nearest to the middle, else in the middle: a node over two strips has poses far apart.
  [[nodiscard]] int split_at(int first, int last) const {
    const int middle = (first + last) / 2;
    const auto strip = [&](int k) { return segment(k).strip; };
    if (strip(first) == strip(last - 1)) return middle;
    for (int away = 0; away < last - first; ++away) {
      for (int k : {middle - away, middle + away})
        if (k > first && k < last && strip(k - 1) != strip(k)) return k;
    }
    return middle;
  }

  PoseTree& tree_;
  double length_;
  std::vector<Chunk> chunks_;
};

}  // namespace

PoseTree::PoseTree(const Path& path, double axis_length_mm, double reach_mm) {
  FLANK_ASSERT(axis_length_mm > 0.0 && reach_mm > 0.0);
  reach_limit = reach_mm;
  Builder builder(*this, axis_length_mm);
  builder.add_segments(path);
  builder.add_pieces(reach_mm);
  if (pieces.empty()) return;
  nodes.reserve(2 * pieces.size());
  builder.add_nodes();
}

}  // namespace flank::internal::verify
