#include "flank/pipeline/folder/fine_border.h"

#include <algorithm>
#include <vector>

#include "flank/verify/reach_border.h"

namespace flank::internal {
namespace {

template <class Value>
void take(std::vector<Value>& out, const std::vector<Value>& from, const std::vector<std::size_t>& which) {
  for (const std::size_t i : which)
    if (i < from.size()) out.push_back(from[i]);
}

void append(FaceSamples& out, const FaceSamples& from, const std::vector<std::size_t>& which) {
  take(out.points, from.points, which);
  take(out.areas, from.areas, which);
  take(out.reaches_mm, from.reaches_mm, which);
  take(out.curvatures_per_mm, from.curvatures_per_mm, which);
  take(out.normals, from.normals, which);
  take(out.reachable, from.reachable, which);
  take(out.smooth, from.smooth, which);
  take(out.cells, from.cells, which);
  out.spacing_mm = std::max(out.spacing_mm, from.spacing_mm);
}

}  // namespace

FaceSamples with_fine_border(const verify::Sampler& sampler, const TargetReach& reach, int face,
                             const FaceSamples& samples) {
  const std::vector<std::size_t> part = verify::reach_border(samples);
  if (part.empty()) return samples;
  std::vector<std::size_t> whole;
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    if (!std::binary_search(part.begin(), part.end(), i)) whole.push_back(i);
  FaceSamples fine = sampler.cut(samples, part);
  reach.fill(face, fine);
  FaceSamples out;
  out.face = samples.face;
  out.target = samples.target;
  out.of_solid = samples.of_solid;
  append(out, samples, whole);
  std::vector<std::size_t> all(fine.points.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  append(out, fine, all);
  return out;
}

}  // namespace flank::internal
