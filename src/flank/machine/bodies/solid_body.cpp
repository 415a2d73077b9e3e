#include "flank/machine/bodies/solid_body.h"

#include <algorithm>

namespace flank::internal {

SolidBody::SolidBody(std::string name, SolidKind kind, std::size_t link, std::vector<ConvexShape> shapes)
    : name_(std::move(name)), kind_(kind), link_(link), shapes_(std::move(shapes)) {
  if (!shapes_.empty()) build(0, shapes_.size());
}

std::size_t SolidBody::build(std::size_t first, std::size_t last) {
  const std::size_t here = nodes_.size();
  nodes_.emplace_back();
  Box3 box, middles;
  for (std::size_t k = first; k < last; ++k) {
    const Box3 bounds = shapes_[k].bounds();
    box.add(bounds);
    middles.add(shapes_[k].middle());
  }
  nodes_[here] = {box, first, last, 0};
  if (last - first == 1) return here;
  int axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const std::size_t half = first + (last - first) / 2;
  const auto at = [&](std::size_t k) { return shapes_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(first), at(half), at(last),
                   [axis](const ConvexShape& a, const ConvexShape& b) { return a.middle()[axis] < b.middle()[axis]; });
  build(first, half);
  const std::size_t right = build(half, last);
  nodes_[here].right = right;
  return here;
}

double SolidBody::gap_to(const ConvexShape& shape, const Eigen::Isometry3d& to_this, double enough) const {
  // Its ball against the boxes: only where that is not enough are shapes asked.
  const Vec3 middle = to_this * shape.middle();
  const auto below = [&](const Node& node) {
    const Vec3 off = (node.box.low - middle).cwiseMax(middle - node.box.high).cwiseMax(0.0);
    return off.norm() - shape.reach();
  };
  double least = enough;
  // A path down the hierarchy: one of two children waits at every level.
  std::array<std::size_t, 64> waiting{};
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    if (below(node) >= least) continue;
    if (node.last - node.first == 1) {
      least = std::min(least, internal::gap(shapes_[node.first], shape, to_this, least));
      continue;
    }
    const std::size_t left = static_cast<std::size_t>(&node - nodes_.data()) + 1;
    // The nearer one first, so that the other may not be needed.
    const bool left_first = below(nodes_[left]) <= below(nodes_[node.right]);
    waiting[count++] = left_first ? node.right : left;
    waiting[count++] = left_first ? left : node.right;
  }
  return least;
}

double SolidBody::gap(const SolidBody& other, const Eigen::Isometry3d& to_this, double enough) const {
  if (empty() || other.empty()) return enough;
  double least = enough;
  for (const ConvexShape& shape : other.shapes_) least = std::min(least, gap_to(shape, to_this, least));
  return least;
}

}  // namespace flank::internal
