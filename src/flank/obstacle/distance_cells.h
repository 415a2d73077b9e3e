/// Distances to faces by interpolation in cells that are halved until a place inside each agrees with the exact
/// distance: an adaptively sampled distance field (Frisken, Perry, Rockwood and Jones 2000), face by face, because the
/// distance to one face bends where the least of several breaks.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// Distance to one face, less its clearance, and its gradient, a unit vector.
struct FaceDistance {
  double mm = 0.0;
  Vec3 gradient = Vec3::Zero();
};

/// Who knows exact distances.
class ExactDistances {
 public:
  virtual ~ExactDistances() = default;
  /// Of one face at a place, which is no farther from it than `within_mm` (infinite: not known).
  [[nodiscard]] virtual FaceDistance of(std::size_t face, const Vec3& place, double within_mm) const = 0;
  /// The faces that can be nearest somewhere in the cube of the lattice around this node.
  [[nodiscard]] virtual std::span<const std::size_t> near(std::ptrdiff_t node) const = 0;
};

/// Distance to the nearest face, and which that is; -1: no cell is good enough here, the exact one must be asked for.
struct CellDistance {
  FaceDistance distance;
  int face = -1;
};

/// One tree of cells for each node of a cubic lattice, grown where it is asked for. Every function may be called from
/// many threads at once: a cell's values do not depend on who makes it, and the thread that loses discards its copy.
class DistanceCells {
 public:
  /// `low`: the place of the node (0, 0, 0). `error_mm`: how far the interpolated distance may be off at the place of a
  /// cell that is checked; zero or less: no cell is good enough.
  DistanceCells(std::size_t nodes, const Vec3& low, double step_mm, double error_mm);
  ~DistanceCells();

  /// A node of the lattice: its index, its coordinates in steps and its distance.
  struct Node {
    std::ptrdiff_t index = -1;
    std::array<int, 3> coordinates{};
    double distance_mm = 0.0;
  };
  /// At p, in the cube of half a step around the node.
  [[nodiscard]] CellDistance at(const Vec3& p, const Node& node, const ExactDistances& exact);

 private:
  struct Cell;
  struct Cube;
  struct Corners;
  /// A face, and how far the middle of a cell is from it at most.
  struct Near {
    std::size_t face = 0;
    double mm = 0.0;
  };
  [[nodiscard]] std::unique_ptr<Cell> make(const Cube& cube, std::vector<Near> faces, double distance_mm,
                                           const ExactDistances& exact);
  [[nodiscard]] std::unique_ptr<Cell> make_root(const Cube& cube, const Node& node, const ExactDistances& exact);
  [[nodiscard]] std::unique_ptr<Cell> make_part(const Cube& cube, const Cell& whole, const ExactDistances& exact);
  [[nodiscard]] const FaceDistance* corner(const Cube& cube, int index, std::size_t face, const ExactDistances& exact);

  /// Corners are shared by up to eight cells of a level, and by their children.
  struct Shard {
    std::mutex mutex;
    std::unordered_map<std::uint64_t, FaceDistance> corners;
  };
  static constexpr std::size_t kShards = 64;
  Vec3 low_;
  double step_mm_, error_mm_;
  std::vector<std::atomic<Cell*>> roots_;
  std::array<Shard, kShards> shards_;
};

}  // namespace flank::internal
