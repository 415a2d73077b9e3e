#include "flank/setup/joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "flank/base/parallel.h"
#include "flank/geom/trim.h"
#include "flank/io/face_names.h"

namespace flank::internal {
namespace {

constexpr int kPerEdge = 24;       ///< points along an edge that are looked at
constexpr int kLeastTouching = 4;  ///< of them lie on the other face, if the two share a stretch of the edge
constexpr double kTouchMm = 2e-3, kTouchShare = 1e-5;  ///< how near that is; the share is of the part
constexpr double kSmoothShare = 0.9;  ///< of the points on a shared stretch: at its ends other faces may come in

std::size_t index(int face) { return static_cast<std::size_t>(face); }

/// Larger principal curvature along the unit normal n, from the fundamental forms.
double larger_curvature(const SurfaceJet& jet, const Vec3& n) {
  const double e = jet.du.squaredNorm(), f = jet.du.dot(jet.dv), g = jet.dv.squaredNorm(), det = e * g - f * f;
  const double l = jet.duu.dot(n), m = jet.duv.dot(n), q = jet.dvv.dot(n);
  const double mean = 0.5 * (e * q - 2.0 * f * m + g * l) / det, product = (l * q - m * m) / det;
  return mean + std::sqrt(std::max(0.0, mean * mean - product));
}

/// The edge at the middles of its stretches: not at the corners, which many faces share.
FaceEdge sample_edge(const Face& face, const BSplineCurve2& curve) {
  const BSplineSurface& s = face.surface;
  FaceEdge edge;
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < kPerEdge; ++i) {
    const Vec2 q = curve.value(curve.first() + (curve.last() - curve.first()) * (i + 0.5) / kPerEdge);
    const SurfaceJet jet = s.jet(q.x(), q.y());
    const Vec3 cross = jet.du.cross(jet.dv);
    if (cross.norm() > 0.0) {
      const Vec3 normal = (face.reversed ? -1.0 : 1.0) * cross.normalized();
      edge.points.push_back({jet.p, normal, larger_curvature(jet, normal)});
    }
    if (i > 0) edge.length_mm += (jet.p - last).norm() * kPerEdge / (kPerEdge - 1.0);
    edge.box.add(last = jet.p);
  }
  const double margin = edge.box.diagonal() / kPerEdge;
  edge.box.low.array() -= margin;
  edge.box.high.array() += margin;
  return edge;
}

std::vector<FaceEdge> border_of(const Face& face) {
  const BSplineSurface& s = face.surface;
  std::vector<TrimLoop> loops = face.loops;
  if (loops.empty()) loops.push_back(rectangle_loop({s.u_first(), s.u_last(), s.v_first(), s.v_last()}));
  std::vector<FaceEdge> edges;
  for (const TrimLoop& loop : loops)
    for (const BSplineCurve2& curve : loop.edges) edges.push_back(sample_edge(face, curve));
  return edges;
}

/// Length of the stretches of edges that lie on the target, with the same normals, mm.
double length_on(const std::vector<FaceEdge>& border, const Target& target, double near_mm, bool oriented) {
  const double least = std::cos(kSkinAngleDeg * std::numbers::pi / 180.0);
  double length = 0.0;
  for (const FaceEdge& edge : border) {
    int touching = 0, smooth = 0;
    for (const EdgePoint& b : edge.points) {
      if (target.box().squared_distance(b.point) > near_mm * near_mm) continue;
      const Footpoint foot = target.closest_within(b.point, near_mm);
      if (foot.patch < 0) continue;
      const double same = foot.normal.dot(b.normal);
      ++touching;
      smooth += (oriented ? same : std::abs(same)) >= least;
    }
    if (touching >= kLeastTouching && smooth >= kSmoothShare * touching) length += edge.length_mm * touching / kPerEdge;
  }
  return length;
}

bool meet(const Box3& p, const Box3& q, double near_mm) {
  return (p.low.array() <= q.high.array() + near_mm).all() && (q.low.array() <= p.high.array() + near_mm).all();
}

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

constexpr double kGroupMm = 1e-3;  ///< faces whose borders are closer than this are connected

/// Whether a stretch of the border of b lies on a: enough of the points along it touch a.
bool are_connected(const Target& a, const Face& b) {
  int touching = 0;
  const auto test = [&](double u, double v) {
    const Vec3 p = b.surface.value(u, v);
    if ((a.closest(p).point - p).norm() < kGroupMm) ++touching;
  };
  const BSplineSurface& s = b.surface;
  // A face without trims ends at the border of its surface.
  for (int k = 0; k <= kPerEdge && b.loops.empty(); ++k) {
    const double f = static_cast<double>(k) / kPerEdge;
    const double u = s.u_first() + f * (s.u_last() - s.u_first()), v = s.v_first() + f * (s.v_last() - s.v_first());
    test(u, s.v_first());
    test(u, s.v_last());
    test(s.u_first(), v);
    test(s.u_last(), v);
  }
  for (const TrimLoop& loop : b.loops) {
    for (const BSplineCurve2& edge : loop.edges) {
      for (int k = 0; k <= kPerEdge; ++k) {
        const Vec2 q = edge.value(edge.first() + (edge.last() - edge.first()) * k / kPerEdge);
        test(q[0], q[1]);
      }
    }
  }
  // Half an edge: faces that touch in a corner, or cross in a point, are not machined as one.
  return touching >= kPerEdge / 2;
}

/// A side and the edge that it goes over into: what one motion does of them, the next does not.
bool are_pieces_of_one(const Part& part, int a, int b) {
  const FaceName one = parse_face_name(part.face_id(a)), other = parse_face_name(part.face_id(b));
  return !one.piece.empty() && !other.piece.empty() && one.number == other.number;
}

}  // namespace

Joints::Joints(const Part& part) : part_(part), near_(std::max(kTouchMm, kTouchShare * part.box.diagonal())) {
  borders_.resize(part.faces.size());
  targets_.resize(part.faces.size());
  bends_.resize(part.faces.size());
  parallel_for(part.faces.size(), [&](std::size_t k) {
    if (!part.is_left_out(static_cast<int>(k))) borders_[k] = border_of(part.faces[k]);
  });
}

std::vector<int> Joints::joined_to(int face, const std::set<int>& known) {
  std::vector<int> others;
  for (int k = 0; k < part_.face_count(); ++k)
    if (known.count(k) == 0 && borders_meet(face, k)) others.push_back(k);
  prepare(face);
  std::vector<char> yes(others.size(), 0);
  parallel_for(others.size(), [&](std::size_t i) {
    prepare(others[i]);
    yes[i] = joined_mm(face, others[i]) > 0.0;
  });
  std::vector<int> joined;
  for (std::size_t i = 0; i < others.size(); ++i)
    if (yes[i] != 0) joined.push_back(others[i]);
  return joined;
}

double Joints::joined_mm(int face, int other) {
  prepare(face);
  prepare(other);
  const Face &a = part_.faces[index(face)], &b = part_.faces[index(other)];
  const bool oriented = a.of_solid && b.of_solid && a.solid == b.solid;
  return std::max(length_on(borders_[index(face)], *targets_[index(other)], near_, oriented),
                  length_on(borders_[index(other)], *targets_[index(face)], near_, oriented));
}

double Joints::bend(int face) {
  prepare(face);
  return bends_[index(face)];
}

const Target& Joints::target(int face) {
  prepare(face);
  return *targets_[index(face)];
}

void Joints::prepare(int face) {
  if (targets_[index(face)]) return;
  targets_[index(face)] = make_target({part_.faces[index(face)]}, +1);
  bends_[index(face)] = bend_of(*targets_[index(face)]);
}

/// A border that two faces share is an edge of both.
bool Joints::borders_meet(int a, int b) const {
  for (const FaceEdge& p : borders_[index(a)])
    for (const FaceEdge& q : borders_[index(b)])
      if (meet(p.box, q.box, near_)) return true;
  return false;
}

std::vector<std::vector<int>> connected_groups(const Part& part, const std::vector<int>& faces) {
  // The regions of a mesh are one target, whether they hang together or not.
  if (part.is_mesh()) return {faces};
  // A group's number is the index of one of its members.
  std::vector<int> group(faces.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    const std::unique_ptr<Target> target = make_target({part.faces[faces[i]]});
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      if (group[i] == group[j] || are_pieces_of_one(part, faces[i], faces[j]) ||
          !are_connected(*target, part.faces[faces[j]]))
        continue;
      const int from = group[j], to = group[i];
      std::replace(group.begin(), group.end(), from, to);
    }
  }
  std::vector<std::vector<int>> groups;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::vector<int> members;
    for (std::size_t j = 0; j < faces.size(); ++j)
      if (group[j] == static_cast<int>(i)) members.push_back(faces[j]);
    if (!members.empty()) groups.push_back(members);
  }
  return groups;
}

}  // namespace flank::internal
