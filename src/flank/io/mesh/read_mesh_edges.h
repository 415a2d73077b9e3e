/// Where a mesh turns so sharply that a face of it ends.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// What the search for edges has to know of a triangle.
struct Facet {
  Vec3 center, normal;  ///< normal: a unit vector, or zero
};

/// Most triangles that are looked at around one; a finer mesh is judged over a smaller neighbourhood.
inline constexpr std::size_t kMostNeighbors = 250;

/// 1 for triangles within whose neighbourhood of the given radius the normal turns by a sharp angle. The neighbourhood is what is
/// reached from a triangle over `neighbors` (-1: none), the nearest first, as far as centres lie within the radius, and until there are
/// kMostNeighbors. A finite set of directions within an angle is judged by the turn from the middle triangle, hence half the angle
/// on either side.
[[nodiscard]] std::vector<char> find_edges(std::span<const Facet> facets, std::span<const std::array<int, 3>> neighbors,
                                           double radius, double sharp_rad);

}  // namespace flank::internal
