#include "flank/io/mesh/read_mesh_edges.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

/// Steps from one triangle to those that are found to be smooth with it at once.
constexpr int kCoreSteps = 8;
/// Most triangles that are looked at for that; around most there are about 1,400.
constexpr std::size_t kMostTogether = 4000;
constexpr std::size_t kGrain = 16384;  ///< triangles
/// Of lengths and cosines: far more than rounding, far less than matters.
constexpr double kSlack = 1e-9;

/// Triangles in the order in which they are reached from a first one. Which are known already stands in a small table, so that
/// many threads can walk over a large mesh.
class Walk {
 public:
  /// For walks on which at most `most` triangles are seen.
  explicit Walk(std::size_t most) : slots_(std::bit_ceil(2 * most)) { reached.reserve(most); }

  void start(int triangle) {
    ++walk_;
    reached.clear();
    (void)see(triangle);
    reached.push_back(triangle);
  }

  /// False if the triangle was seen before on this walk.
  [[nodiscard]] bool see(int triangle) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (static_cast<std::uint32_t>(triangle) * 0x9e3779b1u >> 8) & mask;
    for (; slots_[i].walk == walk_; i = (i + 1) & mask)
      if (slots_[i].triangle == triangle) return false;
    slots_[i] = {walk_, triangle};
    return true;
  }

  std::vector<int> reached;

 private:
  struct Slot {
    int walk = 0, triangle = 0;
  };
  std::vector<Slot> slots_;
  int walk_ = 0;
};

class EdgeSearch {
 public:
  EdgeSearch(std::span<const Facet> facets, std::span<const std::array<int, 3>> neighbors, double radius,
             double sharp_rad)
      : facets_(facets),
        neighbors_(neighbors),
        radius_(radius),
        cosine_(std::cos(sharp_rad)),
        half_cosine_(std::cos(0.5 * sharp_rad)),
        states_(facets.size(), kUnknown) {}

  /// For triangles [begin, end).
  void run(std::size_t begin, std::size_t end, std::vector<char>& edge) {
    // Three neighbours of each, and those that end a walk.
    Walk walk(3 * kMostNeighbors + 8), wide(kMostTogether);
    for (std::size_t i = begin; i < end; ++i) {
      const int triangle = static_cast<int>(i);
      if (state(triangle) == kUnknown) settle_core(triangle, wide);
      edge[i] = state(triangle) != kSmooth && turns_sharply(triangle, walk) ? 1 : 0;
    }
  }

 private:
  enum State : char { kUnknown, kSmooth, kTried };

  /// Threads tell each other what they have found. That spares work and changes no answer: a smooth triangle is no edge whoever
  /// finds out.
  [[nodiscard]] std::atomic_ref<char> state(int t) { return std::atomic_ref(states_[static_cast<std::size_t>(t)]); }
  [[nodiscard]] const Facet& facet(int t) const { return facets_[static_cast<std::size_t>(t)]; }
  [[nodiscard]] const std::array<int, 3>& around(int t) const { return neighbors_[static_cast<std::size_t>(t)]; }

  [[nodiscard]] bool turns_sharply(int triangle, Walk& walk) const {
    const Facet middle = facet(triangle);
    walk.start(triangle);
    for (std::size_t i = 0; i < walk.reached.size() && walk.reached.size() < kMostNeighbors; ++i) {
      for (const int n : around(walk.reached[i])) {
        if (n < 0 || !walk.see(n)) continue;
        if ((facet(n).center - middle.center).squaredNorm() > radius_ * radius_) continue;
        if (facet(n).normal.dot(middle.normal) < cosine_) return true;
        walk.reached.push_back(n);
      }
    }
    return false;
  }

  /// In a fine mesh the neighbourhoods of triangles side by side are nearly the same, so they are looked at together: those of
  /// the triangles at most kCoreSteps from this one. If there are kMostNeighbors within k steps of this one, they are within
  /// k + kCoreSteps of each of those, so that no walk from there gets farther (nearest first), as long as the radius
  /// cuts none short; and hence all walks stay within k + 2 kCoreSteps of this one. Where all normals there are within half
  /// the sharp angle of this one's, no two are a sharp angle apart.
  void settle_core(int triangle, Walk& walk) {
    std::size_t core = 1;
    const bool smooth = is_smooth_around(triangle, walk, core);
    for (std::size_t i = 0; i < core; ++i) {
      char before = kUnknown;
      if (smooth)
        state(walk.reached[i]).store(kSmooth, std::memory_order_relaxed);
      else  // unless it is known to be smooth
        (void)state(walk.reached[i]).compare_exchange_strong(before, kTried, std::memory_order_relaxed);
    }
  }

  /// Also counts the triangles of the core, at the beginning of the walk: some of them if the answer is no.
  [[nodiscard]] bool is_smooth_around(int triangle, Walk& walk, std::size_t& core) const {
    const Facet middle = facet(triangle);
    double core_radius = 0.0, farthest = 0.0;
    walk.start(triangle);
    int last = -1;  // step of the walk, once it is known
    std::size_t begin = 0;
    for (int step = 1; begin < walk.reached.size() && step != last + 1; ++step) {
      const std::size_t end = walk.reached.size();
      if (last < 0 && end >= kMostNeighbors) last = step - 1 + 2 * kCoreSteps;
      for (std::size_t i = begin; i < end; ++i)
        for (const int n : around(walk.reached[i])) {
          if (n < 0 || !walk.see(n)) continue;
          farthest = std::max(farthest, (facet(n).center - middle.center).squaredNorm());
          if (!(facet(n).normal.dot(middle.normal) > half_cosine_ + kSlack)) return false;
          if (walk.reached.size() == kMostTogether) return false;
          walk.reached.push_back(n);
        }
      if (step <= kCoreSteps) core = walk.reached.size(), core_radius = std::sqrt(farthest);
      if (!(std::sqrt(farthest) + core_radius < (1.0 - kSlack) * radius_)) return false;
      begin = end;
    }
    return true;
  }

  std::span<const Facet> facets_;
  std::span<const std::array<int, 3>> neighbors_;
  double radius_, cosine_, half_cosine_;
  std::vector<char> states_;
};

}  // namespace

std::vector<char> find_edges(std::span<const Facet> facets, std::span<const std::array<int, 3>> neighbors,
                             double radius, double sharp_rad) {
  EdgeSearch search(facets, neighbors, radius, sharp_rad);
  std::vector<char> edge(facets.size(), 0);
  parallel_blocks(facets.size(), kGrain, [&](std::size_t begin, std::size_t end) { search.run(begin, end, edge); });
  return edge;
}

}  // namespace flank::internal
