#include "flank/io/mesh/read_mesh_wrapped.h"

#include <algorithm>
#include <cmath>

#include "flank/geom/pieces/face_section.h"

namespace flank::internal {
namespace {

constexpr double kFacing = 0.35;  ///< length of a region's mean normal below which it may wrap; half of a tube has 0.64
constexpr double kSideFacing = 0.5;        ///< and the least of a side, which does not
constexpr double kLook = 0.05;             ///< of the width: within it a normal on an edge turns by kLook kEdgeBend
constexpr std::size_t kMostAround = 2000;  ///< triangles are looked at around one
constexpr double kGrowTurn = 0.25;         ///< radians: a side takes in what still faces as its core does
constexpr double kLeastSide = 0.2;         ///< of the region's area
constexpr double kLeastEdge = 0.005;       ///< smaller ones are part of the side that they touch most
constexpr int kSide = 0, kEdge = -1, kOutside = -2;

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// How far a region reaches behind its triangles, by some of its middles.
class Widths {
 public:
  Widths(const FacetView& mesh, const std::vector<int>& region) {
    constexpr std::size_t kPoints = 2000;
    const std::size_t stride = std::max<std::size_t>(1, region.size() / kPoints);
    for (std::size_t i = 0; i < region.size(); i += stride)
      points_.push_back(mesh.facets[static_cast<std::size_t>(region[i])].center);
  }

  /// Within a cone: what winds round an axis, as a lobe of a rotor does, is not as wide as all that it winds round.
  [[nodiscard]] double behind(const Facet& facet) const {
    constexpr double kLeastCosine = 0.87;  // 30 degrees
    double farthest = 0.0;
    for (const Vec3& p : points_) {
      const Vec3 back = facet.center - p;
      const double depth = back.dot(facet.normal);
      if (depth > farthest && depth > kLeastCosine * back.norm()) farthest = depth;
    }
    return farthest;
  }

 private:
  std::vector<Vec3> points_;
};

/// A region and what has been found of it; numbers are those of the whole mesh.
class Unwrapping {
 public:
  Unwrapping(const FacetView& mesh, const std::vector<int>& region)
      : mesh_(mesh), region_(region), label_(mesh.facets.size(), kOutside), seen_(mesh.facets.size(), -1) {
    for (const int t : region_) label_[at(t)] = kEdge, area_ += mesh_.areas[at(t)];
  }

  [[nodiscard]] double facing(int label) const {
    Vec3 sum = Vec3::Zero();
    double area = 0.0;
    for (const int t : region_) {
      if (label_[at(t)] != label) continue;
      sum += mesh_.areas[at(t)] * normal(t);
      area += mesh_.areas[at(t)];
    }
    return area > 0.0 ? sum.norm() / area : 0.0;
  }

  /// Numbers the connected parts that do not bend like an edge and are large enough; returns how many there are.
  int find_sides() {
    const Widths widths(mesh_, region_);
    std::vector<char> edge(mesh_.facets.size(), 1);
    for (const int t : region_) edge[at(t)] = bends_sharply(t, widths.behind(mesh_.facets[at(t)])) ? 1 : 0;
    int sides = 0;
    std::vector<int> part;
    for (const int t : region_) {
      if (edge[at(t)] != 0 || label_[at(t)] != kEdge) continue;
      const double area = gather(t, edge, kSide + sides, part);
      if (area >= kLeastSide * area_) {
        ++sides;
        continue;
      }
      for (const int small : part) label_[at(small)] = kEdge, edge[at(small)] = 1;
    }
    return sides;
  }

  /// Breadth first, so that sides meet in the middle.
  void grow_sides() {
    std::vector<int> queue, from;
    for (const int t : region_)
      if (label_[at(t)] >= kSide) queue.push_back(t), from.push_back(t);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const int n : mesh_.smooth[at(queue[i])]) {
        if (n < 0 || label_[at(n)] != kEdge || angle(normal(n), normal(from[i])) > kGrowTurn) continue;
        label_[at(n)] = label_[at(queue[i])];
        queue.push_back(n), from.push_back(from[i]);
      }
    }
  }

  /// Crumbs between the sides, and those within one.
  void give_small_edges_away(int sides) {
    const std::vector<char> none(mesh_.facets.size(), 0);
    std::vector<int> part;
    // One number past those of the sides: what has been looked at.
    const int looked_at = kSide + sides;
    std::vector<std::vector<int>> kept;
    for (const int t : region_) {
      if (label_[at(t)] != kEdge) continue;
      const double area = gather(t, none, looked_at, part);
      const int side = most_touched(part, sides);
      if (area >= kLeastEdge * area_ || side < 0)
        kept.push_back(part);
      else
        for (const int small : part) label_[at(small)] = side;
    }
    for (const std::vector<int>& edge : kept)
      for (const int t : edge) label_[at(t)] = kEdge;
  }

  [[nodiscard]] std::vector<int> labels() const {
    std::vector<int> labels;
    for (const int t : region_) labels.push_back(label_[at(t)]);
    return labels;
  }

 private:
  static std::size_t at(int triangle) { return static_cast<std::size_t>(triangle); }
  [[nodiscard]] const Vec3& normal(int t) const { return mesh_.facets[at(t)].normal; }

  /// From the middle of a triangle to that of its neighbour k, square to the side that they share: of the slivers of
  /// which exporters make a bent edge, middles are far apart along the edge and near across it.
  [[nodiscard]] double way_across(int t, int k) const {
    const std::array<int, 3>& corners = mesh_.mesh.triangles[at(t)];
    const double side =
        (mesh_.mesh.vertices[at(corners[at((k + 1) % 3)])] - mesh_.mesh.vertices[at(corners[at((k + 2) % 3)])]).norm();
    const double areas = mesh_.areas[at(t)] + mesh_.areas[at(mesh_.smooth[at(t)][at(k)])];
    return side > 0.0 ? 2.0 * areas / (3.0 * side) : 0.0;
  }

  /// Does the normal turn, within kLook of the width or to a neighbour, as it does on an edge?
  bool bends_sharply(int triangle, double width) {
    reached_.assign(1, triangle);
    ways_.assign(1, 0.0);
    seen_[at(triangle)] = triangle;
    for (std::size_t i = 0; i < reached_.size() && reached_.size() < kMostAround; ++i) {
      for (int k = 0; k < 3; ++k) {
        const int n = mesh_.smooth[at(reached_[i])][at(k)];
        if (n < 0 || label_[at(n)] == kOutside || seen_[at(n)] == triangle) continue;
        seen_[at(n)] = triangle;
        const double way = ways_[i] + way_across(reached_[i], k);
        if (angle(normal(n), normal(triangle)) > kEdgeBend * std::max(way / width, kLook)) return true;
        if (way <= kLook * width) reached_.push_back(n), ways_.push_back(way);
      }
    }
    return false;
  }

  /// The part of the region around a triangle whose triangles are neither barred nor labelled; labels it. Its area.
  double gather(int triangle, const std::vector<char>& barred, int label, std::vector<int>& part) {
    part.assign(1, triangle);
    label_[at(triangle)] = label;
    double area = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      area += mesh_.areas[at(part[i])];
      for (const int n : mesh_.smooth[at(part[i])]) {
        if (n < 0 || label_[at(n)] != kEdge || barred[at(n)] != 0) continue;
        label_[at(n)] = label;
        part.push_back(n);
      }
    }
    return area;
  }

  [[nodiscard]] int most_touched(const std::vector<int>& part, int sides) const {
    std::vector<int> count(static_cast<std::size_t>(sides), 0);
    for (const int t : part)
      for (const int n : mesh_.smooth[at(t)])
        if (n >= 0 && label_[at(n)] >= kSide && label_[at(n)] < kSide + sides) ++count[at(label_[at(n)])];
    int most = 0;
    for (int side = 1; side < sides; ++side)
      if (count[at(side)] > count[at(most)]) most = side;
    return count[at(most)] > 0 ? most : -1;
  }

  const FacetView& mesh_;
  const std::vector<int>& region_;
  std::vector<int> label_, seen_, reached_;
  std::vector<double> ways_;  ///< to what was reached, mm
  double area_ = 0.0;
};

}  // namespace

std::vector<int> wrapped_sides(const FacetView& mesh, const std::vector<int>& region) {
  Unwrapping unwrapping(mesh, region);
  if (region.empty() || unwrapping.facing(kEdge) > kFacing) return {};
  const int sides = unwrapping.find_sides();
  if (sides < 2) return {};
  for (int side = 0; side < sides; ++side)
    if (unwrapping.facing(kSide + side) < kSideFacing) return {};
  unwrapping.grow_sides();
  unwrapping.give_small_edges_away(sides);
  return unwrapping.labels();
}

}  // namespace flank::internal
