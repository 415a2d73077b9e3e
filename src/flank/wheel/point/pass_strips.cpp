#include "flank/wheel/point/pass_strips.h"

#include <algorithm>
#include <utility>

#include "flank/path/turning.h"

namespace flank::internal {
namespace {

constexpr double kShortestMm = 1.0;  ///< strips that are shorter are not worth a link
constexpr std::size_t kFewestPoses = 3;

}  // namespace

void add_strip(Strip strip, const RadialFunction& radial, const PointOptions& options, std::vector<Strip>& out) {
  double length = 0.0;
  for (std::size_t k = 1; k < strip.poses.size(); ++k) length += (strip.poses[k].tip - strip.poses[k - 1].tip).norm();
  if (strip.poses.size() < kFewestPoses || length < kShortestMm) return;
  const Turning turn = sharpest_turn(strip.poses, radial.axis_length(), options.turn_window_mm);
  if (turn.angle_rad <= options.most_turn_rad) {
    out.push_back(std::move(strip));
    return;
  }
  const auto cut = static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(turn.pose, 1, strip.poses.size() - 2));
  Strip rest = strip;
  rest.poses.erase(rest.poses.begin(), rest.poses.begin() + cut);
  strip.poses.erase(strip.poses.begin() + cut + 1, strip.poses.end());
  add_strip(std::move(strip), radial, options, out);
  add_strip(std::move(rest), radial, options, out);
}

void add_strips(std::vector<PoseRow> rows, const RadialFunction& radial, const PointOptions& options,
                const std::string& kind, const std::string& face, std::vector<Strip>& out) {
  for (std::size_t j = 0; j < rows.size(); ++j) {
    if (j % 2 == 1) std::reverse(rows[j].begin(), rows[j].end());
    Strip strip{.id = 1, .kind = kind, .face = face, .poses = {}};
    rows[j].emplace_back();
    for (const std::optional<Pose>& pose : rows[j]) {
      if (pose) {
        strip.poses.push_back(*pose);
        continue;
      }
      add_strip(strip, radial, options, out);
      strip.poses.clear();
    }
  }
}

}  // namespace flank::internal
