#include "flank/trochoid/engagement/pose_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/trochoid/engagement/lanes.h"

namespace flank::internal {
namespace {

/// What rounding may add: to a squared reach by its size, and by that of the largest. Candidates lie some tool radii away.
constexpr double kSpare = 1e-3, kSpareOfLargest = 1e-4;

/// Of an arc, for all candidates at once.
struct ArcLook {
  Eigen::Vector2f from, to;
  float radius, beside,
      whole;  ///< of the ring, mm; how far beside the sector still counts, mm^2; 1: all that reach the ring
};

/// Where axes are at a height.
FLANK_LANES void at_height(std::size_t count, float height, const float* __restrict at_zero,
                           const float* __restrict by_z, float* __restrict at) {
  for (std::size_t k = 0; k < count; ++k) at[k] = at_zero[k] + height * by_z[k];
}

struct BandLook {
  float height, last;
};

/// Bands of the candidates at a height, and how far those that lean reach.
FLANK_LANES void leaning_reaches(std::size_t count, const BandLook& look, const float* __restrict first,
                                 const float* __restrict by_z, const float* __restrict leaning,
                                 const float* __restrict swing, std::int32_t* __restrict place,
                                 float* __restrict reach) {
  const float height = look.height, last = look.last;
  for (std::size_t k = 0; k < count; ++k) {
    const float band = first[k] + height * by_z[k], above = band > 0.0F ? band : 0.0F;
    place[k] = static_cast<std::int32_t>(above < last ? above : last);
    const float up = band + swing[k], down = band - swing[k];
    const float leans = up < 0.0F ? 0.0F : leaning[k];
    reach[k] = down > last ? 0.0F : leans;
  }
}

/// Lessens each excess to that over this arc, squared distances less squared reaches.
FLANK_LANES void add_excess(std::size_t count, const ArcLook& arc, const float* __restrict x, const float* __restrict y,
                            const float* __restrict reach, float* __restrict excess) {
  const float fx = arc.from.x(), fy = arc.from.y(), tx = arc.to.x(), ty = arc.to.y();
  const float radius = arc.radius, beside = arc.beside, whole = arc.whole;
  for (std::size_t k = 0; k < count; ++k) {
    const float bx = x[k] - fx, by = y[k] - fy, cx = x[k] - tx, cy = y[k] - ty;
    const float at_from = bx * bx + by * by, at_to = cx * cx + cy * cy;
    const float ends = (at_from < at_to ? at_from : at_to) - reach[k] * reach[k];
    // Negative where the axis is beside the sector.
    const float after = fx * y[k] - fy * x[k], before = x[k] * ty - y[k] * tx;
    const float inside = (after < before ? after : before) > beside ? 1.0F : whole;
    const float meets = radius + reach[k];
    const float within = inside * (x[k] * x[k] + y[k] * y[k] - meets * meets);
    const float here = ends < within ? ends : within;
    excess[k] = here < excess[k] ? here : excess[k];
  }
}

/// Raises reaches to those of upright tools.
FLANK_LANES void upright_reaches(std::size_t count, const float* __restrict bands, const std::int32_t* __restrict place,
                                 float* __restrict reach) {
  for (std::size_t k = 0; k < count; ++k) {
    const float radius = bands[place[k]];
    reach[k] = reach[k] < radius ? radius : reach[k];
  }
}

/// Candidates that are looked at together.
constexpr std::size_t kBlock = 32;

FLANK_LANES bool any_reaches(std::size_t count, const float* __restrict excess, const float* __restrict reach) {
  std::int32_t any = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t there = reach[k] > 0.0F ? 1 : 0;
    any |= excess[k] < 0.0F ? there : 0;
  }
  return any != 0;
}

}  // namespace

PoseFilter::PoseFilter(const ToolProfile& profile) : largest_(profile.largest()) {
  const double width = (profile.high() - profile.low()) / kBands;
  low_ = profile.low() - 2.0 * width;
  per_mm_ = 1.0 / width;
  // Radii at the bands' borders and between; the profile is smooth but for its ends, where it falls to nothing.
  constexpr int kBetween = 4;
  const auto radius = [&](double band) {
    ToolProfile::Place place;
    return profile.at(low_ + band * width, place) ? place.radius : 0.0;
  };
  for (int band = 0; band < kBands + 4; ++band) {
    double most = 0.0;
    for (int k = -1; k <= kBetween + 1; ++k) most = std::max(most, radius(band + static_cast<double>(k) / kBetween));
    const double spare2 = kSpare * most * most + kSpareOfLargest * largest_ * largest_;
    bands_.push_back(most > 0.0 ? static_cast<float>(std::sqrt(most * most + spare2)) : 0.0F);
  }
}

void PoseFilter::take(std::span<const NearPose> candidates) {
  for (std::vector<float>* values :
       {&x_, &y_, &dx_, &dy_, &band_, &band_by_z_, &leaning_, &swing_, &x_at_, &y_at_, &reach_, &excess_})
    values->resize(candidates.size());
  place_.resize(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const NearPose& c = candidates[k];
    const double slope2 = c.slope2();
    x_[k] = static_cast<float>(c.x0);
    y_[k] = static_cast<float>(c.y0);
    dx_[k] = static_cast<float>(c.dx);
    dy_[k] = static_cast<float>(c.dy);
    band_[k] = static_cast<float>((c.h0 - low_) * per_mm_);
    band_by_z_[k] = static_cast<float>(c.dh * per_mm_);
    leaning_[k] = swing_[k] = 0.0F;
    if (slope2 <= kLeaning * kLeaning) continue;
    const double reach = (1.0 + kSpare) * largest_ * std::sqrt(1.0 + slope2);
    leaning_[k] = static_cast<float>(reach);
    swing_[k] = static_cast<float>(1.0 + reach * std::sqrt(slope2) / c.dh * per_mm_);
  }
}

void PoseFilter::find_reaches(double z) {
  const std::size_t count = x_.size();
  const auto height = static_cast<float>(z), last = static_cast<float>(bands_.size() - 1);
  at_height(count, height, x_.data(), dx_.data(), x_at_.data());
  at_height(count, height, y_.data(), dy_.data(), y_at_.data());
  leaning_reaches(count, {height, last}, band_.data(), band_by_z_.data(), leaning_.data(), swing_.data(), place_.data(),
                  reach_.data());
  upright_reaches(count, bands_.data(), place_.data(), reach_.data());
}

const std::vector<std::size_t>& PoseFilter::reaching(const ToolRing& ring, std::span<const OpenArc> arcs) {
  const std::size_t count = x_.size();
  find_reaches(ring.z);
  std::fill(excess_.begin(), excess_.end(), std::numeric_limits<float>::infinity());
  const auto radius = static_cast<float>(ring.radius);
  const auto beside = static_cast<float>(-kSpare * ring.radius * (ring.radius + largest_));
  for (const OpenArc& arc : arcs)
    add_excess(count, {arc.from.cast<float>(), arc.to.cast<float>(), radius, beside, arc.wide ? 1.0F : 0.0F},
               x_at_.data(), y_at_.data(), reach_.data(), excess_.data());
  reaching_.clear();
  // Most blocks hold none.
  for (std::size_t block = 0; block < count; block += kBlock) {
    const std::size_t end = std::min(block + kBlock, count);
    if (!any_reaches(end - block, excess_.data() + block, reach_.data() + block)) continue;
    for (std::size_t k = block; k < end; ++k)
      if (excess_[k] < 0.0F && reach_[k] > 0.0F) reaching_.push_back(k);
  }
  return reaching_;
}

}  // namespace flank::internal
