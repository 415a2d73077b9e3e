/// A quick estimate of the swept distance f(x) = min over t, s of |x - R(s,t)| - r(s), for planners that rank many
/// motions. The judge has its own, exact one.
#pragma once

#include <vector>

#include "flank/envelope/contact_refiner.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// Immutable after construction, for many threads at once. Keeps nothing of what it is made of.
class SweptEstimate {
 public:
  /// `poses` (>= 2) axis positions per motion are tabulated; there is at least one motion. Waves of a rail between two
  /// poses are not seen: four for each control point of a rail are enough.
  SweptEstimate(const std::vector<RuledMotion>& motions, const RadialFunction& radial, int poses);

  /// Estimate of f: least over the tabulated poses, improved by a parabola through its neighbours; the axis parameter
  /// of a contact by two fixed-point steps s = z + r' rho / sqrt(1 - r'^2). Error of third order in the spacing of the
  /// poses.
  [[nodiscard]] double distance(const Vec3& x) const { return nearest(x).f; }
  /// The same with its place: motion, t and f (s and to_axis are not filled).
  [[nodiscard]] SweptContact nearest(const Vec3& x) const;
  /// Tabulated poses that may lead to the least f: of every run of poses near the least value its best one, all motions
  /// together (motion, t and f). Between poses f can be lower by what a step along the path allows: values within that
  /// of the least count. `places` is cleared first; it stays empty only if no pose has a distance. `hint` is a place near which the least is expected (motion -1:
  /// none).
  void places(const Vec3& x, const SweptContact& hint, std::vector<SweptContact>& places) const;
  /// The contact near a place (its motion and t), within a spacing of it (ContactRefiner::refine).
  [[nodiscard]] SweptContact refine(const Vec3& x, const SweptContact& place) const {
    return refiner_.refine(x, place, spacing());
  }
  /// Spacing of the poses in t.
  [[nodiscard]] double spacing() const { return 1.0 / (static_cast<double>(poses_.front().size()) - 1.0); }

 private:
  [[nodiscard]] double at_pose(const Pose& pose, const Vec3& x) const;
  /// At most at_pose, for a quarter of its time: what lies beyond a bound need not be known better.
  [[nodiscard]] double floor_at(const Pose& pose, const Vec3& x) const;
  /// The next pose after `at` where f may be lower by more than `spare`.
  [[nodiscard]] std::size_t next_pose(std::size_t motion, std::size_t at, double spare) const;
  [[nodiscard]] std::size_t nearest_pose(std::size_t motion, const Vec3& x, double& least) const;
  [[nodiscard]] double slack(std::size_t motion) const;
  [[nodiscard]] double bound(const Vec3& x, const SweptContact& hint) const;

  ContactRefiner refiner_;
  std::vector<std::vector<Pose>> poses_;
  std::vector<double> stride_;  ///< of each motion: no point of the axis moves farther from one pose to the next
  std::vector<std::vector<double>> travel_;         ///< of each motion, up to each pose: the sum of such steps
  std::vector<double> radius_, slope_over_cosine_;  ///< r and r'/sqrt(1-r'^2) at equal steps of s
  double axis_length_;
  double per_length_;  ///< table intervals per mm
  double least_radius_ = 0.0, largest_radius_ = 0.0;
};

}  // namespace flank::internal
