#include "flank/io/mesh/read_mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "flank/geom/mesh_repair.h"
#include "flank/geom/mesh_topology.h"

namespace flank::internal {
namespace {

using Triangle = std::array<int, 3>;
using Edges = std::vector<EdgeUse>;

/// Sum of the area vectors of a component this small, relative to its area, means that hardly anything is open.
constexpr double kClosedShare = 0.05;
/// Neighbours whose normals are this opposite lie on each other.
constexpr double kFoldCosine = -0.9999;

const Vec3& corner(const TriangleMesh& mesh, const Triangle& t, int k) {
  return mesh.vertices[static_cast<std::size_t>(t[k])];
}

Vec3 area_vector(const TriangleMesh& mesh, const Triangle& t) {
  return 0.5 * (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0));
}

/// Sets of numbers that hang together.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      parent_[static_cast<std::size_t>(i)] = parent_[static_cast<std::size_t>(parent_[static_cast<std::size_t>(i)])];
      i = parent_[static_cast<std::size_t>(i)];
    }
    return i;
  }
  /// The smaller root stays, so that numbers do not depend on the order of joining.
  void join(int a, int b) {
    a = root(a), b = root(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

/// Components of triangles over edges of exactly two triangles, numbered from 0 in the order of the triangles.
std::vector<int> component_numbers(const TriangleMesh& mesh, const Edges& edges) {
  Groups groups(mesh.triangles.size());
  for_each_edge(edges, [&](std::span<const EdgeUse> uses) {
    if (uses.size() == 2) groups.join(uses[0].triangle, uses[1].triangle);
  });
  std::vector<int> number(mesh.triangles.size(), -1);
  int count = 0;
  for (std::size_t t = 0; t < number.size(); ++t) {
    const int root = groups.root(static_cast<int>(t));
    number[t] = root == static_cast<int>(t) ? count++ : number[static_cast<std::size_t>(root)];
  }
  return number;
}

struct Component {
  double area = 0.0, volume = 0.0;
  Vec3 vector = Vec3::Zero();
  Box3 box;
  bool at_non_manifold = false;
  [[nodiscard]] bool closed() const { return vector.norm() < kClosedShare * area; }
};

std::vector<Component> describe(const TriangleMesh& mesh, const std::vector<int>& number) {
  std::vector<Component> parts(
      number.empty() ? 0 : static_cast<std::size_t>(*std::max_element(number.begin(), number.end())) + 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 area = area_vector(mesh, mesh.triangles[t]);
    Component& part = parts[static_cast<std::size_t>(number[t])];
    part.area += area.norm();
    part.vector += area;
    for (int k = 0; k < 3; ++k) part.box.add(corner(mesh, mesh.triangles[t], k));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Component& part = parts[static_cast<std::size_t>(number[t])];
    part.volume +=
        area_vector(mesh, mesh.triangles[t]).dot(corner(mesh, mesh.triangles[t], 0) - part.box.center()) / 3.0;
  }
  return parts;
}

/// Removes small components that hang on non-manifold edges. Returns how many triangles went.
std::size_t remove_fins(TriangleMesh& mesh, const Edges& edges) {
  const std::vector<int> number = component_numbers(mesh, edges);
  std::vector<Component> parts = describe(mesh, number);
  double total = 0.0;
  for (const Component& part : parts) total += part.area;
  for_each_edge(edges, [&](std::span<const EdgeUse> uses) {
    if (uses.size() <= 2) return;
    for (const EdgeUse& use : uses)
      parts[static_cast<std::size_t>(number[static_cast<std::size_t>(use.triangle)])].at_non_manifold = true;
  });
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Component& part = parts[static_cast<std::size_t>(number[t])];
    if (!part.at_non_manifold || part.area > kFinAreaShare * total) mesh.triangles[kept++] = mesh.triangles[t];
  }
  const std::size_t removed = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  return removed;
}

bool strictly_inside(const Box3& a, const Box3& b) {
  return (b.low.array() < a.low.array()).all() && (a.high.array() < b.high.array()).all();
}

/// Turns components that are closed, or nearly, and have a negative volume; not those inside another one, which bound a
/// cavity.
void turn_outwards(TriangleMesh& mesh, const Edges& edges, std::vector<std::string>& repairs) {
  const std::vector<int> number = component_numbers(mesh, edges);
  const std::vector<Component> parts = describe(mesh, number);
  std::vector<char> turn(parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool cavity = std::any_of(parts.begin(), parts.end(),
                                    [&](const Component& p) { return strictly_inside(parts[i].box, p.box); });
    turn[i] = parts[i].closed() && parts[i].volume < 0.0 && !cavity;
  }
  std::size_t turned = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!turn[static_cast<std::size_t>(number[t])]) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    ++turned;
  }
  if (turned > 0) repairs.push_back(fmt::format("turned {} triangles of components that were inside out", turned));
  if (parts.size() > 1) repairs.push_back(fmt::format("the mesh has {} components", parts.size()));
}

/// Holes, rims and folds stay as they are; the user is told.
void tell_what_is_left(const TriangleMesh& mesh, const Edges& edges, std::vector<std::string>& repairs) {
  const std::vector<Vec3> normals = triangle_normals(mesh);
  Groups rims(mesh.vertices.size());
  long folds = 0, left = 0;
  for_each_edge(edges, [&](std::span<const EdgeUse> uses) {
    if (uses.size() == 1) rims.join(uses[0].low, uses[0].high);
    if (uses.size() > 2) ++left;
    if (uses.size() == 2)
      folds += normals[static_cast<std::size_t>(uses[0].triangle)].dot(
                   normals[static_cast<std::size_t>(uses[1].triangle)]) < kFoldCosine;
  });
  std::map<int, Box3> boxes;
  for_each_edge(edges, [&](std::span<const EdgeUse> uses) {
    for (const int v : {uses[0].low, uses[0].high})
      if (uses.size() == 1) boxes[rims.root(v)].add(mesh.vertices[static_cast<std::size_t>(v)]);
  });
  double largest = 0.0;
  for (const auto& [root, box] : boxes) largest = std::max(largest, box.diagonal());
  if (left > 0) repairs.push_back(fmt::format("left {} non-manifold edges as borders between faces", left));
  if (!boxes.empty())
    repairs.push_back(fmt::format("left {} holes or open rims (the largest {:.3g} mm across)", boxes.size(), largest));
  if (folds > 0) repairs.push_back(fmt::format("left {} edges at which the surface folds back onto itself", folds));
}

}  // namespace

ReadMesh repair_read_mesh(TriangleMesh mesh, bool soup) {
  ReadMesh result;
  RepairedMesh first = repair_mesh(std::move(mesh), kWeldShare);
  if (soup) first.repair.welded_vertices = 0;
  if (!first.repair.clean()) result.repairs.push_back(first.repair.account());
  result.mesh = std::move(first.mesh);
  Edges edges = mesh_edges(result.mesh);
  const std::size_t fins = remove_fins(result.mesh, edges);
  if (fins > 0) {
    result.repairs.push_back(fmt::format("removed {} triangles of fins attached to non-manifold edges", fins));
    // Without the fins more triangles are neighbours, so that more of them must agree.
    RepairedMesh second = repair_mesh(std::move(result.mesh));
    second.repair.isolated_vertices = 0;
    if (!second.repair.clean()) result.repairs.push_back(second.repair.account());
    result.mesh = std::move(second.mesh);
    edges = mesh_edges(result.mesh);
  }
  turn_outwards(result.mesh, edges, result.repairs);
  // Turned triangles have the same edges.
  tell_what_is_left(result.mesh, edges, result.repairs);
  return result;
}

}  // namespace flank::internal
