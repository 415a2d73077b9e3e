#include "flank/io/mesh/read_mesh_regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/geom/mesh_topology.h"
#include "flank/io/mesh/read_mesh_edges.h"
#include "flank/io/mesh/read_mesh_wrapped.h"

namespace flank::internal {
namespace {

using Links = std::vector<std::array<int, 3>>;

constexpr std::size_t kGrain = 16384;  ///< triangles

/// Everything that the steps below read.
struct Facets {
  Links smooth;  ///< neighbours across edges that are not sharp
  Links all;     ///< neighbours across manifold edges
  std::vector<Facet> facets;
  std::vector<double> areas;
};

Facets describe(const TriangleMesh& mesh, double sharp_rad) {
  Facets f;
  {
    const std::vector<EdgeUse> edges = mesh_edges(mesh);
    f.smooth = linked_neighbors(mesh, edges, sharp_rad);
    f.all = linked_neighbors(mesh, edges, std::numbers::pi);
  }
  f.facets.resize(mesh.triangles.size());
  f.areas.resize(mesh.triangles.size());
  parallel_blocks(mesh.triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto corner = [&](int k) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])]; };
      const Vec3 a = corner(0), b = corner(1), c = corner(2);
      f.areas[t] = 0.5 * (b - a).cross(c - a).norm();
      f.facets[t].center = (a + b + c) / 3.0;
    }
  });
  // Area-weighted over a triangle and its smooth neighbours: noise of the vertices must not look like an edge.
  const std::vector<Vec3> raw = triangle_normals(mesh);
  parallel_blocks(raw.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      Vec3 sum = f.areas[t] * raw[t];
      for (const int n : f.smooth[t])
        if (n >= 0) sum += f.areas[static_cast<std::size_t>(n)] * raw[static_cast<std::size_t>(n)];
      f.facets[t].normal = sum.norm() > 0.0 ? sum.normalized() : raw[t];
    }
  });
  return f;
}

void flood(const Facets& f, std::size_t start, int label, const std::vector<char>& eligible, std::vector<int>& labels) {
  std::vector<std::size_t> stack{start};
  labels[start] = label;
  while (!stack.empty()) {
    const std::size_t t = stack.back();
    stack.pop_back();
    for (const int n : f.smooth[t]) {
      const auto other = static_cast<std::size_t>(n);
      if (n < 0 || labels[other] >= 0 || !eligible[other]) continue;
      labels[other] = label;
      stack.push_back(other);
    }
  }
}

/// Regions of what is no edge. One that is smaller than the neighbourhood by which edges were found is a gap in an
/// edge, and becomes part of it. Returns how many labels were used.
int flood_cores(const Facets& f, double least_area, std::vector<char>& edge, std::vector<int>& labels) {
  std::vector<char> core(edge.size());
  std::transform(edge.begin(), edge.end(), core.begin(), [](char e) { return !e; });
  int count = 0;
  for (std::size_t t = 0; t < labels.size(); ++t)
    if (core[t] && labels[t] < 0) flood(f, t, count++, core, labels);
  std::vector<double> areas(static_cast<std::size_t>(count), 0.0);
  for (std::size_t t = 0; t < labels.size(); ++t)
    if (labels[t] >= 0) areas[static_cast<std::size_t>(labels[t])] += f.areas[t];
  for (std::size_t t = 0; t < labels.size(); ++t) {
    if (labels[t] < 0 || areas[static_cast<std::size_t>(labels[t])] >= least_area) continue;
    labels[t] = -1;
    edge[t] = 1;
  }
  return count;
}

/// Lets regions take in the triangles along their borders that still face as the region did where the border zone
/// began. Breadth first, so that neighbours meet in the middle.
void grow(const Facets& f, double turn_rad, std::vector<int>& labels) {
  const double cosine = std::cos(turn_rad);
  // The triangle of the region's core, where the way to a triangle began.
  std::vector<int> reference(labels.size());
  std::iota(reference.begin(), reference.end(), 0);
  const auto normal = [&](int t) -> const Vec3& { return f.facets[static_cast<std::size_t>(t)].normal; };
  std::vector<std::size_t> queue;
  for (std::size_t t = 0; t < labels.size(); ++t)
    if (labels[t] >= 0) queue.push_back(t);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const int n : f.smooth[queue[i]]) {
      const auto other = static_cast<std::size_t>(n);
      if (n < 0 || labels[other] >= 0 || normal(n).dot(normal(reference[queue[i]])) < cosine) continue;
      labels[other] = labels[queue[i]];
      reference[other] = reference[queue[i]];
      queue.push_back(other);
    }
  }
}

double shared_length(const TriangleMesh& mesh, std::size_t triangle, int side) {
  const auto& t = mesh.triangles[triangle];
  return (mesh.vertices[static_cast<std::size_t>(t[(side + 1) % 3])] -
          mesh.vertices[static_cast<std::size_t>(t[(side + 2) % 3])])
      .norm();
}

/// One round: every region below the least area joins its closest neighbour. Returns whether any did.
bool absorb(const TriangleMesh& mesh, const Facets& f, double least_area, int count, std::vector<int>& labels) {
  std::vector<double> areas(static_cast<std::size_t>(count), 0.0);
  for (std::size_t t = 0; t < labels.size(); ++t) areas[static_cast<std::size_t>(labels[t])] += f.areas[t];
  std::map<std::pair<int, int>, double> borders;
  for (std::size_t t = 0; t < labels.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const int n = f.all[t][k]; n >= 0 && labels[static_cast<std::size_t>(n)] != labels[t])
        borders[{labels[t], labels[static_cast<std::size_t>(n)]}] += shared_length(mesh, t, k);
  std::vector<int> into(static_cast<std::size_t>(count), -1);
  std::vector<double> longest(static_cast<std::size_t>(count), 0.0);
  for (const auto& [pair, length] : borders) {
    const auto [small, large] = pair;
    const double area = areas[static_cast<std::size_t>(small)], other = areas[static_cast<std::size_t>(large)];
    const bool grows = other > area || (other == area && large < small);
    if (area >= least_area || !grows || length <= longest[static_cast<std::size_t>(small)]) continue;
    longest[static_cast<std::size_t>(small)] = length;
    into[static_cast<std::size_t>(small)] = large;
  }
  bool any = false;
  for (int& label : labels) {
    // Chains end at the region of largest area: each link leads to a larger one.
    while (into[static_cast<std::size_t>(label)] >= 0) label = into[static_cast<std::size_t>(label)], any = true;
  }
  return any;
}

/// Regions that wrap round thick edges fall apart into their sides and the edges between them. Returns how many labels
/// were used.
int unwrap(const TriangleMesh& mesh, const Facets& f, int count, std::vector<int>& labels) {
  constexpr double kLeastShare = 0.02;  // of the area: what is smaller is no skin that anybody means
  std::vector<std::vector<int>> regions(static_cast<std::size_t>(count));
  double total = 0.0;
  for (std::size_t t = 0; t < labels.size(); ++t) {
    regions[static_cast<std::size_t>(labels[t])].push_back(static_cast<int>(t));
    total += f.areas[t];
  }
  const std::vector<char> all(labels.size(), 1);
  for (const std::vector<int>& region : regions) {
    double area = 0.0;
    for (const int t : region) area += f.areas[static_cast<std::size_t>(t)];
    if (!(area >= kLeastShare * total)) continue;
    const std::vector<int> sides = wrapped_sides({mesh, f.facets, f.areas, f.smooth}, region);
    for (std::size_t i = 0; i < sides.size(); ++i)
      labels[static_cast<std::size_t>(region[i])] = sides[i] < 0 ? -1 : count + sides[i];
    if (!sides.empty()) count += *std::max_element(sides.begin(), sides.end()) + 1;
    for (const int t : region)
      if (labels[static_cast<std::size_t>(t)] < 0) flood(f, static_cast<std::size_t>(t), count++, all, labels);
  }
  return count;
}

std::vector<std::vector<int>> by_area(const Facets& f, const std::vector<int>& labels, int count) {
  std::vector<std::vector<int>> regions(static_cast<std::size_t>(count));
  std::vector<double> areas(regions.size(), 0.0);
  for (std::size_t t = 0; t < labels.size(); ++t) {
    regions[static_cast<std::size_t>(labels[t])].push_back(static_cast<int>(t));
    areas[static_cast<std::size_t>(labels[t])] += f.areas[t];
  }
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (!regions[i].empty()) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  std::vector<std::vector<int>> sorted;
  for (const std::size_t i : order) sorted.push_back(std::move(regions[i]));
  return sorted;
}

}  // namespace

std::vector<std::vector<int>> mesh_regions(const TriangleMesh& mesh, const RegionOptions& options) {
  const Facets f = describe(mesh, options.sharp_rad);
  const double radius = options.edge_width_share * mesh.box().diagonal();
  std::vector<char> edge = find_edges(f.facets, f.all, radius, options.sharp_rad);
  std::vector<int> labels(mesh.triangles.size(), -1);
  int count = flood_cores(f, std::numbers::pi * radius * radius, edge, labels);
  grow(f, 0.5 * options.sharp_rad, labels);
  for (std::size_t t = 0; t < labels.size(); ++t)
    if (labels[t] < 0) flood(f, t, count++, edge, labels);
  double total = 0.0;
  for (const double area : f.areas) total += area;
  while (absorb(mesh, f, options.least_area_share * total, count, labels)) {
  }
  count = unwrap(mesh, f, count, labels);
  while (absorb(mesh, f, options.least_area_share * total, count, labels)) {
  }
  return by_area(f, labels, count);
}

}  // namespace flank::internal
