/// Walls in a row: faces that are joined along their lateral edges, round a pocket or a boss, or along an open side.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "flank/face.h"

namespace flank::internal {

/// A straight edge that two walls of a chain share; mm.
struct LateralEdge {
  Vec3 foot = Vec3::Zero(), head = Vec3::Zero();  ///< its ends; all edges of a chain run the same way from foot to head
  const BSplineCurve2* before = nullptr;          ///< the trim of the wall that ends here, not owned
  const BSplineCurve2* after = nullptr;           ///< of the wall that begins here
  [[nodiscard]] Vec3 direction() const { return (head - foot).normalized(); }
};

/// The faces in the order of the chain.
struct Chain {
  std::vector<std::size_t> order;  ///< indices into the faces that were asked
  /// edges[i] is between wall i and the next one; of a closed chain the last one leads back to the first wall.
  std::vector<LateralEdge> edges;
  bool closed = false;

  [[nodiscard]] std::size_t size() const { return order.size(); }
  /// Of wall i; null at an end of an open chain.
  [[nodiscard]] const LateralEdge* begin_of(std::size_t i) const;
  [[nodiscard]] const LateralEdge* end_of(std::size_t i) const;
  /// The same chain the other way round.
  [[nodiscard]] Chain reversed() const;
  /// The same chain with foot and head exchanged.
  [[nodiscard]] Chain upside_down() const;
};

/// The chain that all of these faces make; none where they do not hang together along straight edges, one or two each.
/// The edges' trims are those of the faces, which must outlive the chain.
[[nodiscard]] std::optional<Chain> find_chain(const std::vector<Face>& faces);

/// Points along a trimming curve of a face, mm, from its first to its last one.
[[nodiscard]] std::vector<Vec3> points_along(const Face& face, const BSplineCurve2& edge, int count);

}  // namespace flank::internal
