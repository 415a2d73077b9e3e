#include "flank/verify/proof/mesh_shape.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>

namespace flank::internal::verify {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kLeaf = 2;  ///< triangles of a cluster that is not halved again

enum Kind { kCluster, kTriangle, kEdge, kVertex };

class MeshShape final : public Shape {
 public:
  explicit MeshShape(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    halve(0, order_.size());
    own();
  }

  [[nodiscard]] std::vector<Cell> first() const override {
    if (order_.empty()) return {};
    Cell all;
    all.kind = kCluster;
    all.at = {0.0, static_cast<double>(order_.size()), 0.0, 0.0};
    return {all};
  }

  [[nodiscard]] Probe look(Cell& cell) const override {
    switch (cell.kind) {
      case kCluster:
        return look_at_cluster(cell);
      case kTriangle:
        return look_at_triangle(cell);
      case kEdge:
        return look_at_edge(cell);
      default:
        return {.on_face = true, .point = mesh_.vertices[static_cast<std::size_t>(cell.index)]};
    }
  }

  void split(const Cell& cell, std::vector<Cell>& parts) const override {
    Cell part = cell;
    if (cell.kind == kCluster) {
      const auto first = static_cast<std::size_t>(cell.at[0]), last = static_cast<std::size_t>(cell.at[1]);
      if (last - first <= kLeaf) {
        for (std::size_t k = first; k < last; ++k) add_triangle(order_[k], cell.bound, parts);
        return;
      }
      const std::size_t half = (first + last) / 2;
      const auto middle = static_cast<double>(half);
      part.at = {cell.at[0], middle, 0.0, 0.0};
      parts.push_back(part);
      part.at = {middle, cell.at[1], 0.0, 0.0};
      parts.push_back(part);
    } else if (cell.kind == kTriangle) {
      // Corner (u, v) and size of a similar part; the middle one of four is turned round.
      const double u = cell.at[0], v = cell.at[1], half = 0.5 * cell.at[2];
      for (const std::array<double, 3>& at : {std::array{u, v, half}, std::array{u + half, v, half},
                                              std::array{u, v + half, half}, std::array{u + half, v + half, -half}}) {
        part.at = {at[0], at[1], at[2], 0.0};
        parts.push_back(part);
      }
    } else if (cell.kind == kEdge) {
      const double middle = 0.5 * (cell.at[0] + cell.at[1]);
      part.at[1] = middle;
      parts.push_back(part);
      part.at[0] = middle, part.at[1] = cell.at[1];
      parts.push_back(part);
    }
  }

  [[nodiscard]] Cell cell_of(const std::array<double, 4>& sample) const override {
    Cell cell;
    cell.inside = true;
    cell.kind = kTriangle;
    cell.index = static_cast<int>(sample[0]);
    cell.at = {sample[1], sample[2], sample[3], 0.0};
    return cell;
  }

  [[nodiscard]] bool hull(const Cell& cell, std::vector<Vec3>& points) const override {
    const Vec3 a = corner(cell.index, 0), ab = corner(cell.index, 1) - a, ac = corner(cell.index, 2) - a;
    const Vec3 from = a + cell.at[0] * ab + cell.at[1] * ac;
    points = {from, from + cell.at[2] * ab, from + cell.at[2] * ac};
    return true;
  }

  [[nodiscard]] double area_bound(const Cell& cell) const override {
    const Vec3 a = corner(cell.index, 0);
    const double whole = 0.5 * (corner(cell.index, 1) - a).cross(corner(cell.index, 2) - a).norm();
    return whole * cell.at[2] * cell.at[2];
  }

 private:
  [[nodiscard]] Vec3 corner(int triangle, int k) const {
    const auto& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
    return mesh_.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k % 3)])];
  }

  /// Orders triangles so that each half of a range lies together.
  void halve(std::size_t first, std::size_t last) {
    if (last - first <= kLeaf) return;
    Box3 box;
    for (std::size_t k = first; k < last; ++k) box.add(corner(order_[k], 0));
    int axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const std::size_t middle = (first + last) / 2;
    const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(middle), at(last), [&](int a, int b) {
      const double x = corner(a, 0)[axis], y = corner(b, 0)[axis];
      return x < y || (x == y && a < b);
    });
    halve(first, middle);
    halve(middle, last);
  }

  /// Each edge and each vertex belongs to the first triangle that has it.
  void own() {
    owns_.assign(mesh_.triangles.size(), 0);
    std::vector<char> seen(mesh_.vertices.size(), 0);
    struct Edge {
      int a, b, triangle, side;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * mesh_.triangles.size());
    for (std::size_t k = 0; k < mesh_.triangles.size(); ++k) {
      for (int i = 0; i < 3; ++i) {
        const int a = mesh_.triangles[k][static_cast<std::size_t>(i)];
        const int b = mesh_.triangles[k][static_cast<std::size_t>((i + 1) % 3)];
        edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(k), i});
        if (seen[static_cast<std::size_t>(a)] != 0) continue;
        seen[static_cast<std::size_t>(a)] = 1;
        owns_[k] = static_cast<char>(owns_[k] | (8 << i));
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
      return std::tie(x.a, x.b, x.triangle, x.side) < std::tie(y.a, y.b, y.triangle, y.side);
    });
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (k == 0 || edges[k].a != edges[k - 1].a || edges[k].b != edges[k - 1].b)
        owns_[static_cast<std::size_t>(edges[k].triangle)] =
            static_cast<char>(owns_[static_cast<std::size_t>(edges[k].triangle)] | (1 << edges[k].side));
  }

  void add_triangle(int triangle, double bound, std::vector<Cell>& parts) const {
    Cell cell;
    cell.bound = bound;
    cell.inside = true;
    cell.kind = kTriangle;
    cell.index = triangle;
    cell.at = {0.0, 0.0, 1.0, 0.0};
    parts.push_back(cell);
    const char owned = owns_[static_cast<std::size_t>(triangle)];
    for (int i = 0; i < 3; ++i) {
      if ((owned & (1 << i)) != 0) {
        cell.kind = kEdge;
        cell.index = triangle;
        cell.at = {0.0, 1.0, static_cast<double>(i), 0.0};
        parts.push_back(cell);
      }
      if ((owned & (8 << i)) != 0) {
        cell.kind = kVertex;
        cell.index = mesh_.triangles[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(i)];
        cell.at = {};
        parts.push_back(cell);
      }
    }
  }

  [[nodiscard]] Probe look_at_cluster(const Cell& cell) const {
    Box3 box;
    const auto first = static_cast<std::size_t>(cell.at[0]), last = static_cast<std::size_t>(cell.at[1]);
    for (std::size_t k = first; k < last; ++k)
      for (int i = 0; i < 3; ++i) box.add(corner(order_[k], i));
    return {.point = box.center(), .reach = 0.5 * box.diagonal() * (1.0 + 1e-12), .bend = kInfinite};
  }

  [[nodiscard]] Probe look_at_triangle(const Cell& cell) const {
    const Vec3 a = corner(cell.index, 0), ab = corner(cell.index, 1) - a, ac = corner(cell.index, 2) - a;
    const double size = cell.at[2];
    Probe probe{.on_face = true};
    probe.point = a + (cell.at[0] + size / 3.0) * ab + (cell.at[1] + size / 3.0) * ac;
    const Vec3 to = (ab + ac) / 3.0;
    probe.reach = std::abs(size) * std::max({to.norm(), (to - ab).norm(), (to - ac).norm()});
    return probe;
  }

  [[nodiscard]] Probe look_at_edge(const Cell& cell) const {
    const int side = static_cast<int>(cell.at[2]);
    const Vec3 a = corner(cell.index, side), ab = corner(cell.index, side + 1) - a;
    return {.on_face = true,
            .point = a + 0.5 * (cell.at[0] + cell.at[1]) * ab,
            .reach = 0.5 * (cell.at[1] - cell.at[0]) * ab.norm()};
  }

  const TriangleMesh& mesh_;
  std::vector<int> order_;  ///< triangles, those of a cluster side by side
  std::vector<char> owns_;  ///< bits 0 to 2: edges, bits 3 to 5: vertices that belong to a triangle
};

}  // namespace

std::unique_ptr<Shape> make_shape(const TriangleMesh& mesh) { return std::make_unique<MeshShape>(mesh); }

}  // namespace flank::internal::verify
