#include "flank/pipeline/free_line.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "flank/obstacle/line_of_sight.h"

namespace flank::internal {
namespace {

/// Does the half line pass through the box?
bool passes(const Box3& box, const Vec3& from, const Vec3& direction) {
  double enter = 0.0, leave = 1e300;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (from[k] < box.low[k] || from[k] > box.high[k]) return false;
      continue;
    }
    const double a = (box.low[k] - from[k]) / direction[k], b = (box.high[k] - from[k]) / direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

/// The faces of the part, each with a tree of its own that is made when a line comes near.
class Lines {
 public:
  explicit Lines(ObstacleSet obstacles) : obstacles_(std::move(obstacles)) {
    Box3 all;
    for (std::size_t k = 0; k < obstacles_.obstacles().size(); ++k) {
      const DistantObstacle& o = obstacles_.obstacles()[k];
      if (o.role == ObstacleRole::kFixture || o.box.empty()) continue;
      all.add(o.box);
      faces_.push_back(k);
    }
    least_ = 1e-6 * all.diagonal();
    once_ = std::vector<std::once_flag>(faces_.size());
    trees_.resize(faces_.size());
  }

  [[nodiscard]] bool empty() const { return faces_.empty(); }

  [[nodiscard]] bool free(const Vec3& from, const Vec3& direction) const {
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (passes(obstacles_.obstacles()[faces_[i]].box, from, direction) && meets(tree(i), from, direction, least_))
        return false;
    return true;
  }

 private:
  [[nodiscard]] const TriangleTree& tree(std::size_t i) const {
    std::call_once(once_[i], [&] { trees_[i].emplace(tree_of(obstacles_.made(faces_[i]).mesh)); });
    return *trees_[i];
  }

  ObstacleSet obstacles_;
  std::vector<std::size_t> faces_;
  double least_ = 0.0;
  mutable std::vector<std::once_flag> once_;
  mutable std::vector<std::optional<TriangleTree>> trees_;
};

}  // namespace

std::function<bool(const Vec3& from, const Vec3& direction)> free_line_in(const ObstacleSet& obstacles) {
  const auto lines = std::make_shared<const Lines>(obstacles);
  if (lines->empty()) return {};
  return [lines](const Vec3& from, const Vec3& direction) { return lines->free(from, direction); };
}

}  // namespace flank::internal
