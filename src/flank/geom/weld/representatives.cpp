#include "flank/geom/weld/representatives.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace flank::internal {
namespace {

/// A cube of the grid that vertices are sorted into, or, if only equal ones are welded, the bits of the coordinates.
using Cell = std::array<std::int64_t, 3>;

/// Edges of a cube in tolerances: wide, so that few vertices are near a neighbour; not so wide that many share it.
constexpr double kCellWidth = 8.0;
/// As far from the border of a cell a vertex can have its like beyond it, in cells: the tolerance, and more than rounding.
constexpr double kNear = 1.001 / kCellWidth;
constexpr std::size_t kAhead = 32;  ///< vertices whose slots are asked for before the first of them is looked up

std::uint32_t mixed(const Cell& c) {
  std::uint64_t h = 0;
  for (const std::int64_t x : c) {
    h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 32;
  }
  return static_cast<std::uint32_t>(h);
}

/// A table of the vertices that stay, by the cells that they lie in, with open addresses: a mesh of millions of triangles
/// has millions of them, and a list for each cell would take several times the memory.
class Table {
 public:
  Table() : slots_(1024) {}

  void prefetch(std::uint32_t hash) const { __builtin_prefetch(&slots_[at(hash)]); }

  void insert(std::uint32_t hash, int vertex) {
    if (2 * ++count_ > slots_.size()) grow();
    place({hash, vertex});
  }

  /// Visits the vertices of a cell (and few others), until a visit returns false.
  template <class Visit>
  void visit(std::uint32_t hash, Visit&& visit) const {
    for (std::size_t i = at(hash); slots_[i].vertex >= 0; i = (i + 1) & (slots_.size() - 1))
      if (slots_[i].hash == hash && !visit(slots_[i].vertex)) return;
  }

 private:
  struct Slot {
    std::uint32_t hash = 0;
    int vertex = -1;
  };

  [[nodiscard]] std::size_t at(std::uint32_t hash) const { return hash & (slots_.size() - 1); }
  void place(const Slot& slot) {
    std::size_t i = at(slot.hash);
    while (slots_[i].vertex >= 0) i = (i + 1) & (slots_.size() - 1);
    slots_[i] = slot;
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.vertex >= 0) place(slot);
  }

  std::vector<Slot> slots_;  ///< a power of two of them, at most half full
  std::size_t count_ = 0;
};

class Welder {
 public:
  Welder(const std::vector<Vec3>& vertices, double tolerance) : vertices_(vertices), tolerance_(tolerance) {
    // Counted from a corner of the box, so that a part far from the origin does not overflow the integers.
    Box3 box;
    for (const Vec3& v : vertices) box.add(v);
    low_ = box.low;
  }

  [[nodiscard]] std::vector<int> run() {
    std::vector<int> first(vertices_.size());
    std::array<std::uint32_t, kAhead> hashes{};
    for (std::size_t begin = 0; begin < first.size(); begin += kAhead) {
      const std::size_t end = std::min(first.size(), begin + kAhead);
      for (std::size_t v = begin; v < end; ++v) table_.prefetch(hashes[v - begin] = mixed(cell(vertices_[v])));
      for (std::size_t v = begin; v < end; ++v) {
        const int found = find(vertices_[v], hashes[v - begin]);
        first[v] = found >= 0 ? found : static_cast<int>(v);
        if (found < 0) table_.insert(hashes[v - begin], first[v]);
      }
    }
    return first;
  }

 private:
  [[nodiscard]] Vec3 place(const Vec3& p) const { return (p - low_) / (kCellWidth * tolerance_); }
  [[nodiscard]] Cell cell(const Vec3& p) const {
    Cell c{};
    const Vec3 at = tolerance_ > 0.0 ? place(p) : p;
    for (int k = 0; k < 3; ++k)
      c[static_cast<std::size_t>(k)] = tolerance_ > 0.0 ? static_cast<std::int64_t>(std::floor(at[k]))
                                                        : std::bit_cast<std::int64_t>(at[k] + 0.0);  // -0 is +0
    return c;
  }

  /// The first of those that stay within the tolerance, or -1.
  [[nodiscard]] int find(const Vec3& p, std::uint32_t hash) const {
    int found = -1;
    // One at this very place is the first: an earlier one would have taken it in, too.
    bool exact = false;
    table_.visit(hash, [&](int w) {
      exact = vertices_[static_cast<std::size_t>(w)] == p;
      if (exact || (near(p, w) && (found < 0 || w < found))) found = w;
      return !exact;
    });
    return exact || !(tolerance_ > 0.0) ? found : find_beside(p, found);
  }

  [[nodiscard]] bool near(const Vec3& p, int w) const {
    return tolerance_ > 0.0 && (vertices_[static_cast<std::size_t>(w)] - p).squaredNorm() <= tolerance_ * tolerance_;
  }

  /// The same with the cells beside that of the vertex, of which those count that come within the tolerance.
  [[nodiscard]] int find_beside(const Vec3& p, int found) const {
    const Vec3 at = place(p);
    const Cell c = cell(p);
    std::array<int, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double in = at[static_cast<int>(k)] - static_cast<double>(c[k]);
      low[k] = in <= kNear ? -1 : 0, high[k] = in >= 1.0 - kNear ? 1 : 0;
    }
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int k = low[2]; k <= high[2]; ++k) {
          if (i == 0 && j == 0 && k == 0) continue;
          table_.visit(mixed({c[0] + i, c[1] + j, c[2] + k}), [&](int w) {
            if (near(p, w) && (found < 0 || w < found)) found = w;
            return true;
          });
        }
    return found;
  }

  const std::vector<Vec3>& vertices_;
  double tolerance_;
  Vec3 low_ = Vec3::Zero();
  Table table_;
};

}  // namespace

std::vector<int> representatives(const std::vector<Vec3>& vertices, double tolerance) {
  return Welder(vertices, tolerance).run();
}

}  // namespace flank::internal
