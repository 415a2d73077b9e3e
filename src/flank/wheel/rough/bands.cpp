#include "flank/wheel/rough/bands.h"

#include <algorithm>
#include <utility>

namespace flank::internal {

std::vector<Path> bands_of(const Path& path, int layers) {
  int highest = 0;
  for (const Strip& strip : path.strips) highest = std::max(highest, strip.layer);
  std::vector<Path> bands;
  for (int top = highest; top > 0; top -= layers) {
    Path band;
    for (Strip strip : path.strips) {
      if (strip.layer > top || strip.layer <= top - layers) continue;
      strip.layer = highest + 1 - strip.layer;
      strip.id = static_cast<int>(band.strips.size()) + 1;
      band.strips.push_back(std::move(strip));
    }
    if (!band.strips.empty()) bands.push_back(std::move(band));
  }
  return bands;
}

}  // namespace flank::internal
