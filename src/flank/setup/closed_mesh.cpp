#include "flank/setup/closed_mesh.h"

#include <span>

#include "flank/geom/mesh_topology.h"

namespace flank::internal {

bool bound_a_solid(const Part& part, const std::vector<int>& faces) {
  if (!part.is_mesh()) return false;
  const std::size_t count = part.mesh.triangles.size();
  // Over every edge: a crease ends a face, and not the solid.
  std::vector<std::vector<int>> next(count);
  std::vector<char> at_border(count, 0);
  for_each_edge(mesh_edges(part.mesh), [&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) {
      if (uses.size() != 2) at_border[static_cast<std::size_t>(use.triangle)] = 1;
      for (const EdgeUse& other : uses)
        if (other.triangle != use.triangle) next[static_cast<std::size_t>(use.triangle)].push_back(other.triangle);
    }
  });
  std::vector<char> seen(count, 0);
  std::vector<int> stack;
  const auto see = [&](int t) {
    if (seen[static_cast<std::size_t>(t)] != 0) return;
    seen[static_cast<std::size_t>(t)] = 1;
    stack.push_back(t);
  };
  for (const int face : faces)
    for (const int t : part.mesh_faces[static_cast<std::size_t>(face)]) see(t);
  while (!stack.empty()) {
    const auto t = static_cast<std::size_t>(stack.back());
    stack.pop_back();
    if (at_border[t] != 0) return false;
    for (const int n : next[t]) see(n);
  }
  return true;
}

}  // namespace flank::internal
