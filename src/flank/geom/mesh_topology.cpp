#include "flank/geom/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr std::size_t kGrain = 16384;  ///< vertices or triangles

/// Zero where the area is zero.
Vec3 triangle_normal(const TriangleMesh& mesh, const std::array<int, 3>& t) {
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
  const Vec3 n =
      (mesh.vertices[static_cast<std::size_t>(t[1])] - a).cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a);
  const double length = n.norm();
  return length > 0.0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

/// Three or more triangles at an edge, or two that run it in the same direction, stay unlinked.
std::vector<std::array<int, 3>> link_pairs(const TriangleMesh& mesh, const std::vector<EdgeUse>& edges,
                                           double crease_rad) {
  const std::vector<Vec3> normals = triangle_normals(mesh);
  const double least_cosine = std::cos(crease_rad);
  std::vector<std::array<int, 3>> neighbors(mesh.triangles.size(), {-1, -1, -1});
  for_each_edge(edges, [&](std::span<const EdgeUse> uses) {
    // Two triangles that run their edge in opposite directions have their outside on the same side.
    if (uses.size() != 2 || uses[0].ascending == uses[1].ascending) return;
    const auto s = static_cast<std::size_t>(uses[0].triangle), t = static_cast<std::size_t>(uses[1].triangle);
    if (!(normals[s].dot(normals[t]) > least_cosine)) return;
    neighbors[s][static_cast<std::size_t>(uses[0].side)] = uses[1].triangle;
    neighbors[t][static_cast<std::size_t>(uses[1].side)] = uses[0].triangle;
  });
  return neighbors;
}

/// Triangles around each vertex, by counting: sizes, then their sums, then the entries.
void collect_fans(const TriangleMesh& mesh, MeshTopology& topology) {
  const std::size_t count = mesh.vertices.size();
  topology.fan_begin.assign(count + 1, 0);
  for (const auto& t : mesh.triangles)
    for (int v : t) ++topology.fan_begin[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < count; ++v) topology.fan_begin[v + 1] += topology.fan_begin[v];
  topology.fans.assign(3 * mesh.triangles.size(), 0);
  std::vector<int> next(topology.fan_begin.begin(), topology.fan_begin.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int v : mesh.triangles[t])
      topology.fans[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = static_cast<int>(t);
}

/// Which corner of the triangle the vertex is; it must be one of them.
int corner_of(const TriangleMesh& mesh, int triangle, int vertex) {
  const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  return t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
}

/// Moves the triangles of `around` that hang together with the first one, over linked sides that end at the vertex, to
/// the front; returns how many they are.
std::size_t gather_fan(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, std::span<int> around) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const int corner = corner_of(mesh, around[i], vertex);
    for (int k = 1; k < 3; ++k) {
      const int other = topology.neighbors[static_cast<std::size_t>(around[i])][(corner + k) % 3];
      // From `count` on lie those that are not reached yet; a swap takes one of them into the fan.
      for (std::size_t j = count; other >= 0 && j < around.size(); ++j)
        if (around[j] == other) std::swap(around[j], around[count++]);
    }
  }
  return count;
}

/// Gives every fan but the first its own copy of the vertex. Returns whether anything was doubled.
bool separate_vertices(TriangleMesh& mesh, const MeshTopology& topology) {
  const std::size_t count = mesh.vertices.size();
  std::vector<int> around;
  for (std::size_t v = 0; v < count; ++v) {
    const int vertex = static_cast<int>(v);
    const auto all = topology.around(vertex);
    around.assign(all.begin(), all.end());
    std::span<int> rest(around);
    // The first fan keeps the vertex: numbers of a sound mesh do not change.
    if (!rest.empty()) rest = rest.subspan(gather_fan(mesh, topology, vertex, rest));
    while (!rest.empty()) {
      const std::size_t fan = gather_fan(mesh, topology, vertex, rest);
      const int copy = static_cast<int>(mesh.vertices.size());
      // A copy first: push_back may move the vector that its argument is part of.
      mesh.vertices.push_back(Vec3(mesh.vertices[v]));
      for (int t : rest.first(fan)) {
        const int corner = corner_of(mesh, t, vertex);
        mesh.triangles[static_cast<std::size_t>(t)][corner] = copy;
      }
      rest = rest.subspan(fan);
    }
  }
  return mesh.vertices.size() != count;
}

}  // namespace

std::vector<EdgeUse> mesh_edges(const TriangleMesh& mesh) {
  // By the lower vertex: sizes, then their sums, then the entries; only the few of one vertex are sorted.
  std::vector<std::size_t> begin(mesh.vertices.size() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++begin[static_cast<std::size_t>(std::min(t[(k + 1) % 3], t[(k + 2) % 3])) + 1];
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) begin[v + 1] += begin[v];
  std::vector<EdgeUse> uses(3 * mesh.triangles.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][(k + 1) % 3], b = mesh.triangles[t][(k + 2) % 3], low = std::min(a, b);
      uses[next[static_cast<std::size_t>(low)]++] = {low, std::max(a, b), static_cast<int>(t),
                                                     static_cast<signed char>(k), a < b};
    }
  const auto before = [](const EdgeUse& x, const EdgeUse& y) {
    if (x.high != y.high) return x.high < y.high;
    return x.triangle != y.triangle ? x.triangle < y.triangle : x.side < y.side;
  };
  parallel_blocks(mesh.vertices.size(), kGrain, [&](std::size_t first, std::size_t end) {
    for (std::size_t v = first; v < end; ++v)
      std::sort(uses.begin() + static_cast<std::ptrdiff_t>(begin[v]),
                uses.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]), before);
  });
  return uses;
}

std::vector<std::array<int, 3>> linked_neighbors(const TriangleMesh& mesh, const std::vector<EdgeUse>& edges,
                                                 double crease_rad) {
  MeshTopology topology;
  topology.neighbors = link_pairs(mesh, edges, crease_rad);
  collect_fans(mesh, topology);
  TriangleMesh copy = mesh;
  // As in link_triangles.
  if (separate_vertices(copy, topology)) topology.neighbors = link_pairs(copy, mesh_edges(copy), crease_rad);
  return std::move(topology.neighbors);
}

MeshTopology fans_of(const TriangleMesh& mesh) {
  MeshTopology topology;
  collect_fans(mesh, topology);
  return topology;
}

MeshTopology link_triangles(TriangleMesh& mesh, double crease_rad) {
  MeshTopology topology;
  topology.neighbors = link_pairs(mesh, mesh_edges(mesh), crease_rad);
  collect_fans(mesh, topology);
  if (separate_vertices(mesh, topology)) {
    // Where a fin came off, the two sides left behind belong together.
    topology.neighbors = link_pairs(mesh, mesh_edges(mesh), crease_rad);
    collect_fans(mesh, topology);
  }
  // Creases count as borders too: what lies beyond them is another surface to everything that follows.
  topology.on_border.assign(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (topology.neighbors[t][k] >= 0) continue;
      topology.on_border[static_cast<std::size_t>(mesh.triangles[t][(k + 1) % 3])] = 1;
      topology.on_border[static_cast<std::size_t>(mesh.triangles[t][(k + 2) % 3])] = 1;
    }
  }
  return topology;
}

std::vector<int> components(const MeshTopology& topology) {
  std::vector<int> number(topology.neighbors.size(), -1);
  std::vector<int> stack;
  int count = 0;
  for (std::size_t start = 0; start < number.size(); ++start) {
    if (number[start] >= 0) continue;
    number[start] = count;
    // A stack of our own: recursion over a million triangles would run out of it.
    stack.assign(1, static_cast<int>(start));
    while (!stack.empty()) {
      const auto t = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      for (int other : topology.neighbors[t]) {
        if (other < 0 || number[static_cast<std::size_t>(other)] >= 0) continue;
        number[static_cast<std::size_t>(other)] = count;
        stack.push_back(other);
      }
    }
    ++count;
  }
  return number;
}

std::vector<std::vector<TriangleSide>> border_loops(const TriangleMesh& mesh, const MeshTopology& topology) {
  FLANK_ASSERT(topology.neighbors.size() == mesh.triangles.size());
  // After link_triangles a border vertex has one fan, so exactly one border side starts there.
  std::vector<TriangleSide> starting(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (topology.neighbors[t][k] < 0)
        starting[static_cast<std::size_t>(mesh.triangles[t][(k + 1) % 3])] = {static_cast<int>(t), k};
  std::vector<char> used(mesh.vertices.size(), 0);
  std::vector<std::vector<TriangleSide>> loops;
  for (std::size_t v = 0; v < starting.size(); ++v) {
    if (starting[v].triangle < 0 || used[v]) continue;
    std::vector<TriangleSide> loop;
    // Each border vertex is the start of one side, so following sides comes back to where it began.
    for (std::size_t at = v; !used[at];) {
      used[at] = 1;
      loop.push_back(starting[at]);
      const auto& triangle = mesh.triangles[static_cast<std::size_t>(starting[at].triangle)];
      at = static_cast<std::size_t>(triangle[(starting[at].side + 2) % 3]);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

double corner_angle(const TriangleMesh& mesh, int triangle, int corner) {
  FLANK_ASSERT(corner >= 0 && corner < 3);
  FLANK_ASSERT(triangle >= 0 && static_cast<std::size_t>(triangle) < mesh.triangles.size());
  const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  const auto point = [&](int k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k % 3])]; };
  const Vec3 a = point(corner + 1) - point(corner), b = point(corner + 2) - point(corner);
  // atan2, not acos: exact for angles near 0 and pi, and 0 for a side without length.
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double total_turning(const TriangleMesh& mesh, const MeshTopology& topology, std::span<const TriangleSide> loop) {
  double turning = 0.0;
  for (const TriangleSide& side : loop) {
    const int vertex = mesh.triangles[static_cast<std::size_t>(side.triangle)][(side.side + 1) % 3];
    // In the plane this is the exterior angle of the polygon.
    turning += std::numbers::pi;
    for (int t : topology.around(vertex)) turning -= corner_angle(mesh, t, corner_of(mesh, t, vertex));
  }
  return turning;
}

std::vector<Vec3> triangle_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.triangles.size());
  parallel_blocks(normals.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) normals[i] = triangle_normal(mesh, mesh.triangles[i]);
  });
  return normals;
}

Vec3 vertex_normal(const TriangleMesh& mesh, int vertex, std::span<const int> around) {
  const auto flat = [&](int t) { return triangle_normal(mesh, mesh.triangles[static_cast<std::size_t>(t)]); };
  Vec3 sum = Vec3::Zero();
  // By angle: a plane face that a mesher has cut into many thin triangles counts no more than one that it left whole.
  for (const int t : around) sum += corner_angle(mesh, t, corner_of(mesh, t, vertex)) * flat(t);
  // Weights are angles, so the sum is of the order of 1 unless the normals cancel.
  if (const double length = sum.norm(); length > 1e-9) return sum / length;
  // Where they cancel (a sheet folded onto itself) one of them has to do.
  const auto one = std::find_if(around.begin(), around.end(), [&](int t) { return !flat(t).isZero(); });
  return one == around.end() ? Vec3(Vec3::Zero()) : flat(*one);
}

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  const MeshTopology fans = fans_of(mesh);
  std::vector<Vec3> normals(mesh.vertices.size());
  parallel_blocks(normals.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      normals[v] = vertex_normal(mesh, static_cast<int>(v), fans.around(static_cast<int>(v)));
  });
  return normals;
}

}  // namespace flank::internal
