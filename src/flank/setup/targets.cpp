#include "flank/setup/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/setup/joints.h"
#include "flank/surface/offset_target.h"

namespace flank::internal {
namespace {

/// What is wanted of the group where material is left on it.
void leave(double allowance_mm, TargetGroup& group) {
  const double bend = sharpest_bend(*group.target);
  if (allowance_mm * bend >= 1.0)
    throw UsageError("allowance_mm", fmt::format("{}", allowance_mm),
                     fmt::format("{} is concave with a radius of {:.4g} mm; expected an allowance below that",
                                 group.faces, 1.0 / bend));
  group.target = offset_target(std::move(group.target), allowance_mm);
}

}  // namespace

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
    if (setup.allowance_mm > 0.0) leave(setup.allowance_mm, group);
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
