#include "flank/pipeline/judge/rough_left.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "flank/judge.h"
#include "flank/setup/target_reach.h"

namespace flank::internal {
namespace {

constexpr double kSpacingShare = 0.01;  ///< of the part's diagonal: some ten thousand samples of a wheel

/// The least value that so much of the area does not exceed. `left`: ascending.
double share_below(const std::vector<std::pair<double, double>>& left, double area) {
  for (const auto& [value, own] : left)
    if ((area -= own) <= 0.0) return value;
  return left.empty() ? 0.0 : left.back().first;
}

}  // namespace

RoughLeft left_by_roughing(const Setup& setup, const Tool& tool, const Path& all, double ball_mm) {
  const SweptVolume volume(tool, all);
  std::vector<FaceSamples> faces = target_samples(setup, kSpacingShare * setup.part.box.diagonal());
  const TargetReach reach(setup, ReachBall{ball_mm}, faces);
  std::vector<std::pair<double, double>> left;
  double area = 0.0;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    reach.fill(setup.targets[k], faces[k]);
    const std::vector<double>& open = faces[k].reachable;
    const std::vector<SweptDistance> found = swept_distances(volume, faces[k], 1e300);
    for (std::size_t i = 0; i < found.size(); ++i) {
      left.emplace_back(std::max(0.0, found[i].f),
                        (open.empty() ? 1.0 : open[i]) * faces[k].areas[i] * setup.copies_of(setup.targets[k]));
      area += left.back().second;
    }
  }
  std::sort(left.begin(), left.end());
  return {share_below(left, 0.5 * area), share_below(left, 0.9 * area)};
}

}  // namespace flank::internal
