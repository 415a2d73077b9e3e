#include "flank/trochoid/stock/pose_filter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// What rounding may add: to a squared reach by its size, and by that of the largest. Candidates lie some tool radii away.
constexpr double kSpare = 1e-3, kSpareOfLargest = 1e-4;

/// Bands over which the rings of a group may spread, and how far from the middle's band those of an upright tool may then be.
constexpr int kGroupBands = 32, kGroupReach = kGroupBands / 2 + 2;

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
  float swing;  ///< of a group's heights about its middle, in bands
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
    const float most = swing[k] + look.swing, up = band + most, down = band - most;
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

struct GroupLook {
  float half_z, spare;  ///< of its heights and radii, mm
};

/// Adds what the rings of a group are off its middle, seen from candidates that reach it at all.
FLANK_LANES void add_group(std::size_t count, const GroupLook& group, const float* __restrict slope,
                           float* __restrict reach) {
  const float half_z = group.half_z, spare = group.spare;
  for (std::size_t k = 0; k < count; ++k) {
    const float there = reach[k] > 0.0F ? 1.0F : 0.0F;
    reach[k] = there * (reach[k] + (spare + half_z * slope[k]));
  }
}

struct TakenPoses {
  std::array<const double*, 6> from;  ///< as SeenPoses has them
  float *x, *y, *dx, *dy, *band, *band_by_z, *slope, *leaning, *swing;
};

struct Tool {
  double low, per_mm, largest;
};

FLANK_LANES void take_poses(std::size_t count, const Tool& tool, const TakenPoses& poses) {
  const double *__restrict x0 = poses.from[0], *__restrict y0 = poses.from[1], *__restrict by_x = poses.from[2],
                          *__restrict by_y = poses.from[3], *__restrict h0 = poses.from[4],
                          *__restrict dh = poses.from[5];
  const double low = tool.low, per_mm = tool.per_mm, most = (1.0 + kSpare) * tool.largest;
  float* __restrict x = poses.x, * __restrict y = poses.y, * __restrict dx = poses.dx, * __restrict dy = poses.dy;
  for (std::size_t k = 0; k < count; ++k) {
    x[k] = static_cast<float>(x0[k]);
    y[k] = static_cast<float>(y0[k]);
    dx[k] = static_cast<float>(by_x[k]);
    dy[k] = static_cast<float>(by_y[k]);
  }
  float *__restrict band = poses.band, *__restrict band_by_z = poses.band_by_z, *__restrict leaning = poses.leaning,
                   *__restrict swing = poses.swing, *__restrict slopes = poses.slope;
  for (std::size_t k = 0; k < count; ++k) {
    band[k] = static_cast<float>((h0[k] - low) * per_mm);
    band_by_z[k] = static_cast<float>(dh[k] * per_mm);
    // At least the slope and how much of the tool's width it adds, without their roots.
    const double wide = std::abs(by_x[k]), narrow = std::abs(by_y[k]);
    const double slope = (wide < narrow ? narrow : wide) + 0.5 * (wide < narrow ? wide : narrow);
    const double slope2 = by_x[k] * by_x[k] + by_y[k] * by_y[k], reach = most * (1.0 + 0.5 * slope2);
    slopes[k] = static_cast<float>(slope);
    const double leans = slope2 > kLeaning * kLeaning ? 1.0 : 0.0;
    leaning[k] = static_cast<float>(leans * reach);
    swing[k] = static_cast<float>(leans * (1.0 + reach * slope * per_mm));
  }
}

/// 1: it reaches what is open.
FLANK_LANES void mark_reaching(std::size_t count, const float* __restrict excess, const float* __restrict reach,
                               std::uint8_t* __restrict mark) {
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t there = reach[k] > 0.0F ? 1 : 0, covers = excess[k] < 0.0F ? 1 : 0;
    mark[k] = static_cast<std::uint8_t>(there & covers);
  }
}

}  // namespace

PoseFilter::PoseFilter(const ToolProfile& profile) : largest_(profile.largest()) {
  const double width = (profile.high() - profile.low()) / kBands;
  low_ = profile.low() - 2.0 * width;
  per_mm_ = 1.0 / width;
  // Radii at the bands' borders and between; the profile is smooth but for its ends, where it falls to nothing.
  constexpr int kBetween = 4;
  const auto radius = [&](double band) {
    const double height = low_ + band * width;
    ToolProfile::Place place;
    if (!profile.at(height, place)) return 0.0;
    if (height >= profile.flank_low() && height <= profile.flank_high()) return place.radius;
    // Of what hardly leans the disc of a round end lies so much beside where its axis meets the plane.
    return place.radius + kLeaning * std::abs(height - profile.round_end(height).centre);
  };
  for (int band = 0; band < kBands + 4; ++band) {
    double most = 0.0;
    for (int k = -1; k <= kBetween + 1; ++k) most = std::max(most, radius(band + static_cast<double>(k) / kBetween));
    const double spare2 = kSpare * most * most + kSpareOfLargest * largest_ * largest_;
    bands_.push_back(most > 0.0 ? static_cast<float>(std::sqrt(most * most + spare2)) : 0.0F);
  }
  group_height_ = kGroupBands * width;
  const int count = static_cast<int>(bands_.size());
  for (int band = 0; band < count; ++band) {
    const auto first = bands_.begin() + std::max(0, band - kGroupReach);
    group_bands_.push_back(*std::max_element(first, bands_.begin() + std::min(count, band + kGroupReach + 1)));
  }
}

void PoseFilter::resize(std::size_t count) {
  for (std::vector<float>* values :
       {&x_, &y_, &dx_, &dy_, &band_, &band_by_z_, &slope_, &leaning_, &swing_, &x_at_, &y_at_, &reach_, &excess_})
    values->resize(count);
  place_.resize(count);
}

void PoseFilter::take(std::span<const NearPose> candidates) {
  std::array<const double*, 6> from{};
  for (std::size_t c = 0; c < from.size(); ++c) {
    lanes_[c].resize(candidates.size());
    from[c] = lanes_[c].data();
  }
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const NearPose& pose = candidates[k];
    lanes_[0][k] = pose.x0, lanes_[1][k] = pose.y0, lanes_[2][k] = pose.dx;
    lanes_[3][k] = pose.dy, lanes_[4][k] = pose.h0, lanes_[5][k] = pose.dh;
  }
  take(candidates.size(), from);
}

void PoseFilter::take(const SeenPoses& candidates) {
  std::array<const double*, 6> from{};
  for (std::size_t c = 0; c < from.size(); ++c) from[c] = candidates.lane(c);
  take(candidates.count(), from);
}

void PoseFilter::take(std::size_t count, const std::array<const double*, 6>& from) {
  resize(count);
  take_poses(count, {low_, per_mm_, largest_},
             {from, x_.data(), y_.data(), dx_.data(), dy_.data(), band_.data(), band_by_z_.data(), slope_.data(),
              leaning_.data(), swing_.data()});
}

void PoseFilter::take(const PoseFilter& from, std::span<const std::size_t> which) {
  resize(which.size());
  for (std::size_t k = 0; k < which.size(); ++k) {
    const std::size_t other = which[k];
    x_[k] = from.x_[other], y_[k] = from.y_[other], dx_[k] = from.dx_[other], dy_[k] = from.dy_[other];
    band_[k] = from.band_[other], band_by_z_[k] = from.band_by_z_[other], slope_[k] = from.slope_[other];
    leaning_[k] = from.leaning_[other], swing_[k] = from.swing_[other];
  }
}

void PoseFilter::find_reaches(double z) {
  const std::size_t count = x_.size();
  const auto height = static_cast<float>(z), last = static_cast<float>(bands_.size() - 1);
  at_height(count, height, x_.data(), dx_.data(), x_at_.data());
  at_height(count, height, y_.data(), dy_.data(), y_at_.data());
  leaning_reaches(count, {height, last, 0.0F}, band_.data(), band_by_z_.data(), leaning_.data(), swing_.data(),
                  place_.data(), reach_.data());
  upright_reaches(count, bands_.data(), place_.data(), reach_.data());
}

void PoseFilter::find_reaches(const RingGroup& group) {
  constexpr double kSpareMm = 1e-3;
  FLANK_ASSERT(2.0 * group.half_z <= 1.001 * group_height_);
  const std::size_t count = x_.size();
  const auto height = static_cast<float>(group.z), last = static_cast<float>(bands_.size() - 1);
  at_height(count, height, x_.data(), dx_.data(), x_at_.data());
  at_height(count, height, y_.data(), dy_.data(), y_at_.data());
  // Of leaning tools heights go by up to twice as fast.
  const auto swing = static_cast<float>(2.0 * group.half_z * per_mm_);
  leaning_reaches(count, {height, last, swing}, band_.data(), band_by_z_.data(), leaning_.data(), swing_.data(),
                  place_.data(), reach_.data());
  upright_reaches(count, group_bands_.data(), place_.data(), reach_.data());
  add_group(count, {static_cast<float>(group.half_z), static_cast<float>(group.half_radius + kSpareMm)}, slope_.data(),
            reach_.data());
}

const std::vector<std::size_t>& PoseFilter::find_reaching(double radius, std::span<const OpenArc> arcs) {
  const std::size_t count = x_.size();
  std::fill(excess_.begin(), excess_.end(), std::numeric_limits<float>::infinity());
  const auto beside = static_cast<float>(-kSpare * radius * (radius + largest_));
  for (const OpenArc& arc : arcs)
    add_excess(
        count,
        {arc.from.cast<float>(), arc.to.cast<float>(), static_cast<float>(radius), beside, arc.wide ? 1.0F : 0.0F},
        x_at_.data(), y_at_.data(), reach_.data(), excess_.data());
  reaching_.clear();
  // Most do not: marks are looked at several at a time, and those after the last are none.
  std::uint64_t some = 0;
  marks_.assign(count + sizeof some, 0);
  mark_reaching(count, excess_.data(), reach_.data(), marks_.data());
  for (std::size_t block = 0; block < count; block += sizeof some) {
    std::memcpy(&some, marks_.data() + block, sizeof some);
    for (std::size_t k = block; some != 0 && k < block + sizeof some; ++k)
      if (marks_[k] != 0) reaching_.push_back(k);
  }
  return reaching_;
}

const std::vector<std::size_t>& PoseFilter::reaching(const ToolRing& ring, std::span<const OpenArc> arcs) {
  find_reaches(ring.z);
  return find_reaching(ring.radius, arcs);
}

const std::vector<std::size_t>& PoseFilter::reaching(const RingGroup& group, std::span<const OpenArc> arcs) {
  find_reaches(group);
  return find_reaching(group.radius, arcs);
}

}  // namespace flank::internal
