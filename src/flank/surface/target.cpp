#include "flank/target.h"

#include "flank/base/assert.h"
#include "flank/base/parallel.h"

namespace flank {
using namespace internal;
namespace {

constexpr std::size_t kGrain = 64;

}  // namespace

void Target::closest_batch(std::span<const Vec3> points, std::span<Footpoint> footpoints) const {
  FLANK_ASSERT(footpoints.size() == points.size());
  parallel_blocks(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) footpoints[k] = closest(points[k]);
  });
}

void Target::track_batch(std::span<const Vec3> points, std::span<Footpoint> footpoints) const {
  FLANK_ASSERT(footpoints.size() == points.size());
  parallel_blocks(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) footpoints[k] = track(points[k], footpoints[k]);
  });
}

}  // namespace flank
