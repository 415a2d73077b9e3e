#include "flank/wheel/rough/bands.h"

#include <algorithm>
#include <utility>

namespace flank::internal {

std::vector<Path> bands_of(const Path& path, int layers) {
  int lowest = 0;
  for (const Strip& strip : path.strips) lowest = std::max(lowest, strip.layer);
  std::vector<Path> bands;
  for (int first = 1; first <= lowest; first += layers) {
    Path band;
    for (const Strip& strip : path.strips) {
      if (strip.layer < first || strip.layer - first >= layers) continue;
      band.strips.push_back(strip);
      band.strips.back().id = static_cast<int>(band.strips.size());
    }
    if (!band.strips.empty()) bands.push_back(std::move(band));
  }
  return bands;
}

}  // namespace flank::internal
