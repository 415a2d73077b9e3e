#include "flank/geom/mesh_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "flank/error.h"
#include "flank/geom/mesh_topology.h"
#include "flank/geom/weld/representatives.h"

namespace flank::internal {
namespace {

using Triangle = std::array<int, 3>;

/// Twice the area over the longest side squared; below this a triangle counts as having no area.
constexpr double kFlatness = 1e-12;
/// Vertices are farther from the middle of the mesh than this many times the usual distance only if a few are far away: in a box
/// of equal triangles the farthest are at less than three.
constexpr double kFarthest = 30.0;

/// Throws InputError for what no repair can mend.
void check(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InputError("mesh has no triangles; expected at least one");
  const int count = static_cast<int>(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int v : mesh.triangles[t])
      if (v < 0 || v >= count)
        throw InputError("mesh triangle " + std::to_string(t) + " names vertex " + std::to_string(v) +
                         "; expected 0 to " + std::to_string(count - 1));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!mesh.vertices[v].allFinite())
      throw InputError("mesh vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
}

/// The middle one of the values, which come into another order.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The size of what the triangles are made of: the diagonal of its box, unless a few vertices far away make that; they must not
/// decide what is small for all the others.
double usual_size(const TriangleMesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) used[static_cast<std::size_t>(v)] = 1;
  Box3 box;
  Vec3 middle = Vec3::Zero();
  std::vector<double> values;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v] != 0) values.push_back(mesh.vertices[v][axis]);
    middle[axis] = median(values);
  }
  values.clear();
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) continue;
    box.add(mesh.vertices[v]);
    values.push_back((mesh.vertices[v] - middle).norm());
  }
  const double usual = median(values);
  // Half of the vertices at one place say nothing of a size.
  return usual > 0.0 ? std::min(box.diagonal(), kFarthest * usual) : box.diagonal();
}

/// One vertex at each place from here on. They keep their order, and those of no triangle stay until drop_unused().
void weld(TriangleMesh& mesh, double weld_share, MeshRepair& repair) {
  std::vector<int> number = representatives(mesh.vertices, weld_share > 0.0 ? weld_share * usual_size(mesh) : 0.0);
  std::size_t count = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    const auto first = static_cast<std::size_t>(number[v]);
    if (first == v) mesh.vertices[count] = mesh.vertices[v];
    number[v] = first == v ? static_cast<int>(count++) : number[first];  // an earlier one has its new number already
  }
  repair.welded_vertices += static_cast<int>(number.size() - count);
  mesh.vertices.resize(count);
  mesh.vertices.shrink_to_fit();  // of the vertices that an STL file repeats a sixth is left
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v = number[static_cast<std::size_t>(v)];
}

/// Removes triangles with two equal corners, and those with the corners of an earlier one, however they are turned.
void drop_repeats(TriangleMesh& mesh, MeshRepair& repair) {
  std::vector<std::pair<Triangle, std::size_t>> keys;
  keys.reserve(mesh.triangles.size());
  std::vector<char> keep(mesh.triangles.size(), 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle t = mesh.triangles[i];
    std::sort(t.begin(), t.end());
    if (t[0] == t[1] || t[1] == t[2]) {
      keep[i] = 0;
      ++repair.degenerate_triangles;
    } else {
      keys.emplace_back(t, i);
    }
  }
  // By corners, then by index: of equal triangles the first of the file stays.
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].first != keys[i - 1].first) continue;
    keep[keys[i].second] = 0;
    ++repair.duplicate_triangles;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (keep[i]) mesh.triangles[count++] = mesh.triangles[i];
  mesh.triangles.resize(count);
}

using Side = std::pair<int, int>;
/// The same for both directions.
Side side_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The corner opposite the longest side, and whether the triangle has no area to speak of.
std::pair<int, bool> flatness(const TriangleMesh& mesh, const Triangle& t) {
  const auto point = [&](int k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k % 3])]; };
  int corner = 0;
  double longest = -1.0;
  for (int k = 0; k < 3; ++k) {
    const double length = (point(k + 2) - point(k + 1)).squaredNorm();
    if (length > longest) {
      longest = length;
      corner = k;
    }
  }
  const double area = (point(1) - point(0)).cross(point(2) - point(0)).norm();
  return {corner, area <= kFlatness * longest};
}

/// Swaps the longest side of each flat triangle with the triangle behind it; removes flat triangles that have none.
bool mend_flat(TriangleMesh& mesh, MeshRepair& repair) {
  std::vector<std::size_t> flat;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (flatness(mesh, mesh.triangles[t]).second) flat.push_back(t);
  if (flat.empty()) return false;
  // Only sides of flat triangles are of interest.
  // Swapping the longest side removes a flat triangle without a hole: its corner lies on that side, where the mesh
  // would tear if the triangle were just dropped.
  std::map<Side, std::vector<std::size_t>> users;
  for (std::size_t t : flat) {
    const int c = flatness(mesh, mesh.triangles[t]).first;
    users[side_of(mesh.triangles[t][(c + 1) % 3], mesh.triangles[t][(c + 2) % 3])];
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto it = users.find(side_of(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]));
      if (it != users.end()) it->second.push_back(t);
    }
  std::vector<char> touched(mesh.triangles.size(), 0), dead(mesh.triangles.size(), 0);
  for (std::size_t t : flat) {
    // Two flat triangles in a row: the second one waits for the next round, when the first one has its new corners.
    if (touched[t]) continue;
    Triangle& a = mesh.triangles[t];
    const int c = flatness(mesh, a).first;
    const int from = a[(c + 1) % 3], to = a[(c + 2) % 3], tip = a[c];
    const auto& both = users[side_of(from, to)];
    // A side at the border, or one of three triangles: there is nothing to swap with.
    const std::size_t other = both.size() == 2 ? (both[0] == t ? both[1] : both[0]) : t;
    if (other == t) {
      dead[t] = 1;
      ++repair.degenerate_triangles;
      continue;
    }
    if (touched[other]) continue;  // its corners have changed in this round: the next one sees them
    Triangle& b = mesh.triangles[other];
    // The quadrilateral (from, tip, to, far corner of b) is cut along tip to far corner instead of from to to.
    const Triangle old = b;
    for (int k = 0; k < 3; ++k)
      if (b[k] == to) b[k] = tip;
    a = old;
    for (int k = 0; k < 3; ++k)
      if (a[k] == from) a[k] = tip;
    touched[t] = touched[other] = 1;
    ++repair.swapped_diagonals;
  }
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!dead[t]) mesh.triangles[count++] = mesh.triangles[t];
  mesh.triangles.resize(count);
  return true;
}

/// Up to three triangles across sides that exactly two share, each twice its number, and one more where the two run their
/// common side in opposite directions; -1 after the last.
using Links = std::array<int, 3>;

/// Neighbours of every triangle; sides of three or more triangles link nothing, since they say nothing of orientation.
std::vector<Links> links(const TriangleMesh& mesh) {
  std::vector<Links> result(mesh.triangles.size(), {-1, -1, -1});
  const auto add = [&](int triangle, int other, bool agree) {
    Links& own = result[static_cast<std::size_t>(triangle)];
    *std::find(own.begin(), own.end(), -1) = 2 * other + (agree ? 1 : 0);
  };
  for_each_edge(mesh_edges(mesh), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    const bool agree = uses[0].ascending != uses[1].ascending;
    add(uses[0].triangle, uses[1].triangle, agree);
    add(uses[1].triangle, uses[0].triangle, agree);
  });
  return result;
}

/// Twice the area, mm^2.
double doubled_area(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
  return (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
      .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
      .norm();
}

/// Turns triangles so that linked ones agree; in each component the orientation of the larger area stays.
void orient(TriangleMesh& mesh, MeshRepair& repair) {
  const auto neighbors = links(mesh);
  std::vector<int> turn(mesh.triangles.size(), -1);
  for (std::size_t start = 0; start < turn.size(); ++start) {
    if (turn[start] >= 0) continue;
    std::vector<std::size_t> members{start};
    turn[start] = 0;
    // Breadth first over linked sides: each triangle follows the turn of the one that it was reached from.
    // Of the members that keep their orientation, and of those that would be turned.
    std::array<double, 2> area{};
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::size_t t = members[i];
      area[turn[t]] += doubled_area(mesh, mesh.triangles[t]);
      for (const int link : neighbors[t]) {
        if (link < 0) break;
        const auto other = static_cast<std::size_t>(link / 2);
        const int wanted = link % 2 != 0 ? turn[t] : 1 - turn[t];
        if (turn[other] < 0) {
          turn[other] = wanted;
          members.push_back(other);
        } else if (turn[other] != wanted) {
          throw InputError("mesh is one-sided (a Moebius strip) at triangle " + std::to_string(other) +
                           "; expected an orientable surface");
        }
      }
    }
    // The smaller part was probably the mistake: a file with a few triangles the wrong way round keeps its outside.
    const int turned = area[1] > area[0] ? 0 : 1;
    for (std::size_t t : members) {
      if (turn[t] != turned) continue;
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      ++repair.flipped_triangles;
    }
  }
}

/// Removes vertices without triangles.
void drop_unused(TriangleMesh& mesh, MeshRepair& repair) {
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const Triangle& t : mesh.triangles)
    for (int v : t) number[static_cast<std::size_t>(v)] = 0;
  int count = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) {
      ++repair.isolated_vertices;
      continue;
    }
    number[v] = count;
    mesh.vertices[static_cast<std::size_t>(count++)] = mesh.vertices[v];
  }
  mesh.vertices.resize(static_cast<std::size_t>(count));
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v = number[static_cast<std::size_t>(v)];
}

}  // namespace

bool MeshRepair::clean() const {
  return welded_vertices + isolated_vertices + degenerate_triangles + duplicate_triangles + swapped_diagonals +
             flipped_triangles ==
         0;
}

std::string MeshRepair::account() const {
  std::string text;
  const auto add = [&](int count, const char* did, const char* what) {
    if (count == 0) return;
    text += std::string(text.empty() ? "" : ", ") + did + " " + std::to_string(count) + " " + what;
  };
  add(welded_vertices, "welded", "vertices");
  add(isolated_vertices, "removed", "isolated vertices");
  add(degenerate_triangles, "removed", "zero-area triangles");
  add(duplicate_triangles, "removed", "duplicate triangles");
  add(swapped_diagonals, "mended", "zero-area triangles (by swapping diagonals)");
  add(flipped_triangles, "flipped", "triangles");
  return text.empty() ? "nothing" : text;
}

RepairedMesh repair_mesh(TriangleMesh mesh, double weld_share) {
  check(mesh);
  RepairedMesh result;
  weld(mesh, weld_share, result.repair);
  drop_repeats(mesh, result.repair);
  // A swap can leave another flat triangle behind (several points on one line); a few rounds settle that, what is left
  // is removed.
  for (int round = 0; round < 8 && mend_flat(mesh, result.repair); ++round) drop_repeats(mesh, result.repair);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const bool flat = flatness(mesh, t).second;
    result.repair.degenerate_triangles += flat;
    return flat;
  });
  if (mesh.triangles.empty()) throw InputError("mesh has no triangle with an area; expected at least one");
  orient(mesh, result.repair);
  drop_unused(mesh, result.repair);
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace flank::internal
