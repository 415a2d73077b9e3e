/// Solids that belong to a link of a machine, as unions of convex shapes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "flank/machine/bodies/convex_shape.h"

namespace flank::internal {

/// What a solid is: tool and work are judged against each other elsewhere.
enum class SolidKind : std::uint8_t { kMachine, kWork, kTool };

/// Shapes in a hierarchy of boxes. Immutable.
class SolidBody {
 public:
  /// `shapes` in the frame of the link; `link`: how many joints lie between the work and it.
  SolidBody(std::string name, SolidKind kind, std::size_t link, std::vector<ConvexShape> shapes);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] SolidKind kind() const { return kind_; }
  [[nodiscard]] std::size_t link() const { return link_; }
  [[nodiscard]] bool empty() const { return shapes_.empty(); }
  /// A ball that holds all shapes.
  [[nodiscard]] Vec3 middle() const { return nodes_.front().box.center(); }
  [[nodiscard]] double reach() const { return 0.5 * nodes_.front().box.diagonal(); }

  /// Distance of two solids as of two shapes (convex_shape.h): from below, `enough` where more does not matter.
  [[nodiscard]] double gap(const SolidBody& other, const Eigen::Isometry3d& to_this, double enough) const;

 private:
  /// The shapes [first, last) and, where they are more than one, their two halves.
  struct Node {
    Box3 box;
    std::size_t first = 0, last = 0, right = 0;  ///< the left half is the next node
  };
  std::size_t build(std::size_t first, std::size_t last);
  [[nodiscard]] double gap_to(const ConvexShape& shape, const Eigen::Isometry3d& to_this, double enough) const;

  std::string name_;
  SolidKind kind_;
  std::size_t link_;
  std::vector<ConvexShape> shapes_;
  std::vector<Node> nodes_;
};

}  // namespace flank::internal
