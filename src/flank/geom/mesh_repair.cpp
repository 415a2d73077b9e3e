#include "flank/geom/mesh_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "flank/error.h"

namespace flank::internal {
namespace {

using Triangle = std::array<int, 3>;

/// Twice the area over the longest side squared; below this a triangle counts as having no area.
constexpr double kFlatness = 1e-12;

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

/// A cube of the grid that vertices are sorted into, or, if only equal ones are welded, the bits of the coordinates.
using Cell = std::array<std::int64_t, 3>;

/// Mixes three numbers. Which cells share a bucket does not matter to the result: only equal keys are looked for.
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0;
    for (std::int64_t x : c) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL + (h >> 29);
    return static_cast<std::size_t>(h);
  }
};

/// Distinct vertices, sorted into cells.
class Places {
 public:
  Places(const std::vector<Vec3>& vertices, double tolerance, const Vec3& low)
      : vertices_(vertices), tolerance_(tolerance), low_(low), next_(vertices.size(), -1) {}

  /// The first vertex at the place of v: v itself if it is new.
  int first_at(std::size_t v) {
    Cell c;
    for (int k = 0; k < 3; ++k) c[k] = cell_of(v, k);
    int found = find(v, c);
    if (tolerance_ > 0.0 && found < 0) found = find_beside(v, c);
    if (found >= 0) return found;
    const int here = static_cast<int>(v);
    const auto [it, is_new] = cells_.try_emplace(c, Chain{here, here});
    if (!is_new) it->second.last = next_[static_cast<std::size_t>(it->second.last)] = here;
    return here;
  }

 private:
  /// The vertices of a cell, each with the next one in next_.
  struct Chain {
    int first = -1, last = -1;
  };

  /// Two vertices within the tolerance are in the same cell or in neighbouring ones.
  /// Counted from the box's corner, so that a part far from the origin does not overflow the integers.
  [[nodiscard]] double place(std::size_t v, int k) const { return (vertices_[v][k] - low_[k]) / (2.0 * tolerance_); }
  [[nodiscard]] std::int64_t cell_of(std::size_t v, int k) const {
    if (tolerance_ > 0.0) return static_cast<std::int64_t>(std::floor(place(v, k)));
    return std::bit_cast<std::int64_t>(vertices_[v][k] + 0.0);  // -0 and +0 are one place
  }

  [[nodiscard]] int find(std::size_t v, const Cell& c) const {
    const auto it = cells_.find(c);
    if (it == cells_.end()) return -1;
    for (int w = it->second.first; w >= 0; w = next_[static_cast<std::size_t>(w)])
      if ((vertices_[static_cast<std::size_t>(w)] - vertices_[v]).squaredNorm() <= tolerance_ * tolerance_) return w;
    return -1;
  }

  /// In those of the neighbours that come within the tolerance: a cell is two tolerances wide, so at most one on each axis.
  [[nodiscard]] int find_beside(std::size_t v, const Cell& c) const {
    constexpr double kNear = 0.5 + 1e-3;  ///< of a cell, and more than rounding
    std::array<std::array<bool, 3>, 3> near{};
    for (int k = 0; k < 3; ++k) {
      const double in = place(v, k) - static_cast<double>(c[k]);
      near[static_cast<std::size_t>(k)] = {in <= kNear, true, in >= 1.0 - kNear};
    }
    for (std::size_t at = 0; at < 27; ++at) {
      const std::size_t i = at % 3, j = at / 3 % 3, k = at / 9;
      if (!near[0][i] || !near[1][j] || !near[2][k]) continue;
      const auto step = [](std::size_t n) { return static_cast<std::int64_t>(n) - 1; };
      const int found = find(v, {c[0] + step(i), c[1] + step(j), c[2] + step(k)});
      if (found >= 0) return found;
    }
    return -1;
  }

  const std::vector<Vec3>& vertices_;
  double tolerance_;
  Vec3 low_;
  std::unordered_map<Cell, Chain, CellHash> cells_;
  std::vector<int> next_;
};

/// For each vertex the first one at its place.
std::vector<int> representatives(const std::vector<Vec3>& vertices, double tolerance, const Vec3& low) {
  Places places(vertices, tolerance, low);
  std::vector<int> first(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) first[v] = places.first_at(v);
  return first;
}

/// Triangles use the first vertex at each place from here on; the others stay until drop_unused(). Returns which vertices
/// are such others.
std::vector<char> weld(TriangleMesh& mesh, double weld_share, MeshRepair& repair) {
  const Box3 box = mesh.box();
  const std::vector<int> first = representatives(mesh.vertices, weld_share * box.diagonal(), box.low);
  std::vector<char> welded(first.size(), 0);
  for (std::size_t v = 0; v < first.size(); ++v) {
    welded[v] = first[v] != static_cast<int>(v) ? 1 : 0;
    repair.welded_vertices += welded[v];
  }
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v = first[static_cast<std::size_t>(v)];
  return welded;
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

/// A triangle across a side that exactly two share.
struct Link {
  int other;
  bool agree;  // the two run their common side in opposite directions
};

/// Neighbours of every triangle; sides of three or more triangles link nothing, since they say nothing of orientation.
std::vector<std::vector<Link>> links(const TriangleMesh& mesh) {
  struct Use {
    Side side;
    int triangle;
    bool ascending;
  };
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      uses.push_back({side_of(a, b), static_cast<int>(t), a < b});
    }
  std::sort(uses.begin(), uses.end(),
            [](const Use& x, const Use& y) { return x.side != y.side ? x.side < y.side : x.triangle < y.triangle; });
  std::vector<std::vector<Link>> result(mesh.triangles.size());
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].side == uses[i].side) ++j;
    if (j - i == 2) {
      const bool agree = uses[i].ascending != uses[i + 1].ascending;
      result[static_cast<std::size_t>(uses[i].triangle)].push_back({uses[i + 1].triangle, agree});
      result[static_cast<std::size_t>(uses[i + 1].triangle)].push_back({uses[i].triangle, agree});
    }
    i = j;
  }
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
      for (const Link& link : neighbors[t]) {
        const auto other = static_cast<std::size_t>(link.other);
        const int wanted = link.agree ? turn[t] : 1 - turn[t];
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

/// Removes vertices without triangles. Those that were welded away are counted already and are not "isolated".
void drop_unused(TriangleMesh& mesh, const std::vector<char>& welded, MeshRepair& repair) {
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const Triangle& t : mesh.triangles)
    for (int v : t) number[static_cast<std::size_t>(v)] = 0;
  int count = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) {
      repair.isolated_vertices += !welded[v];
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
  add(swapped_diagonals, "mended", "zero-area triangles by a swap of diagonals");
  add(flipped_triangles, "flipped", "triangles");
  return text.empty() ? "nothing" : text;
}

RepairedMesh repair_mesh(TriangleMesh mesh, double weld_share) {
  check(mesh);
  RepairedMesh result;
  const std::vector<char> welded = weld(mesh, weld_share, result.repair);
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
  drop_unused(mesh, welded, result.repair);
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace flank::internal
