#include "flank/trochoid/engagement/pose_filter.h"

#include <limits>

namespace flank::internal {

void PoseFilter::take(std::span<const NearPose> candidates, bool first_look) {
  if (first_look)
    for (std::vector<float>* values : {&x_, &y_, &dx_, &dy_}) values->clear();
  for (std::size_t k = x_.size(); k < candidates.size(); ++k) {
    x_.push_back(static_cast<float>(candidates[k].x0));
    y_.push_back(static_cast<float>(candidates[k].y0));
    dx_.push_back(static_cast<float>(candidates[k].dx));
    dy_.push_back(static_cast<float>(candidates[k].dy));
  }
}

const std::vector<std::size_t>& PoseFilter::reaching(double z, std::span<const ReachDisc> discs) {
  // What rounding may add to a squared distance, by its size: candidates lie some tool radii away at most.
  constexpr double kSpare = 1e-3;
  const std::size_t count = x_.size();
  excess_.assign(count, std::numeric_limits<float>::infinity());
  // Plain arrays and no branch, so that compilers look at several candidates at once.
  const float *x = x_.data(), *y = y_.data(), *dx = dx_.data(), *dy = dy_.data();
  float* excess = excess_.data();
  const auto height = static_cast<float>(z);
  for (const ReachDisc& disc : discs) {
    const auto cx = static_cast<float>(disc.x), cy = static_cast<float>(disc.y);
    const auto reach2 = static_cast<float>(disc.reach * disc.reach * (1.0 + kSpare));
    for (std::size_t k = 0; k < count; ++k) {
      const float ax = x[k] + height * dx[k] - cx, ay = y[k] + height * dy[k] - cy;
      const float here = ax * ax + ay * ay - reach2;
      excess[k] = here < excess[k] ? here : excess[k];
    }
  }
  reaching_.clear();
  for (std::size_t k = 0; k < count; ++k)
    if (excess[k] < 0.0F) reaching_.push_back(k);
  return reaching_;
}

}  // namespace flank::internal
