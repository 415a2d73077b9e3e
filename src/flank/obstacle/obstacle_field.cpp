#include "flank/obstacle_field.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/obstacle/distance_cells.h"

namespace flank {
using namespace internal;

namespace {

/// Samples of the target that vote, about: shares of the area are then good to some hundredths.
constexpr int kVoters = 400;
/// Share of the votes that settles a side. A blade that is buried in its hub for a third still sees the hub from
/// outside; the rest above a half keeps faces that are seen from both sides without sign (docs/decisions/0010).
constexpr double kMajority = 0.55;
/// Share of the target that must look at a face before it can be called behind: what few see says nothing of the
/// others.
constexpr double kSeenByMost = 0.5;
/// Share of the target that must look at a face before it can be a wall: behind a wall there is material for as far as it
/// is large, and only a face that a good part of the target looks at (a hub, another blade) is as large as anybody asks.
constexpr double kSeenBySome = 0.1;
/// Of the votes: more that see its material side through the target, and the face has no sign, whatever the others see.
/// Where a tool touches the target it is free, so a face is no wall that would put it behind itself: the strip round a
/// blade's edge is seen from outside beside the edge, and from within everywhere else.
constexpr double kThroughTarget = 0.05;
/// A bound that was rounded down must not lose the face that it is about.
constexpr double kRounding = 1.0 + 1e-9;
/// mm: a point this near to a face has no direction away from it; the face's normal stands for it.
constexpr double kOnFaceMm = 1e-9;
/// Of the allowance: how far interpolated distances may be off: a fifth of what the allowance leaves of the tolerance
/// (base/tolerance_budget). A tenth of it would need ten times the cells.
constexpr double kInterpolationShare = 0.05;

struct Vote {
  int sign = 0;
  bool behind = false;  ///< all of the target sees its material side: it lies behind the target or behind a wall
};

/// Which way a face must be turned so that the target's machining side is outside of it; 0 if that is not clear.
Vote vote(const ObstacleFace& face, const std::vector<SurfaceSample>& samples, double offset_mm) {
  double outside = 0.0, through = 0.0, all = 0.0, area = 0.0;
  for (const SurfaceSample& sample : samples) {
    const Footpoint foot = face.surface->closest(sample.point + offset_mm * sample.normal);
    area += sample.area;
    // From its border a face shows no side.
    if (foot.location != Location::kInside) continue;
    // What is seen through the target tells nothing of a face without orientation: as likely its other side of a sheet.
    const bool below = (foot.point - sample.point).dot(sample.normal) < 0.0;
    if (!face.oriented && below) continue;
    all += sample.area;
    if (foot.distance > 0.0) outside += sample.area;
    if (foot.distance <= 0.0 && below) through += sample.area;
  }
  // Most of a face's few voters look past its edge from a corner of the target: a cap of a blade's end, signed by them,
  // would forbid the air beside the blade that lies below its plane.
  if (all < kSeenBySome * area) return {};
  if (outside >= kMajority * all) return {through > kThroughTarget * all ? 0 : +1, false};
  // What lies behind a wall is left out because the wall is asked for.
  if (face.oriented) return {0, !face.bared && outside == 0.0 && all >= kSeenByMost * area};
  return {outside <= (1.0 - kMajority) * all ? -1 : 0, false};
}

/// Samples of the target above which a tool may be: none above which there is material of a solid that the target runs into. A
/// blade that goes on down to the bore of its hub would see the hub from within with half of its voters.
std::vector<SurfaceSample> voters_of(const Target& target, const Obstacles& obstacles, double offset_mm) {
  std::vector<SurfaceSample> samples = target.samples(std::sqrt(target.area() / kVoters));
  std::erase_if(samples, [&](const SurfaceSample& sample) {
    const Vec3 above = sample.point + offset_mm * sample.normal;
    return std::any_of(obstacles.solids.begin(), obstacles.solids.end(),
                       [&](const auto& solid) { return solid->closest(above).distance < 0.0; });
  });
  return samples;
}

}  // namespace

/// A lattice around the target whose nodes are measured when they are first asked for. A distance also bounds those
/// nearby, less how far away they are: many questions need no more, the others ask fewer faces and look less far.
struct ObstacleField::Lattice {
  /// Along the longest side of the box. At most 120,000 nodes in a cube, found only where a fit asks.
  static constexpr int kPerSide = 48;
  using Faces = std::vector<std::size_t>;

  Lattice(const Box3& box, double margin) {
    const Vec3 size = (box.high - box.low).array() + 2.0 * margin;
    step = size.maxCoeff() / kPerSide;
    low = box.low.array() - margin;
    std::size_t all = 1;
    for (int k = 0; k < 3; ++k) {
      count[static_cast<std::size_t>(k)] = static_cast<int>(std::ceil(size[k] / step)) + 1;
      all *= static_cast<std::size_t>(count[static_cast<std::size_t>(k)]);
    }
    distances = std::vector<std::atomic<double>>(all);
    for (std::atomic<double>& distance : distances) distance.store(kUnknown, std::memory_order_relaxed);
    faces = std::vector<std::atomic<const Faces*>>(all);
  }
  ~Lattice() {
    for (std::atomic<const Faces*>& list : faces) delete list.load();
  }

  /// Index of the node nearest to p, and its place; -1 off the lattice.
  std::ptrdiff_t index(const Vec3& p, Vec3& at) const {
    std::ptrdiff_t sum = 0;
    for (int k = 2; k >= 0; --k) {
      const double x = std::round((p[k] - low[k]) / step);
      const int n = count[static_cast<std::size_t>(k)];
      if (!(x >= 0.0 && x < n)) return -1;
      sum = sum * n + static_cast<std::ptrdiff_t>(x);
      at[k] = low[k] + x * step;
    }
    return sum;
  }
  [[nodiscard]] Vec3 place(const std::array<int, 3>& corner) const {
    return low + step * Vec3(corner[0], corner[1], corner[2]);
  }
  [[nodiscard]] std::array<int, 3> coordinates(std::ptrdiff_t index) const {
    const std::ptrdiff_t x = index % count[0], rest = index / count[0];
    return {static_cast<int>(x), static_cast<int>(rest % count[1]), static_cast<int>(rest / count[1])};
  }
  [[nodiscard]] std::ptrdiff_t index(const std::array<int, 3>& corner) const {
    return (static_cast<std::ptrdiff_t>(corner[2]) * count[1] + corner[1]) * count[0] + corner[0];
  }
  /// The distance at a node, by `find` if it is not known yet. Two threads may both find it: the value is the same, so
  /// the order of the stores does not matter, and nothing else is published with it (relaxed).
  template <class Find>
  double distance(std::ptrdiff_t index, Find&& find) {
    std::atomic<double>& place = distances[static_cast<std::size_t>(index)];
    double known = place.load(std::memory_order_relaxed);
    if (known != kUnknown) return known;
    known = find();
    place.store(known, std::memory_order_relaxed);
    return known;
  }
  /// The faces that can be nearest within half a cell of a node, likewise. A list is published by its pointer
  /// (acquire-release); the thread that loses discards its copy.
  template <class Find>
  const Faces& near(std::ptrdiff_t index, Find&& find) {
    std::atomic<const Faces*>& place = faces[static_cast<std::size_t>(index)];
    const Faces* known = place.load(std::memory_order_acquire);
    if (known != nullptr) return *known;
    auto found = std::make_unique<const Faces>(find());
    if (place.compare_exchange_strong(known, found.get(), std::memory_order_acq_rel)) return *found.release();
    return *known;
  }

  static constexpr double kUnknown = -1e300;  ///< no distance is that far behind a wall
  Vec3 low;
  double step = 1.0;
  std::array<int, 3> count{};
  std::vector<std::atomic<double>> distances;
  std::vector<std::atomic<const Faces*>> faces;
  std::unique_ptr<DistanceCells> cells;  ///< of the inner lattice
};

struct ObstacleField::Exact final : ExactDistances {
  explicit Exact(const ObstacleField& of) : field(of) {}
  [[nodiscard]] FaceDistance of(std::size_t face, const Vec3& place, double within_mm) const override {
    const Target& surface = *field.faces_[face].surface;
    Footpoint foot = surface.closest_within(place, (within_mm + field.faces_[face].clearance_mm) * kRounding);
    // A wall's distance is not Lipschitz where its sign ends.
    if (foot.patch < 0) foot = surface.closest(place);
    const ObstacleDistance distance = field.to_face(face, place, foot);
    return {distance.distance_mm, distance.gradient};
  }
  [[nodiscard]] std::span<const std::size_t> near(std::ptrdiff_t node) const override {
    Lattice& lattice = *field.lattice_;
    const Vec3 place = lattice.place(lattice.coordinates(node));
    const auto find = [&] { return field.faces_near(place, field.node_distance(lattice, node, place)); };
    return lattice.near(node, find);
  }
  const ObstacleField& field;
};

ObstacleField::ObstacleField(const Obstacles& obstacles, const Target& target, double offset_mm, double allowance_mm)
    : faces_(obstacles.faces),
      allowance_mm_(allowance_mm),
      signs_(faces_.size(), 0),
      lattice_(std::make_unique<Lattice>(target.box(), 2.0 * offset_mm)),
      around_(std::make_unique<Lattice>(target.box(), 2.0 * offset_mm + lattice_->step * Lattice::kPerSide)) {
  lattice_->cells = std::make_unique<DistanceCells>(lattice_->distances.size(), lattice_->low, lattice_->step,
                                                    kInterpolationShare * allowance_mm);
  const std::vector<SurfaceSample> samples = voters_of(target, obstacles, offset_mm);
  std::vector<Vote> votes(faces_.size());
  parallel_for(faces_.size(), [&](std::size_t k) { votes[k] = vote(faces_[k], samples, offset_mm); });
  for (std::size_t k = 0; k < votes.size(); ++k) signs_[k] = votes[k].sign;
  // Walls first: they have to be looked for at any depth, and what they leave is a shorter horizon for the others.
  for (const bool walls : {true, false})
    for (std::size_t k = 0; k < votes.size(); ++k)
      if (!votes[k].behind && (votes[k].sign != 0) == walls) order_.push_back(k);
}

bool ObstacleField::reachable(const SurfaceSample& sample, double radius_mm, double depth_mm) const {
  FLANK_ASSERT(radius_mm > 0.0 && depth_mm >= 0.0);
  return at(sample.point + radius_mm * sample.normal, radius_mm).distance_mm >= radius_mm - depth_mm;
}

ObstacleField::~ObstacleField() = default;
ObstacleField::ObstacleField(ObstacleField&&) noexcept = default;

double ObstacleField::node_distance(Lattice& lattice, std::ptrdiff_t index, const Vec3& place) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return lattice.distance(index, [&] { return search(order_, place, kFar, kFar).distance_mm; });
}

std::vector<std::size_t> ObstacleField::faces_near(const Vec3& place, double distance_mm) const {
  // A point of the cell is within sqrt(3)/2 steps of the node. So its nearest face is at most that much farther from
  // the node than `distance_mm` plus that much again.
  std::vector<std::size_t> near;
  const double far = distance_mm + std::sqrt(3.0) * lattice_->step * kRounding;
  for (const std::size_t k : order_) {
    // A wall counts at any depth, so it is looked for at least as far as the node is deep.
    const double clearance = faces_[k].clearance_mm;
    const double sight = (signs_[k] != 0 ? std::max(std::abs(distance_mm), std::abs(far)) : far) + clearance;
    if (!(sight > 0.0)) continue;
    const Footpoint foot = faces_[k].surface->closest_within(place, sight * kRounding);
    if (foot.patch >= 0 && signed_distance(k, place, foot) - clearance <= far) near.push_back(k);
  }
  return near;
}

ObstacleDistance ObstacleField::estimate(const Vec3& p) const {
  ObstacleDistance sum;
  if (estimate_in(*lattice_, p, sum) || estimate_in(*around_, p, sum)) return sum;
  return at(p, std::numeric_limits<double>::infinity());
}

ObstacleField::Rough ObstacleField::rough(const Vec3& p) const {
  const double off = 0.5 * std::sqrt(3.0);  // between the corners of a cube no interpolation is farther off
  ObstacleDistance about;
  for (Lattice* lattice : {lattice_.get(), around_.get()})
    if (estimate_in(*lattice, p, about)) return {about.distance_mm, off * lattice->step};
  return {at(p, std::numeric_limits<double>::infinity()).distance_mm, 0.0};
}

double ObstacleField::beside(const Vec3& p, double level_mm) const {
  const auto [about, off] = rough(p);
  if (std::abs(about - level_mm) >= off) return about;
  return interpolated(p, level_mm + 2.0 * off).distance_mm;
}

bool ObstacleField::estimate_in(Lattice& lattice, const Vec3& p, ObstacleDistance& sum) const {
  std::array<int, 3> corner{};
  std::array<double, 3> share{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = (p[static_cast<Eigen::Index>(k)] - lattice.low[static_cast<Eigen::Index>(k)]) / lattice.step;
    if (!(x >= 0.0 && x < lattice.count[k] - 1)) return false;
    corner[k] = static_cast<int>(x);
    share[k] = x - corner[k];
  }
  // Trilinear, and its own gradient: not of unit length where the distance bends, but right for what is minimised.
  sum = {};
  sum.face = 0;
  for (int c = 0; c < 8; ++c) {
    const std::array<int, 3> at{corner[0] + (c & 1), corner[1] + (c >> 1 & 1), corner[2] + (c >> 2)};
    const double distance = node_distance(lattice, lattice.index(at), lattice.place(at));
    const double x = (c & 1) != 0 ? share[0] : 1.0 - share[0], y = (c & 2) != 0 ? share[1] : 1.0 - share[1],
                 z = (c & 4) != 0 ? share[2] : 1.0 - share[2];
    sum.distance_mm += x * y * z * distance;
    sum.gradient += distance / lattice.step *
                    Vec3((c & 1) != 0 ? y * z : -y * z, (c & 2) != 0 ? x * z : -x * z, (c & 4) != 0 ? x * y : -x * y);
  }
  return true;
}

double ObstacleField::signed_distance(std::size_t face, const Vec3& p, const Footpoint& foot) const {
  const double distance = signs_[face] * foot.distance;
  // No face says what is farther behind it than it is large: a sliver of 2 mm would have a rotor's whole inside for material.
  const bool wall =
      foot.location == Location::kInside && signs_[face] != 0 && distance >= -faces_[face].surface->box().diagonal();
  return wall ? distance : (p - foot.point).norm();
}

ObstacleDistance ObstacleField::at(const Vec3& p, double horizon_mm) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec3 place;
  const std::ptrdiff_t index = lattice_->index(p, place);
  // Not by the outer nodes: they stand too far apart to tell where a wall's sign ends between them.
  if (index < 0) return search(order_, p, horizon_mm, kFar);
  const double known = node_distance(*lattice_, index, place), off = (p - place).norm();
  ObstacleDistance free;
  free.distance_mm = horizon_mm;
  if (known - off >= horizon_mm) return free;
  const std::vector<std::size_t>& near = lattice_->near(index, [&] { return faces_near(place, known); });
  return search(near, p, horizon_mm, (std::abs(known) + off) * kRounding);
}

ObstacleDistance ObstacleField::interpolated(const Vec3& p, double horizon_mm) const {
  Vec3 place;
  const std::ptrdiff_t index = lattice_->index(p, place);
  if (index < 0) return at(p, horizon_mm);
  const double known = node_distance(*lattice_, index, place);
  ObstacleDistance found;
  found.distance_mm = horizon_mm;
  if (known - (p - place).norm() >= horizon_mm) return found;
  const CellDistance here = lattice_->cells->at(p, {index, lattice_->coordinates(index), known}, Exact(*this));
  if (here.face < 0) return at(p, horizon_mm);
  if (here.distance.mm < horizon_mm) found = {here.distance.mm, here.distance.gradient, here.face};
  return found;
}

ObstacleDistance ObstacleField::to_face(std::size_t face, const Vec3& p, const Footpoint& foot) const {
  const double distance = signed_distance(face, p, foot);
  const Vec3 away = p - foot.point;
  const double length = away.norm();
  ObstacleDistance result;
  result.distance_mm = distance - faces_[face].clearance_mm;
  result.face = static_cast<int>(face);
  if (length > kOnFaceMm)
    result.gradient = (distance < 0.0 ? -1.0 : 1.0) / length * away;
  else
    result.gradient = (signs_[face] < 0 ? -1.0 : 1.0) * foot.normal;
  return result;
}

ObstacleDistance ObstacleField::search(const std::vector<std::size_t>& faces, const Vec3& p, double horizon_mm,
                                       double sight_mm) const {
  ObstacleDistance nearest;
  nearest.distance_mm = horizon_mm;
  for (const std::size_t k : faces) {
    const Target& face = *faces_[k].surface;
    // The deepest wall is the nearest, so a wall is looked for beyond what was found; other faces only nearer than it.
    const double clearance = faces_[k].clearance_mm;
    const double sight = (signs_[k] != 0 ? sight_mm : std::min(sight_mm, nearest.distance_mm)) + clearance;
    if (sight <= 0.0 || face.box().squared_distance(p) >= sight * sight) continue;
    const Footpoint foot = face.closest_within(p, sight);
    if (foot.patch < 0) continue;
    const ObstacleDistance found = to_face(k, p, foot);
    if (found.distance_mm < nearest.distance_mm) nearest = found;
  }
  return nearest;
}

}  // namespace flank
