/// What a cutter feels at any feed, and how fast it may be fed (docs/MATH.md, section 18).
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "flank/machine/cutting/cutting_force.h"

namespace flank::internal {

struct CutterLoad {
  double chip_mm = 0.0;        ///< the thickest
  double force_n = 0.0;        ///< the largest of a turn
  double power_w = 0.0;        ///< the mean of a turn
  double deflection_mm = 0.0;  ///< of the tip across the axis, the largest of a turn
};

struct LoadLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double chip_mm = kNone, force_n = kNone, power_w = kNone, deflection_mm = kNone;
};

enum class LoadKind { kNone, kChip, kForce, kPower, kDeflection };

struct FeedBound {
  double feed = 0.0;  ///< mm/s; 0: at any feed the edges alone exceed a limit
  LoadKind by = LoadKind::kNone;
};

/// At one place of a path. Chips grow with the feed, forces with the chips, from what the edges ask at no chip at all: so a turn is
/// computed once, and every feed is told from that.
class FeedLoad {
 public:
  /// `per_mm`: the motion for every mm of the way that the feed is of. `coefficients`: about the chips that are expected. `compliance`: of each
  /// ring, how far a force of one newton across the axis there moves the tip, mm/N. Of a turn the instants of peak_phases are looked at.
  FeedLoad(const RotatingCutter& cutter, const CutterMotion& per_mm, const ForceCoefficients& coefficients,
           std::span<const double> compliance, int even = 24);

  /// `feed` in mm/s.
  [[nodiscard]] CutterLoad at(double feed) const;
  /// The fastest feed, at most `most`, at which no limit is exceeded, and which of them holds it.
  [[nodiscard]] FeedBound fastest(const LoadLimits& limits, double most) const;

 private:
  /// By the feed, and without one.
  template <class Value>
  struct Affine {
    Value slope, rest;
  };
  double chip_ = 0.0;  ///< by the feed
  Affine<double> power_{0.0, 0.0};
  std::vector<Affine<Vec3>> force_;
  std::vector<Affine<Vec2>> deflection_;
};

}  // namespace flank::internal
