#include "flank/setup/skin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "flank/base/parallel.h"
#include "flank/geom/trim.h"
#include "flank/target.h"

namespace flank::internal {
namespace {

constexpr int kPerEdge = 24;      ///< points along an edge that are looked at
constexpr int kLeastTouching = 4; ///< of them lie on the other face, if the two share a stretch of the edge
constexpr double kTouchMm = 2e-3, kTouchShare = 1e-5;  ///< how near that is; the share is of the part
constexpr double kSmoothShare = 0.9;  ///< of the points on a shared stretch: at its ends other faces may come in

struct BorderPoint {
  Vec3 point, normal;
};

/// Points of one edge of a face, with the face's normal.
using BorderEdge = std::vector<BorderPoint>;

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
        if (cross.norm() > 0.0) edge.push_back({jet.p, (face.reversed ? -1.0 : 1.0) * cross.normalized()});
      }
    }
  }
  return edges;
}

/// Does a stretch of any edge lie on the target, with the same normals?
bool joins(const std::vector<BorderEdge>& border, const Target& target, double near_mm, bool oriented) {
  const double least = std::cos(kSkinAngleDeg * std::numbers::pi / 180.0);
  for (const BorderEdge& edge : border) {
    int touching = 0, smooth = 0;
    for (const BorderPoint& b : edge) {
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

/// Which faces are joined, with what that takes made once for each face.
class Joints {
 public:
  explicit Joints(const Part& part) : part_(part), near_(std::max(kTouchMm, kTouchShare * part.box.diagonal())) {
    borders_.resize(part.faces.size());
    boxes_.resize(part.faces.size());
    targets_.resize(part.faces.size());
    parallel_for(part.faces.size(), [&](std::size_t k) {
      if (part.is_left_out(static_cast<int>(k))) return;
      borders_[k] = border_of(part.faces[k]);
      for (const BorderEdge& edge : borders_[k])
        for (const BorderPoint& b : edge) boxes_[k].add(b.point);
    });
  }

  [[nodiscard]] std::vector<int> joined_to(int face) {
    std::vector<int> others;
    for (int k = 0; k < part_.face_count(); ++k)
      if (k != face && !part_.is_left_out(k) && boxes_meet(face, k)) others.push_back(k);
    target(face);
    for (const int k : others) target(k);
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

 private:
  static std::size_t index(int face) { return static_cast<std::size_t>(face); }
  [[nodiscard]] const Face& value(int face) const { return part_.faces[index(face)]; }
  void target(int face) {
    if (!targets_[index(face)]) targets_[index(face)] = make_target({value(face)}, +1);
  }
  [[nodiscard]] bool boxes_meet(int a, int b) const {
    const Box3 &p = boxes_[index(a)], &q = boxes_[index(b)];
    return (p.low.array() <= q.high.array() + near_).all() && (q.low.array() <= p.high.array() + near_).all();
  }

  const Part& part_;
  double near_;
  std::vector<std::vector<BorderEdge>> borders_;
  std::vector<Box3> boxes_;
  std::vector<std::unique_ptr<Target>> targets_;
};

}  // namespace

std::vector<int> smooth_skin(const Part& part, const std::vector<int>& faces) {
  std::set<int> skin(faces.begin(), faces.end());
  if (part.is_mesh()) return {skin.begin(), skin.end()};
  Joints joints(part);
  std::vector<int> open(skin.begin(), skin.end());
  while (!open.empty()) {
    const int face = open.back();
    open.pop_back();
    for (const int other : joints.joined_to(face))
      if (skin.insert(other).second) open.push_back(other);
  }
  return {skin.begin(), skin.end()};
}

}  // namespace flank::internal
