#include "flank/verify/stock/stock_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace flank::internal::verify {
namespace {

/// Points where lines of all three directions meet, one more than the stock has on every side: those are outside.
class Lattice {
 public:
  Lattice(const DexelStock& stock, int stride) : stock_(stock), stride_(stride) {
    for (int k = 0; k < 3; ++k) {
      // The lines along the axis k + 1 lie side by side along the axis k + 2, and those of k + 2 above one another.
      const DexelField& field = stock.field((k + 2) % 3);
      count_[k] = (field.width() + stride - 1) / stride + 2;
    }
    inside_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], 0);
    const DexelField& lines = stock.field(0);
    for (int j = 1; j + 1 < count_[1]; ++j)
      for (int k = 1; k + 1 < count_[2]; ++k)
        for (int i = 1; i + 1 < count_[0]; ++i)
          inside_[index(i, j, k)] = lines.holds(line(k), line(j), point(i, j, k).x()) ? 1 : 0;
  }
  [[nodiscard]] const std::array<int, 3>& count() const { return count_; }
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * count_[1] + j) * count_[0] + i;
  }
  [[nodiscard]] bool inside(const std::array<int, 3>& n) const { return inside_[index(n[0], n[1], n[2])] != 0; }
  [[nodiscard]] Vec3 point(int i, int j, int k) const {
    return stock_.box().low + stock_.cell() * (Vec3(line(i), line(j), line(k)) + Vec3::Constant(0.5));
  }
  /// Where the material ends between a point and the next one along the axis.
  [[nodiscard]] Vec3 crossing(const std::array<int, 3>& n, int axis) const {
    Vec3 x = point(n[0], n[1], n[2]);
    const double low = x[axis], high = low + stride_ * stock_.cell();
    const DexelField& field = stock_.field(axis);
    const int row = line(n[static_cast<std::size_t>(field.up())]),
              across = line(n[static_cast<std::size_t>(field.across())]);
    x[axis] = 0.5 * (low + high);
    if (row < 0 || row >= field.rows() || across < 0 || across >= field.width()) return x;
    const bool from_inside = inside(n);
    field.visit(row, across, [&](const DexelSpan& span) {
      const double end = from_inside ? span.high : span.low;
      if (end >= low && end <= high) x[axis] = end;
    });
    return x;
  }

 private:
  [[nodiscard]] int line(int n) const { return (n - 1) * stride_; }
  const DexelStock& stock_;
  int stride_;
  std::array<int, 3> count_{};
  std::vector<std::uint8_t> inside_;
};

class Mesher {
 public:
  explicit Mesher(const Lattice& lattice)
      : lattice_(lattice),
        vertex_(static_cast<std::size_t>(lattice.count()[0]) * lattice.count()[1] * lattice.count()[2], -1) {}

  TriangleMesh run() {
    const std::array<int, 3>& count = lattice_.count();
    for (int k = 0; k + 1 < count[2]; ++k)
      for (int j = 0; j + 1 < count[1]; ++j)
        for (int i = 0; i + 1 < count[0]; ++i)
          for (int axis = 0; axis < 3; ++axis) add_edge({i, j, k}, axis);
    return std::move(mesh_);
  }

 private:
  /// The four cells around an edge that the surface crosses are joined by two triangles.
  void add_edge(const std::array<int, 3>& n, int axis) {
    std::array<int, 3> next = n;
    ++next[static_cast<std::size_t>(axis)];
    const bool inside = lattice_.inside(n);
    if (inside == lattice_.inside(next)) return;
    const auto b = static_cast<std::size_t>((axis + 1) % 3), c = static_cast<std::size_t>((axis + 2) % 3);
    if (n[b] == 0 || n[c] == 0) return;
    std::array<int, 4> corner{};
    for (int k = 0; k < 4; ++k) {
      std::array<int, 3> cell = n;
      cell[b] -= k == 0 || k == 3 ? 1 : 0;
      cell[c] -= k < 2 ? 1 : 0;
      corner[static_cast<std::size_t>(k)] = vertex(cell);
    }
    if (!inside) std::swap(corner[1], corner[3]);
    mesh_.triangles.push_back({corner[0], corner[1], corner[2]});
    mesh_.triangles.push_back({corner[0], corner[2], corner[3]});
  }
  /// Of a cell: the mean of the crossings of its edges.
  int vertex(const std::array<int, 3>& cell) {
    int& known = vertex_[lattice_.index(cell[0], cell[1], cell[2])];
    if (known >= 0) return known;
    Vec3 sum = Vec3::Zero();
    int crossings = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 4; ++k) {
        std::array<int, 3> n = cell;
        n[static_cast<std::size_t>((axis + 1) % 3)] += k % 2;
        n[static_cast<std::size_t>((axis + 2) % 3)] += k / 2;
        std::array<int, 3> next = n;
        ++next[static_cast<std::size_t>(axis)];
        if (lattice_.inside(n) == lattice_.inside(next)) continue;
        sum += lattice_.crossing(n, axis);
        ++crossings;
      }
    }
    known = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.push_back(sum / crossings);
    return known;
  }

  const Lattice& lattice_;
  std::vector<int> vertex_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh stock_mesh(const DexelStock& stock, int stride) {
  const Lattice lattice(stock, std::max(1, stride));
  return Mesher(lattice).run();
}

int stride_for(const DexelStock& stock, double most_triangles) {
  // As many squares as the lines have ends, about.
  double ends = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const DexelField& field = stock.field(axis);
    for (int row = 0; row < field.rows(); ++row)
      for (int line = 0; line < field.width(); ++line) field.visit(row, line, [&](const DexelSpan&) { ends += 2.0; });
  }
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(2.0 * ends / most_triangles))));
}

}  // namespace flank::internal::verify
