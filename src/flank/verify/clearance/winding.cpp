#include "flank/verify/clearance/winding.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace flank::internal::verify {
namespace {

/// Of its radius: from here on a node counts as one area. The next term of the expansion about its centre falls with
/// the square of that ratio: a few hundredths in all, where a half decides (Winding::inside).
constexpr double kFar = 2.5;
constexpr int kStackSize =
    128;  ///< each level leaves one node behind, and a tree that halves is 31 levels deep at most

/// Signed solid angle of a triangle (Van Oosterom and Strackee, 1983).
double solid_angle(const std::array<Vec3, 3>& v, const Vec3& x) {
  const Vec3 a = v[0] - x, b = v[1] - x, c = v[2] - x;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

Winding::Winding(const TriangleMesh& mesh) : Winding(std::make_shared<const ObstacleTree>(mesh)) {}

Winding::Winding(std::shared_ptr<const ObstacleTree> tree) : tree_(std::move(tree)) {
  if (tree_->empty()) return;
  const auto count = static_cast<std::size_t>(tree_->node_count());
  areas_.resize(count);
  std::vector<double> weights(count, 0.0);
  // A node comes before both of its parts: from the last on, these are known.
  for (std::size_t i = count; i-- > 0;) {
    const ObstacleTree::Node& node = tree_->node(static_cast<int>(i));
    Area& area = areas_[i];
    const auto add = [&](const Vec3& vector, const Vec3& center, double weight) {
      area.vector += vector;
      area.center += weight * center;
      weights[i] += weight;
    };
    if (node.second < 0) {
      for (int k = node.first; k < node.end; ++k) {
        const std::array<Vec3, 3> v = tree_->corners(k);
        const Vec3 vector = 0.5 * (v[1] - v[0]).cross(v[2] - v[0]);
        add(vector, (v[0] + v[1] + v[2]) / 3.0, vector.norm());
      }
    } else {
      for (const std::size_t part : {i + 1, static_cast<std::size_t>(node.second)})
        add(areas_[part].vector, areas_[part].center, weights[part]);
    }
    area.center = weights[i] > 0.0 ? Vec3(area.center / weights[i]) : node.sphere.center;
    area.radius = (area.center - node.sphere.center).norm() + node.sphere.radius;
  }
}

double Winding::number(const Vec3& x) const {
  if (tree_->empty()) return 0.0;
  std::array<int, kStackSize> stack;
  int size = 0;
  stack[size++] = 0;
  double sum = 0.0;
  while (size > 0) {
    const int index = stack[--size];
    const ObstacleTree::Node& node = tree_->node(index);
    const Area& area = areas_[static_cast<std::size_t>(index)];
    const Vec3 d = area.center - x;
    const double distance = d.norm();
    if (distance > kFar * area.radius) {
      sum += area.vector.dot(d) / (distance * distance * distance);
    } else if (node.second < 0) {
      for (int k = node.first; k < node.end; ++k) sum += solid_angle(tree_->corners(k), x);
    } else {
      stack[size++] = node.second;
      stack[size++] = index + 1;
    }
  }
  return sum / (4.0 * std::numbers::pi);
}

bool Winding::inside(const Vec3& x) const { return std::abs(number(x)) > 0.5; }

}  // namespace flank::internal::verify
