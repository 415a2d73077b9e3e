/// Ridges of the engagement over time and axis: it rises to the place where the front comes upon what another half has left, and falls
/// right behind it, by degrees in a fraction of a step between rows. Where that is differs from ring to ring.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace flank::internal {

/// A part of a motion's time and of its axis.
struct RidgeWindow {
  double t_low = 0.0, t_high = 0.0, s_low = 0.0, s_high = 0.0;
};

/// Times of a motion begin here: in its very first pose a half may have nothing to cut, and all of it right after.
inline constexpr double kFirstTime = 1e-5;

/// So many times of a window are asked: two on either side of a crest, and some to find it between.
inline constexpr std::size_t kRidgeTimes = 7;
using RingTimes = std::array<double, kRidgeTimes>;  ///< what a ring engages at them, radians

/// Where a ring engages most, and how much, as far as a few times tell.
struct Crest {
  double angle_rad = 0.0, t = 0.0;
};

/// Of times from `first` on, `step` apart. Both flanks of a ridge are nearly straight: where two lines meet that go on from two times
/// before and two times behind, there is the crest.
[[nodiscard]] Crest crest_of(const RingTimes& angles, double first, double step);

/// The crests of rings at equal steps of a window.
struct Ridge {
  RidgeWindow window;
  std::vector<Crest> crests;
  /// Rings whose crests are higher than those beside, the highest first.
  [[nodiscard]] std::vector<std::size_t> tops() const;
  /// Place of a ring on the axis, mm.
  [[nodiscard]] double s_of(std::size_t ring) const;
  /// Around the crest of a ring, as far as the rings beside it and their crests; ends of the window are none of the ridge.
  [[nodiscard]] RidgeWindow around(std::size_t ring) const;
};

}  // namespace flank::internal
