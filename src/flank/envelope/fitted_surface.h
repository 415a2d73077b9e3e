/// A spline surface through points of an exact one, made finer until it is near enough.
#pragma once

#include <functional>
#include <vector>

#include "flank/bspline_surface.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// A point of the exact surface, mm, at (u, v) in [0, 1] x [0, 1].
using ExactSurface = std::function<Vec3(double u, double v)>;

/// Degree in a direction that is no straight line; places in every knot interval where the surface is held against the exact one; how
/// many control points a direction has at most before it is not made finer.
inline constexpr int kFittedDegree = 5, kFittedPlaces = 4, kMostFittedPoints = 400;

/// Where an envelope is less smooth than between: the knots of the rails, and of a spline's radial function, as shares of a
/// range of times, or of shares of the axis. Sorted, from 0 to 1.
[[nodiscard]] std::vector<double> breaks_of(const RuledMotion& motion, double from, double to);
[[nodiscard]] std::vector<double> breaks_of(const RadialFunction& radial, double from, double to);

/// Knots of one direction: every interval between breaks is cut into equal ones, as many as it needs.
class SurfaceDirection {
 public:
  SurfaceDirection(std::vector<double> breaks, int degree)
      : breaks_(std::move(breaks)), cuts_(breaks_.size() - 1, 1), degree_(degree) {}

  [[nodiscard]] int degree() const { return degree_; }
  /// Clamped.
  [[nodiscard]] std::vector<double> knots() const;
  [[nodiscard]] std::vector<double> sites() const { return greville_sites(knots(), degree_); }
  /// kFittedPlaces places in every knot interval.
  [[nodiscard]] std::vector<double> places() const;
  /// Halves the intervals where `error` is above `aim` at one of their places. Were there any?
  bool refine(const std::function<double(double)>& error, double aim);

 private:
  [[nodiscard]] std::vector<double> places(std::size_t k) const;
  [[nodiscard]] double inside(std::size_t k, double share) const {
    return breaks_[k] + (breaks_[k + 1] - breaks_[k]) * share;
  }
  std::vector<double> breaks_;
  std::vector<int> cuts_;
  int degree_;
};

struct FittedSurface {
  BSplineSurface surface;
  double deviation_mm = 0.0;  ///< largest distance found between points of the same parameters
};

/// Interpolates, and halves intervals where the surface is farther off between its points than `aim` mm until it is near
/// enough, or halving helps no more.
[[nodiscard]] FittedSurface fitted_surface(const ExactSurface& exact, SurfaceDirection along, SurfaceDirection across,
                                           double aim);

}  // namespace flank::internal
