#include "flank/setup/targets.h"

#include <algorithm>
#include <numeric>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/io/face_names.h"

namespace flank::internal {
namespace {

constexpr double kTouchMm = 1e-3;  ///< faces whose borders are closer than this are connected

/// Whether a stretch of the border of b lies on a: enough of the points along it touch a.
bool are_connected(const Target& a, const Face& b) {
  constexpr int kPerEdge = 24;
  int touching = 0;
  const auto test = [&](double u, double v) {
    const Vec3 p = b.surface.value(u, v);
    if ((a.closest(p).point - p).norm() < kTouchMm) ++touching;
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

std::vector<TargetGroup> make_targets(const Setup& setup) {
  const Part& part = setup.part;
  std::vector<TargetGroup> targets;
  for (const std::vector<int>& members : connected_groups(part, setup.targets)) {
    TargetGroup& group = targets.emplace_back();
    group.indices = members;
    std::vector<Face> values;
    for (int f : members) {
      group.faces += (group.faces.empty() ? "" : ",") + part.face_id(f);
      if (!part.is_mesh()) values.push_back(part.faces[f]);
    }
    group.target = part.is_mesh() ? make_target(extract_mesh(part, members)) : make_target(std::move(values));
  }
  return targets;
}

std::vector<FaceSamples> judge_samples(const Setup& setup, double spacing_mm, double check_spacing_mm) {
  const Part& part = setup.part;
  const std::vector<int>& targets = setup.targets;
  std::vector<int> faces = targets;
  faces.insert(faces.end(), setup.checks.begin(), setup.checks.end());
  // In the part's order, whichever list a face is from: reports and pictures show them so.
  std::sort(faces.begin(), faces.end());
  std::vector<FaceSamples> samples(faces.size());
  // Each face writes to its own place: the order does not depend on threads.
  parallel_for(samples.size(), [&](std::size_t k) {
    const int face = faces[k];
    const bool target = std::find(targets.begin(), targets.end(), face) != targets.end();
    const double spacing = target ? spacing_mm : check_spacing_mm;
    samples[k] = part.is_mesh() ? sample_mesh(part.face_id(face), extract_mesh(part, {face}), spacing, target)
                                : sample_face(part.faces[static_cast<std::size_t>(face)], spacing, target);
  });
  return samples;
}

}  // namespace flank::internal
