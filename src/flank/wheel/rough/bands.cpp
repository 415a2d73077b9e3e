#include "flank/wheel/rough/bands.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace flank::internal {

std::vector<Path> bands_of(const Path& path, int layers) {
  std::set<int> open;
  for (const Strip& strip : path.strips) open.insert(strip.layer);
  std::vector<Path> bands;
  int before = 0;
  while (!open.empty()) {
    // Where nothing is so near below the last band, the next layer that there is.
    const int last = std::max(before + layers, *open.begin());
    Path band;
    for (const Strip& strip : path.strips) {
      if (strip.layer <= before || strip.layer > last) continue;
      band.strips.push_back(strip);
      band.strips.back().id = static_cast<int>(band.strips.size());
    }
    bands.push_back(std::move(band));
    before = *std::prev(open.upper_bound(last));
    open.erase(open.begin(), open.upper_bound(last));
  }
  return bands;
}

}  // namespace flank::internal
