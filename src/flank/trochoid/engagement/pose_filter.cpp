#include "flank/trochoid/engagement/pose_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

/// What rounding may add: to a squared reach by its size, and by that of the largest. Candidates lie some tool radii away.
constexpr double kSpare = 1e-3, kSpareOfLargest = 1e-4;

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

void PoseFilter::take(std::span<const NearPose> candidates, bool first_look) {
  const std::size_t from = first_look ? 0 : x_.size();
  for (std::vector<float>* values :
       {&x_, &y_, &dx_, &dy_, &band_, &band_by_z_, &leaning_, &x_at_, &y_at_, &reach_, &excess_})
    values->resize(candidates.size());
  place_.resize(candidates.size());
  for (std::size_t k = from; k < candidates.size(); ++k) {
    const NearPose& c = candidates[k];
    const double slope2 = c.slope2();
    x_[k] = static_cast<float>(c.x0);
    y_[k] = static_cast<float>(c.y0);
    dx_[k] = static_cast<float>(c.dx);
    dy_[k] = static_cast<float>(c.dy);
    band_[k] = static_cast<float>((c.h0 - low_) * per_mm_);
    band_by_z_[k] = static_cast<float>(c.dh * per_mm_);
    leaning_[k] =
        slope2 > kLeaning * kLeaning ? static_cast<float>((1.0 + kSpare) * largest_ * std::sqrt(1.0 + slope2)) : 0.0F;
  }
}

void PoseFilter::find_reaches(double z) {
  const std::size_t count = x_.size();
  const auto height = static_cast<float>(z), last = static_cast<float>(bands_.size() - 1);
  // As below: plain arrays and no branch. The table is looked up in a loop of its own, one candidate at a time.
  const float *x = x_.data(), *y = y_.data(), *dx = dx_.data(), *dy = dy_.data();
  const float *first = band_.data(), *by_z = band_by_z_.data(), *leaning = leaning_.data(), *bands = bands_.data();
  float *x_at = x_at_.data(), *y_at = y_at_.data(), *reach = reach_.data();
  std::int32_t* place = place_.data();
  for (std::size_t k = 0; k < count; ++k) x_at[k] = x[k] + height * dx[k];
  for (std::size_t k = 0; k < count; ++k) y_at[k] = y[k] + height * dy[k];
  for (std::size_t k = 0; k < count; ++k) {
    const float band = first[k] + height * by_z[k], above = band > 0.0F ? band : 0.0F;
    place[k] = static_cast<std::int32_t>(above < last ? above : last);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const float radius = bands[place[k]];
    reach[k] = leaning[k] < radius ? radius : leaning[k];
  }
}

const std::vector<std::size_t>& PoseFilter::reaching(const ToolRing& ring, std::span<const OpenArc> arcs) {
  const std::size_t count = x_.size();
  find_reaches(ring.z);
  std::fill(excess_.begin(), excess_.end(), std::numeric_limits<float>::infinity());
  const auto radius = static_cast<float>(ring.radius);
  const auto beside = static_cast<float>(-kSpare * ring.radius * (ring.radius + largest_));
  // Plain arrays and no branch, so that compilers look at several candidates at once.
  const float *x = x_at_.data(), *y = y_at_.data(), *reach = reach_.data();
  float* excess = excess_.data();
  for (const OpenArc& arc : arcs) {
    const Eigen::Vector2f from = arc.from.cast<float>(), to = arc.to.cast<float>();
    const float fx = from.x(), fy = from.y(), tx = to.x(), ty = to.y(), whole = arc.wide ? 1.0F : 0.0F;
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
  // Written in any case, and kept where it counts: whether it does is hard to foresee.
  reaching_.resize(count);
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    reaching_[found] = k;
    found += static_cast<std::size_t>(excess[k] < 0.0F) & static_cast<std::size_t>(reach[k] > 0.0F);
  }
  reaching_.resize(found);
  return reaching_;
}

}  // namespace flank::internal
