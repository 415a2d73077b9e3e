#include "flank/obstacle/pose_clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/obstacle/convex_profile.h"
#include "flank/obstacle/triangle_distance.h"
#include "flank/obstacle/triangle_tree.h"

namespace flank::internal {
namespace {

constexpr std::size_t kBlock = 16;  ///< poses per task; fixed, so that threads change nothing
/// Entries of a depth-first search: one per level and one more. The tree is halved at each level, so 2^255 triangles
/// fit.
constexpr int kStack = 256;
/// Of the flank's meridian before it is simplified: a chord over a two-thousandth of the axis is far within
/// kPlannedFlankErrorMm.
constexpr int kMeridianPoints = 2049;
/// Share of kPlannedFlankErrorMm that simplifying may take; the rest is for the fine polyline.
constexpr double kPolylineShare = 0.9;
/// Spacings from a sample to the corner of its cell, at most: 0.7 of a square one, more where the parametrisation is
/// sheared or stretched.
constexpr double kSamplesApart = 1.5;

/// Every point of `fine` that a polyline within the error needs (Douglas and Peucker).
void simplify(const std::vector<Vec2>& fine, std::size_t a, std::size_t b, std::vector<Vec2>& out) {
  const Vec2 d = fine[b] - fine[a];
  const double length = d.norm();
  double most = 0.0;
  std::size_t at = a;
  // The point farthest off the chord is kept, and both halves are looked at in turn.
  for (std::size_t k = a + 1; k < b; ++k) {
    const Vec2 x = fine[k] - fine[a];
    const double off = length > 0.0 ? std::abs(d.x() * x.y() - d.y() * x.x()) / length : x.norm();
    if (off > most) most = off, at = k;
  }
  if (most <= kPolylineShare * kPlannedFlankErrorMm) {
    out.push_back(fine[b]);
    return;
  }
  simplify(fine, a, at, out);
  simplify(fine, at, b, out);
}

/// The flank, a union of spheres: what turns below its meridian, and the balls at its ends.
std::vector<ConvexProfile> flank_shapes(const RadialFunction& radial) {
  const std::vector<Vec2> fine = meridian(radial, kMeridianPoints);
  std::vector<Vec2> outline{fine.front()};
  simplify(fine, 0, fine.size() - 1, outline);
  std::vector<ConvexProfile> shapes = split_convex(outline);
  for (const double s : {0.0, radial.axis_length()})
    shapes.emplace_back(std::vector<Vec2>{Vec2(s, 0.0)}, radial.at(s).r);
  return shapes;
}

/// A triangle of one of the trees and how near it is.
struct Hit {
  double value = 0.0;
  int side = -1, triangle = -1;
  TriangleDistance found;
};

/// Bodies against one tree, depth first, nearest first. The tangent plane of a convex distance at the middle of a box
/// bounds it on the box.
class Search {
 public:
  Search(const std::vector<ConvexProfile>& bodies, const TriangleTree& tree, const Pose& pose)
      : bodies_(bodies), tree_(tree), pose_(pose) {}

  /// Lowers `hit` to the least clearance below hit.value; stops at the first one found if `any`.
  void run(Hit& hit, bool any) const {
    if (tree_.empty() || bodies_.empty()) return;
    std::array<Entry, kStack> stack;
    int top = 0;
    stack[static_cast<std::size_t>(top++)] = entry_of({0.0, 0.0, 0, kAll}, 0, hit.value);
    while (top > 0) {
      const Entry entry = stack[static_cast<std::size_t>(--top)];
      if (entry.bound >= hit.value) continue;
      const TriangleTree::Node& node = tree_.nodes()[static_cast<std::size_t>(entry.node)];
      if (node.second < 0) {
        for (int k = node.first; k < node.end; ++k) {
          measure(k, hit, any, entry.bodies);
          if (any && hit.triangle >= 0) return;
        }
        continue;
      }
      Entry near = entry_of(entry, entry.node + 1, hit.value), far = entry_of(entry, node.second, hit.value);
      // For the nearest place the lower bound leads, for any place the middle does: it is more likely to be one.
      if (any ? far.middle < near.middle : far.bound < near.bound) std::swap(near, far);
      if (far.bound < hit.value) stack[static_cast<std::size_t>(top++)] = far;
      if (near.bound < hit.value) stack[static_cast<std::size_t>(top++)] = near;
    }
  }

  void measure(int k, Hit& hit, bool any, std::uint64_t which = kAll) const {
    const TriangleTree::Triangle& triangle = tree_.triangles()[static_cast<std::size_t>(k)];
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if ((which & bit(b)) == 0) continue;
      const ConvexProfile& body = bodies_[b];
      const TriangleDistance found =
          triangle_distance(body, pose_, triangle.corners, hit.value + triangle.slack_mm, any);
      // found.value is below hit.value + slack, so the clearance is below hit.value.
      if (found.below) hit = {found.value - triangle.slack_mm, hit.side, k, found};
    }
  }

 private:
  struct Entry {
    double bound = 0.0, middle = 0.0;  ///< of all of the node, and at its middle
    int node = 0;
    std::uint64_t bodies = 0;  ///< that can be near enough, a bit each
  };

  static constexpr std::uint64_t kAll = ~std::uint64_t{0};
  /// Bodies from the 64th on share the last bit: they are then measured together, never left out.
  static std::uint64_t bit(std::size_t body) { return std::uint64_t{1} << std::min<std::size_t>(body, 63); }

  /// The node `index` below `parent`: bodies that were too far from that are too far from this.
  [[nodiscard]] Entry entry_of(const Entry& parent, int index, double below) const {
    const TriangleTree::Node& node = tree_.nodes()[static_cast<std::size_t>(index)];
    const PosedPoint at(pose_, node.center);
    const Vec3 across = at.rho > 0.0 ? Vec3(at.perpendicular / at.rho) : pose_.axis.unitOrthogonal();
    Entry entry{1e300, 1e300, index, 0};
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if ((parent.bodies & bit(b)) == 0) continue;
      // Over the box a convex function lies above its tangent plane: value less sum of |gradient_k| half_k.
      const ProfileJet jet = bodies_[b].at(at.z, at.rho);
      const Vec3 gradient = jet.along * pose_.axis + jet.out * across;
      entry.middle = std::min(entry.middle, jet.value);
      const double bound = jet.value - gradient.cwiseAbs().dot(node.half) - tree_.largest_slack();
      if (bound < below) entry.bodies |= bit(b);
      entry.bound = std::min(entry.bound, bound);
    }
    return entry;
  }

  const std::vector<ConvexProfile>& bodies_;
  const TriangleTree& tree_;
  const Pose& pose_;
};

}  // namespace

ObstacleMesh obstacle_points(const Target& target, double spacing_mm, bool flank_may_touch) {
  FLANK_ASSERT(spacing_mm > 0.0);
  ObstacleMesh out;
  out.slack_mm = kSamplesApart * spacing_mm;
  out.flank_may_touch = flank_may_touch;
  for (const SurfaceSample& sample : target.samples(spacing_mm)) {
    const int k = static_cast<int>(out.mesh.vertices.size());
    out.mesh.vertices.push_back(sample.point);
    out.mesh.triangles.push_back({k, k, k});
  }
  return out;
}

/// Bodies that keep clear of a tree, twice: shank and holder of everything, the flank of what it may not touch.
struct PoseChecker::Data {
  struct Side {
    std::vector<ConvexProfile> bodies;
    TriangleTree tree;
  };
  static constexpr std::size_t kSides = 2;
  std::array<Side, kSides> sides;

  /// The least clearance below `horizon`; `warm`, the hit of a pose nearby, is looked at first.
  [[nodiscard]] Hit search(const Pose& pose, double horizon, bool any, const Hit& warm) const {
    Hit hit;
    hit.value = horizon;
    for (std::size_t s = 0; s < kSides && !(any && hit.triangle >= 0); ++s) {
      const Search search(sides[s].bodies, sides[s].tree, pose);
      const int before = hit.triangle;
      const double value = hit.value;
      if (warm.side == static_cast<int>(s) && warm.triangle >= 0) search.measure(warm.triangle, hit, any);
      if (!(any && hit.triangle >= 0)) search.run(hit, any);
      if (hit.triangle != before || hit.value < value) hit.side = static_cast<int>(s);
    }
    return hit;
  }

  [[nodiscard]] PoseClearance answer(const Hit& hit) const {
    PoseClearance out;
    out.clearance_mm = hit.value;
    if (hit.triangle < 0) return out;
    const BodyJet& jet = hit.found.jet;
    out.surface =
        sides[static_cast<std::size_t>(hit.side)].tree.triangles()[static_cast<std::size_t>(hit.triangle)].surface;
    out.point = hit.found.point;
    out.tool_point = hit.found.point - hit.found.value * jet.gradient;
    // The nearest point of the tool, a + z u + rho e, moves by da + z du - rho <e, du> u, and the clearance falls by
    // that along the gradient.
    const double z = jet.z - hit.found.value * jet.along, rho = jet.rho - hit.found.value * jet.out;
    out.tip_gradient = -jet.gradient;
    out.axis_gradient = (rho * jet.along - z * jet.out) * jet.across;
    return out;
  }
};

PoseChecker::PoseChecker(const Tool& tool, std::span<const ObstacleMesh> surfaces) {
  auto data = std::make_unique<Data>();
  for (const std::vector<Vec2>* profile : {&tool.shank, &tool.holder})
    for (ConvexProfile& body : split_convex(*profile)) data->sides[0].bodies.push_back(std::move(body));
  data->sides[1].bodies = flank_shapes(tool.radial);
  std::array<std::vector<TriangleTree::Triangle>, Data::kSides> triangles;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const ObstacleMesh& surface = surfaces[k];
    for (const auto& t : surface.mesh.triangles) {
      const auto corner = [&](std::size_t c) { return surface.mesh.vertices[static_cast<std::size_t>(t[c])]; };
      TriangleTree::Triangle triangle{{corner(0), corner(1), corner(2)}, static_cast<int>(k)};
      triangle.slack_mm = surface.slack_mm + surface.above_clearance_mm;
      if (!data->sides[0].bodies.empty()) triangles[0].push_back(triangle);
      triangle.slack_mm = surface.slack_mm + surface.flank_clearance_mm;
      if (!surface.flank_may_touch) triangles[1].push_back(triangle);
    }
  }
  for (std::size_t s = 0; s < Data::kSides; ++s) data->sides[s].tree = TriangleTree(std::move(triangles[s]));
  data_ = std::move(data);
}

PoseChecker::~PoseChecker() = default;
PoseChecker::PoseChecker(PoseChecker&&) noexcept = default;

bool PoseChecker::is_free(const Pose& pose, double margin_mm) const {
  return data_->search(pose, margin_mm, true, {}).triangle < 0;
}

PoseClearance PoseChecker::measure(const Pose& pose, double horizon_mm) const {
  return data_->answer(data_->search(pose, horizon_mm, false, {}));
}

void PoseChecker::free_batch(std::span<const Pose> poses, double margin_mm, std::span<char> out) const {
  FLANK_ASSERT(out.size() == poses.size());
  parallel_blocks(poses.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    // Poses of a path follow each other: the last hit is tried first, and most of the tree is then too far.
    Hit last;
    for (std::size_t k = begin; k < end; ++k) {
      const Hit hit = data_->search(poses[k], margin_mm, true, last);
      out[k] = static_cast<char>(hit.triangle < 0);
      if (hit.triangle >= 0) last = hit;
    }
  });
}

void PoseChecker::measure_batch(std::span<const Pose> poses, double horizon_mm, std::span<PoseClearance> out) const {
  FLANK_ASSERT(out.size() == poses.size());
  parallel_blocks(poses.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    Hit last;
    for (std::size_t k = begin; k < end; ++k) {
      last = data_->search(poses[k], horizon_mm, false, last);
      out[k] = data_->answer(last);
    }
  });
}

}  // namespace flank::internal
