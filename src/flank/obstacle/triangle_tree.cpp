#include "flank/obstacle/triangle_tree.h"

#include <algorithm>
#include <utility>

namespace flank::internal {
namespace {

constexpr int kLeafTriangles = 4;    ///< a node of this few is measured triangle by triangle
constexpr double kRounding = 1e-14;  ///< of the largest coordinate: several units in the last place

Vec3 middle(const TriangleTree::Triangle& t) { return (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0; }

}  // namespace

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  for (const Triangle& t : triangles_) slack_ = std::max(slack_, t.slack_mm);
  if (!triangles_.empty()) build(0, static_cast<int>(triangles_.size()));
}

int TriangleTree::build(int first, int end) {
  Box3 box, middles;
  for (int k = first; k < end; ++k) {
    const Triangle& t = triangles_[static_cast<std::size_t>(k)];
    for (const Vec3& x : t.corners) box.add(x);
    middles.add(middle(t));
  }
  const int index = static_cast<int>(nodes_.size());
  // Rounding of the centre must not let a corner out.
  const Vec3 slack = Vec3::Constant(kRounding * box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff());
  nodes_.push_back({box.center(), 0.5 * (box.high - box.low) + slack, -1, first, end});
  if (end - first <= kLeafTriangles) return index;
  // By the median along the longest side: half the triangles each, whatever their sizes. Stable, so the tree is the
  // same on every machine.
  int axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const int half = first + (end - first) / 2;
  const auto begin = triangles_.begin();
  std::stable_sort(begin + first, begin + end,
                   [axis](const Triangle& a, const Triangle& b) { return middle(a)[axis] < middle(b)[axis]; });
  build(first, half);
  const int second = build(half, end);
  nodes_[static_cast<std::size_t>(index)].second = second;
  return index;
}

}  // namespace flank::internal
