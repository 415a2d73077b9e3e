#include "flank/design/design_result.h"

namespace flank::internal {

double path_minutes(const Path& path, double axis_length_mm, const ChoiceRequest& rates) {
  const auto way = [&](const Pose& a, const Pose& b) {
    return 0.5 * ((b.tip - a.tip).norm() + (b.at(axis_length_mm) - a.at(axis_length_mm)).norm());
  };
  double cutting = 0.0, links = 0.0;
  for (std::size_t k = 0; k < path.strips.size(); ++k) {
    const std::vector<Pose>& poses = path.strips[k].poses;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) cutting += way(poses[i], poses[i + 1]);
    if (k > 0) links += way(path.strips[k - 1].poses.back(), poses.front());
  }
  return cutting / rates.feed_mm_min + links / rates.rapid_mm_min;
}

}  // namespace flank::internal
