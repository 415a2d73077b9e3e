#include "flank/wheel/rough/side_passes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/wheel/point/pass_strips.h"

namespace flank::internal {
namespace {

constexpr double kIdleShare = 4.0;  ///< of it, that a pass goes on through air

/// From one end of the layer to the other, at a share across.
std::vector<Pose> line_of(const ChannelLayer& layer, double share, bool forward, double apart) {
  const int count = std::max(1, static_cast<int>(std::ceil(layer.length() / apart)));
  std::vector<Pose> out;
  for (int k = 0; k <= count; ++k) out.push_back(layer.at(layer.length() * (forward ? k : count - k) / count, share));
  return out;
}

enum class Meets { kAir, kMaterial, kTooMuch };  // or it may not go there

/// What the tool meets on its way to each pose.
std::vector<Meets> meets(const std::vector<Pose>& line, const Cutter& cutter, const CycleLimits& limits,
                         const StockGrid& stock) {
  std::vector<Meets> out(line.size(), Meets::kAir);
  parallel_for(line.size(), [&](std::size_t k) {
    // A pass may begin or go on at any pose, in either neighbour's place.
    const Pose &from = line[k > 0 ? k - 1 : 1], &to = line[k];
    if (!limits.is_free(from, to)) out[k] = Meets::kTooMuch;
    if (out[k] == Meets::kTooMuch || !stock.meets(cutter, to)) return;
    const double in = std::max(stock.engagement(cutter, from, to), stock.engagement(cutter, to, from));
    out[k] = in > limits.planned_share * limits.most_engagement_rad ? Meets::kTooMuch : Meets::kMaterial;
  });
  return out;
}

}  // namespace

std::vector<Strip> side_passes(const ChannelLayer& layer, const Cutter& cutter, const CycleLimits& limits,
                               const std::string& face, StockGrid& stock) {
  std::vector<Strip> out;
  const double apart = limits.apart_share * cutter.tip();
  const auto most_idle = static_cast<std::size_t>(kIdleShare / limits.apart_share);
  for (const bool first : {true, false}) {
    const std::vector<Pose> line = line_of(layer, first ? 0.0 : 1.0, layer.climbs_from_first() == first, apart);
    const std::vector<Meets> all = meets(line, cutter, limits, stock);
    std::vector<std::pair<std::size_t, std::size_t>> runs;  // first and last pose in the material
    bool open = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
      if (all[k] == Meets::kTooMuch) open = false;
      if (open && k - runs.back().second > most_idle) open = false;
      if (all[k] != Meets::kMaterial) continue;
      if (open)
        runs.back().second = k;
      else
        runs.emplace_back(k, k), open = true;
    }
    for (const auto& [from, to] : runs) {
      if ((line[to].tip - line[from].tip).norm() < kShortestStripMm || to - from < 2) continue;
      Strip strip{.id = 1, .kind = "rough", .face = face, .poses = {}};
      strip.poses.assign(line.begin() + static_cast<std::ptrdiff_t>(from),
                         line.begin() + static_cast<std::ptrdiff_t>(to) + 1);
      stock.cut(cutter, strip.poses);
      out.push_back(std::move(strip));
    }
  }
  return out;
}

}  // namespace flank::internal
