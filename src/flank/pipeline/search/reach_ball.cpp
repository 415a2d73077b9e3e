#include "flank/pipeline/search/reach_ball.h"

#include <algorithm>
#include <cmath>

#include "flank/pipeline/search/out_of_reach.h"
#include "flank/pipeline/search/search_setup.h"
#include "flank/setup/fillet.h"

namespace flank::internal {
namespace {

/// The ball that fits into the target's own corners.
double ball_for_corners(double tolerance_mm, const Target& target, double radius) {
  FlankFitOptions alone;
  alone.tolerance_mm = tolerance_mm;
  return ball_with_room(target, alone, radius);
}

/// The ball of this radius, or the one that fits into the tightest fillet, with what is left in it.
double ball_in_fillets(const Setup& setup, double radius_mm) {
  const std::optional<double> fillet = tightest_fillet(setup.part, setup.targets, radius_mm + setup.allowance_mm);
  const double left = fillet.value_or(radius_mm + setup.allowance_mm) - setup.allowance_mm;
  return left > 0.0 ? left : radius_mm;
}

}  // namespace

void allow_thin(const FitJob& job, double ball_mm, RadiusBounds& bounds) {
  constexpr double kThinner = 0.5;  // of the largest ball that fits: room for a tip that is thinner than the rest
  if (!job.radius.min_mm && ball_mm < bounds.smallest) bounds.smallest = kThinner * ball_mm;
}

RadiusBounds bounds_for(const FitJob& job, const Target& target) {
  RadiusBounds bounds = radius_bounds(job.radius, job.obstacles, target.diagonal());
  allow_thin(job, ball_for_corners(*job.tolerance_mm, target, bounds.smallest), bounds);
  return bounds;
}

// Whole numbers are divided, so that no rounding of a unit shows.
double three_digits(double radius_mm) {
  const double decimals = 2.0 - std::floor(std::log10(radius_mm)), unit = std::pow(10.0, std::abs(decimals));
  return decimals >= 0.0 ? std::round(radius_mm * unit) / unit : std::round(radius_mm / unit) * unit;
}

double demanded_reach(const FitJob& job, const Setup& setup, const Target& target, const RadiusBounds& bounds) {
  if (job.judge.reach_radius_mm) return *job.judge.reach_radius_mm;
  return reach_of_part(setup, target, job.tool.axis_length_mm, bounds);
}

double reach_of_part(const Setup& setup, const Target& target, std::optional<double> axis_length_mm,
                     const RadiusBounds& bounds) {
  const double length = axis_length_mm.value_or(std::sqrt(target.area()));
  const double stiff = std::clamp(0.5 * length / bounds.slenderest, bounds.smallest, bounds.largest);
  const double ball = ball_in_fillets(setup, stiff);
  return three_digits(std::max(bounds.smallest, ball_for_corners(setup.tolerance_mm, target, ball)));
}

double reach_in_gap(const Setup& setup, double gap_mm) { return three_digits(ball_in_fillets(setup, gap_mm)); }

}  // namespace flank::internal
