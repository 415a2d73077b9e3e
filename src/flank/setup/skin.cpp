#include "flank/setup/skin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/geom/face_pieces.h"
#include "flank/geom/trim.h"
#include "flank/target.h"

namespace flank::internal {
namespace {

constexpr int kPerEdge = 24;       ///< points along an edge that are looked at
constexpr int kLeastTouching = 4;  ///< of them lie on the other face, if the two share a stretch of the edge
constexpr double kTouchMm = 2e-3, kTouchShare = 1e-5;  ///< how near that is; the share is of the part
constexpr double kSmoothShare = 0.9;  ///< of the points on a shared stretch: at its ends other faces may come in

struct BorderPoint {
  Vec3 point, normal;
};

/// Points of one edge of a face, with the face's normal.
struct BorderEdge {
  std::vector<BorderPoint> points;
  Box3 box;  ///< of the edge, with a margin for what it does between the points
};

std::vector<BorderEdge> border_of(const Face& face) {
  const BSplineSurface& s = face.surface;
  std::vector<TrimLoop> loops = face.loops;
  if (loops.empty()) loops.push_back(rectangle_loop({s.u_first(), s.u_last(), s.v_first(), s.v_last()}));
  std::vector<BorderEdge> edges;
  for (const TrimLoop& loop : loops) {
    for (const BSplineCurve2& curve : loop.edges) {
      BorderEdge& edge = edges.emplace_back();
      for (int i = 0; i < kPerEdge; ++i) {
        // Not at the corners, which many faces share.
        const Vec2 q = curve.value(curve.first() + (curve.last() - curve.first()) * (i + 0.5) / kPerEdge);
        const SurfaceJet jet = s.jet(q.x(), q.y());
        const Vec3 cross = jet.du.cross(jet.dv);
        if (cross.norm() > 0.0) edge.points.push_back({jet.p, (face.reversed ? -1.0 : 1.0) * cross.normalized()});
        edge.box.add(jet.p);
      }
      const double margin = edge.box.diagonal() / kPerEdge;
      edge.box.low.array() -= margin;
      edge.box.high.array() += margin;
    }
  }
  return edges;
}

/// Does a stretch of any edge lie on the target, with the same normals?
bool joins(const std::vector<BorderEdge>& border, const Target& target, double near_mm, bool oriented) {
  const double least = std::cos(kSkinAngleDeg * std::numbers::pi / 180.0);
  for (const BorderEdge& edge : border) {
    int touching = 0, smooth = 0;
    for (const BorderPoint& b : edge.points) {
      if (target.box().squared_distance(b.point) > near_mm * near_mm) continue;
      const Footpoint foot = target.closest_within(b.point, near_mm);
      if (foot.patch < 0) continue;
      const double same = foot.normal.dot(b.normal);
      ++touching;
      smooth += (oriented ? same : std::abs(same)) >= least;
    }
    if (touching >= kLeastTouching && smooth >= kSmoothShare * touching) return true;
  }
  return false;
}

bool meet(const Box3& p, const Box3& q, double near_mm) {
  return (p.low.array() <= q.high.array() + near_mm).all() && (q.low.array() <= p.high.array() + near_mm).all();
}

/// Larger principal curvature, 1/mm, that half of the face exceeds.
double bend_of(const Target& target) {
  constexpr double kSamples = 60.0;
  std::vector<double> bends;
  for (const SurfaceSample& sample : target.samples(std::sqrt(target.area() / kSamples))) {
    const Footpoint foot = target.closest(sample.point);
    bends.push_back(std::max(std::abs(foot.k1), std::abs(foot.k2)));
  }
  if (bends.empty()) return 0.0;
  const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
  std::nth_element(bends.begin(), middle, bends.end());
  return *middle;
}

/// Which faces are joined, with what that takes made once for each face.
class Joints {
 public:
  explicit Joints(const Part& part) : part_(part), near_(std::max(kTouchMm, kTouchShare * part.box.diagonal())) {
    borders_.resize(part.faces.size());
    targets_.resize(part.faces.size());
    bends_.resize(part.faces.size());
    parallel_for(part.faces.size(), [&](std::size_t k) {
      if (!part.is_left_out(static_cast<int>(k))) borders_[k] = border_of(part.faces[k]);
    });
  }

  /// Those of the faces that are not in `known`.
  [[nodiscard]] std::vector<int> joined_to(int face, const std::set<int>& known) {
    std::vector<int> others;
    for (int k = 0; k < part_.face_count(); ++k)
      if (known.count(k) == 0 && borders_meet(face, k)) others.push_back(k);
    prepare(face);
    parallel_for(others.size(), [&](std::size_t i) { prepare(others[i]); });
    std::vector<char> yes(others.size(), 0);
    parallel_for(others.size(), [&](std::size_t i) {
      const int k = others[i];
      const bool oriented = value(face).of_solid && value(k).of_solid && value(face).solid == value(k).solid;
      yes[i] = joins(borders_[index(face)], *targets_[index(k)], near_, oriented) ||
               joins(borders_[index(k)], *targets_[index(face)], near_, oriented);
    });
    std::vector<int> joined;
    for (std::size_t i = 0; i < others.size(); ++i)
      if (yes[i] != 0) joined.push_back(others[i]);
    return joined;
  }

  /// How strongly the face bends, and its surface.
  [[nodiscard]] double bend(int face) {
    prepare(face);
    return bends_[index(face)];
  }
  [[nodiscard]] const Target& target(int face) {
    prepare(face);
    return *targets_[index(face)];
  }

 private:
  static std::size_t index(int face) { return static_cast<std::size_t>(face); }
  [[nodiscard]] const Face& value(int face) const { return part_.faces[index(face)]; }
  void prepare(int face) {
    if (targets_[index(face)]) return;
    targets_[index(face)] = make_target({value(face)}, +1);
    bends_[index(face)] = bend_of(*targets_[index(face)]);
  }
  /// A border that two faces share is an edge of both.
  [[nodiscard]] bool borders_meet(int a, int b) const {
    for (const BorderEdge& p : borders_[index(a)])
      for (const BorderEdge& q : borders_[index(b)])
        if (meet(p.box, q.box, near_)) return true;
    return false;
  }

  const Part& part_;
  double near_;
  std::vector<std::vector<BorderEdge>> borders_;
  std::vector<std::unique_ptr<Target>> targets_;
  std::vector<double> bends_;
};

/// A skin that grows.
struct Skin {
  std::set<int> faces;
  double area = 0.0;
  Box3 box;

  void add(int face, const Target& target) {
    if (!faces.insert(face).second) return;
    area += target.area();
    box.add(target.box().low);
    box.add(target.box().high);
  }
  /// Its mean width across its longest extent, mm.
  [[nodiscard]] double width() const { return area / std::max(box.diagonal(), 1e-9); }
};

}  // namespace

std::vector<int> smooth_skin(const Part& part, const std::vector<int>& faces) {
  if (part.is_mesh()) {
    const std::set<int> all(faces.begin(), faces.end());
    return {all.begin(), all.end()};
  }
  Joints joints(part);
  Skin skin;
  // What is joined to the skin, by how strongly it bends: the calm ones first, so that the skin is as wide as it can be
  // when the edges are looked at.
  std::set<std::pair<double, int>> open;
  std::set<int> known(faces.begin(), faces.end());
  const auto look_around = [&](int face) {
    for (const int other : joints.joined_to(face, known)) {
      known.insert(other);
      open.insert({joints.bend(other), other});
    }
  };
  for (const int face : faces) skin.add(face, joints.target(face));
  for (const int face : faces) look_around(face);
  while (!open.empty()) {
    const auto [bend, face] = *open.begin();
    open.erase(open.begin());
    if (bend * skin.width() > kEdgeBend) break;
    skin.add(face, joints.target(face));
    look_around(face);
  }
  return {skin.faces.begin(), skin.faces.end()};
}

}  // namespace flank::internal
