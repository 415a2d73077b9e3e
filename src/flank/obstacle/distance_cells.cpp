#include "flank/obstacle/distance_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

/// Halvings of a lattice's cube at most; what is not good enough then (a break, an edge) is not interpolated.
constexpr int kLevels = 3;
constexpr std::int64_t kUnits = 1 << kLevels;  ///< of the finest cells along the side of a cube
/// Interpolation is of the third order: its error is about this share of h^3 / d^2 in a cell of side h at a distance d
/// from a point, an edge or a surface of that radius. Only spares cells that would be halved anyway.
constexpr double kThirdOrder = 0.05;
/// A cell that is off by more than this many times what is allowed by that estimate is halved without being measured.
constexpr double kHopeless = 4.0;
/// Where a cell is checked, in shares of its sides: off the middle, where errors of odd order cancel.
const Vec3 kChecked(0.3, 0.4, 0.2);
/// A bound that was rounded down must not lose the face that it is about.
constexpr double kRounding = 1.0 + 1e-9;

}  // namespace

/// Distances to one face at the eight corners; bit k of the index is the side in direction k. Where they are kept, not copies: beside
/// many faces there are a million cells.
struct DistanceCells::Corners {
  std::size_t face = 0;
  std::array<const FaceDistance*, 8> at{};
};

struct DistanceCells::Cube {
  Vec3 low;
  double side = 0.0;
  int level = 0;
  std::array<std::int64_t, 3> unit{};  ///< of the low corner, counted in finest cells

  [[nodiscard]] Vec3 at(const Vec3& share) const { return low + side * share; }
  [[nodiscard]] double half_diagonal() const { return 0.5 * std::sqrt(3.0) * side; }
  [[nodiscard]] Cube part(int index) const {
    Cube part{low, 0.5 * side, level + 1, unit};
    const std::int64_t units = kUnits >> part.level;
    for (int k = 0; k < 3; ++k)
      if ((index >> k & 1) != 0) {
        part.low[k] += part.side;
        part.unit[static_cast<std::size_t>(k)] += units;
      }
    return part;
  }
};

struct DistanceCells::Cell {
  enum class Kind { kInterpolates, kSplit, kExact };
  Kind kind = Kind::kSplit;
  double middle_mm = 0.0;  ///< distance at its middle
  std::vector<Near> faces;
  std::vector<Corners> corners;
  using Parts = std::array<std::atomic<Cell*>, 8>;
  std::unique_ptr<Parts> parts;  ///< of a cell that is split; grown by those who look for a place

  ~Cell() {
    if (!parts) return;
    for (std::atomic<Cell*>& part : *parts) delete part.load();
  }
};

namespace {

/// Trilinear in values and half of the way along gradients: exact for quadratic functions, because the errors of the two
/// interpolations by values and by tangents are opposite and equal there. The gradient is that of the interpolant.
FaceDistance interpolate(const std::array<const FaceDistance*, 8>& corners, const Vec3& share, double side) {
  FaceDistance sum;
  for (int c = 0; c < 8; ++c) {
    const FaceDistance& corner = *corners[static_cast<std::size_t>(c)];
    const Vec3 far((c & 1) != 0 ? 1.0 : 0.0, (c & 2) != 0 ? 1.0 : 0.0, (c & 4) != 0 ? 1.0 : 0.0);
    const Vec3 way = share - far, sign = 2.0 * far - Vec3::Ones();
    const Vec3 w = Vec3::Ones() - far + sign.cwiseProduct(share);
    const double weight = w.x() * w.y() * w.z(), value = corner.mm + 0.5 * side * corner.gradient.dot(way);
    sum.mm += weight * value;
    sum.gradient += 0.5 * weight * corner.gradient +
                    value / side * Vec3(sign.x() * w.y() * w.z(), w.x() * sign.y() * w.z(), w.x() * w.y() * sign.z());
  }
  return sum;
}

/// Publishes a cell; if another thread was first, that one's, which has the same values.
template <class Cell>
Cell* publish(std::atomic<Cell*>& place, std::unique_ptr<Cell> cell) {
  Cell* known = nullptr;
  if (place.compare_exchange_strong(known, cell.get(), std::memory_order_acq_rel)) return cell.release();
  return known;
}

}  // namespace

DistanceCells::DistanceCells(std::size_t nodes, const Vec3& low, double step_mm, double error_mm)
    : low_(low), step_mm_(step_mm), error_mm_(error_mm), roots_(nodes) {
  for (std::atomic<Cell*>& root : roots_) root.store(nullptr, std::memory_order_relaxed);
}

DistanceCells::~DistanceCells() {
  for (std::atomic<Cell*>& root : roots_) delete root.load();
}

const FaceDistance* DistanceCells::corner(const Cube& cube, int index, std::size_t face, const ExactDistances& exact) {
  // 16 bits each: a lattice has at most 50 nodes along a side, and a part of more faces is not read in a lifetime.
  std::uint64_t key = face;
  Vec3 place = low_;  // from whole numbers: all cells of a corner agree on it to the last digit
  for (int k = 0; k < 3; ++k) {
    const std::int64_t unit =
        cube.unit[static_cast<std::size_t>(k)] + ((index >> k & 1) != 0 ? kUnits >> cube.level : 0);
    key = key << 16U | static_cast<std::uint64_t>(unit);
    place[k] += step_mm_ * (static_cast<double>(unit) / kUnits - 0.5);
  }
  constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15ULL;  // of the golden ratio: neighbours go to different shards
  Shard& shard = shards_[(key * kMix >> 32U) % kShards];
  {
    const std::lock_guard lock(shard.mutex);
    if (const auto known = shard.corners.find(key); known != shard.corners.end()) return &known->second;
  }
  // Without a bound: with one, the last digit would depend on which of its cells asked first.
  const FaceDistance found = exact.of(face, place, std::numeric_limits<double>::infinity());
  const std::lock_guard lock(shard.mutex);
  return &shard.corners.emplace(key, found).first->second;  // stays where it is, whatever comes later
}

std::unique_ptr<DistanceCells::Cell> DistanceCells::make(const Cube& cube, std::vector<Near> faces, double distance_mm,
                                                         const ExactDistances& exact) {
  auto cell = std::make_unique<Cell>();
  cell->faces = std::move(faces);
  cell->middle_mm = distance_mm;
  const double radius = std::max(std::abs(distance_mm), cube.side);
  const double expected = kThirdOrder * std::pow(cube.side, 3) / (radius * radius);
  if (cube.level < kLevels && expected > kHopeless * error_mm_) {
    cell->parts = std::make_unique<Cell::Parts>();
    return cell;
  }

  const Vec3 middle = cube.at(Vec3::Constant(0.5));
  for (Near& near : cell->faces) near.mm = exact.of(near.face, middle, near.mm).mm;
  const auto less = [](const Near& a, const Near& b) { return a.mm < b.mm; };
  cell->middle_mm = std::min_element(cell->faces.begin(), cell->faces.end(), less)->mm;
  // Distances change by no more than the way: a face that is that much farther in the middle is nearest nowhere.
  const double far = cell->middle_mm + 2.0 * cube.half_diagonal() * kRounding;
  std::erase_if(cell->faces, [&](const Near& near) { return near.mm > far; });

  const Vec3 checked = cube.at(kChecked);
  std::vector<std::pair<double, std::size_t>> nearest;  // distances there, and places in the list
  for (const Near& near : cell->faces) {
    const double within = std::abs(near.mm) + cube.half_diagonal();
    nearest.emplace_back(exact.of(near.face, checked, within).mm, nearest.size());
  }
  std::sort(nearest.begin(), nearest.end());
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double known = nearest.empty() ? kNone : nearest.front().first;
  double interpolated = kNone;
  cell->corners.resize(nearest.size());
  for (const auto& [mm, k] : nearest) {
    Corners& corners = cell->corners[k];
    corners.face = cell->faces[k].face;
    for (int c = 0; c < 8; ++c) corners.at[static_cast<std::size_t>(c)] = corner(cube, c, corners.face, exact);
    interpolated = std::min(interpolated, interpolate(corners.at, kChecked, cube.side).mm);
    // What is too near already comes no farther by other faces, whose corners are most of the price.
    if (known - interpolated > error_mm_) break;
  }
  const bool good = std::abs(interpolated - known) <= error_mm_, last = cube.level == kLevels;
  cell->kind = good ? Cell::Kind::kInterpolates : last ? Cell::Kind::kExact : Cell::Kind::kSplit;
  // There are a million cells about a large part: each keeps what it will be asked for, and no room for more.
  if (!good) cell->corners = {};
  cell->corners.shrink_to_fit();
  if (cell->kind == Cell::Kind::kSplit)
    cell->parts = std::make_unique<Cell::Parts>();
  else
    cell->faces = {};
  cell->faces.shrink_to_fit();
  return cell;
}

std::unique_ptr<DistanceCells::Cell> DistanceCells::make_root(const Cube& cube, const Node& node,
                                                              const ExactDistances& exact) {
  // What can be nearest in the cube is that much farther from its middle at most.
  const double within = std::abs(node.distance_mm) + 2.0 * cube.half_diagonal();
  std::vector<Near> faces;
  for (const std::size_t face : exact.near(node.index)) faces.push_back({face, within});
  if (!faces.empty()) return make(cube, std::move(faces), node.distance_mm, exact);
  auto nothing = std::make_unique<Cell>();
  nothing->kind = Cell::Kind::kExact;
  return nothing;
}

std::unique_ptr<DistanceCells::Cell> DistanceCells::make_part(const Cube& cube, const Cell& whole,
                                                              const ExactDistances& exact) {
  std::vector<Near> faces = whole.faces;
  for (Near& near : faces) near.mm = std::abs(near.mm) + cube.half_diagonal();  // from one middle to the other
  return make(cube, std::move(faces), whole.middle_mm, exact);
}

CellDistance DistanceCells::at(const Vec3& p, const Node& node, const ExactDistances& exact) {
  CellDistance nearest;
  if (error_mm_ <= 0.0) return nearest;
  const std::array<int, 3>& at = node.coordinates;
  Cube cube{low_ + step_mm_ * (Vec3(at[0], at[1], at[2]) - Vec3::Constant(0.5)), step_mm_, 0, {}};
  for (std::size_t k = 0; k < 3; ++k) cube.unit[k] = at[k] * kUnits;
  std::atomic<Cell*>& root = roots_[static_cast<std::size_t>(node.index)];
  const Cell* cell = root.load(std::memory_order_acquire);
  if (cell == nullptr) cell = publish(root, make_root(cube, node, exact));
  while (cell->kind == Cell::Kind::kSplit) {
    int index = 0;
    for (int k = 0; k < 3; ++k)
      if (p[k] >= cube.low[k] + 0.5 * cube.side) index |= 1 << k;
    cube = cube.part(index);
    std::atomic<Cell*>& place = (*cell->parts)[static_cast<std::size_t>(index)];
    const Cell* part = place.load(std::memory_order_acquire);
    cell = part != nullptr ? part : publish(place, make_part(cube, *cell, exact));
  }
  const Vec3 share = (p - cube.low) / cube.side;
  for (const Corners& corners : cell->corners) {
    const FaceDistance here = interpolate(corners.at, share, cube.side);
    if (nearest.face >= 0 && here.mm >= nearest.distance.mm) continue;
    nearest = {here, static_cast<int>(corners.face)};
  }
  return nearest;
}

}  // namespace flank::internal
