/// A quick estimate of the swept distance f(x) = min over t, s of |x - R(s,t)| - r(s), for planners that rank many
/// motions. The judge has its own, exact one.
#pragma once

#include <array>
#include <limits>
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
  /// of a contact by Newton steps to s = z + r' rho / sqrt(1 - r'^2). Error of third order in the spacing of the
  /// poses.
  [[nodiscard]] double distance(const Vec3& x) const { return nearest(x).f; }
  /// The same with its place: motion, t and f (s and to_axis are not filled). `hint` is a place near which it is expected, as that of a
  /// point beside x (motion -1: none); it saves time and changes nothing.
  [[nodiscard]] SweptContact nearest(const Vec3& x, const SweptContact& hint = {}) const;
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
  [[nodiscard]] double spacing() const { return 1.0 / (static_cast<double>(tracks_.front().poses.size()) - 1.0); }

 private:
  /// The tabulated poses of a motion.
  struct Track {
    std::vector<Pose> poses;
    std::array<std::vector<double>, 6> columns;  ///< of the same: tip and axis, a column a coordinate
    /// Of every kBlock poses: no point of the axis is farther from where it is at the middle one.
    std::vector<double> reach;
    double stride = 0.0;  ///< no point of the axis moves farther from one pose to the next
  };
  /// A tabulated pose and its f.
  struct Tabulated {
    std::size_t at = 0;
    double f = std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] static Track make_track(const RuledMotion& motion, int poses);
  /// f of the spheres of one pose; if that is above `most`, some value above it.
  [[nodiscard]] double at_pose(const Pose& pose, const Vec3& x,
                               double most = std::numeric_limits<double>::infinity()) const;
  /// At most at_pose, for a fraction of its time: what lies beyond a bound need not be known better.
  [[nodiscard]] double floor_at(const Pose& pose, const Vec3& x) const;
  /// Squares of the distances from the axes of a block's poses.
  void squares(const Track& track, std::size_t block, const Vec3& x, double* out) const;
  /// visit(pose) of all poses where f may be at most `most`, ascending, and maybe of others; `most` may fall meanwhile.
  template <class Visit>
  void visit_near(const Track& track, const Vec3& x, const double& most, const Visit& visit) const;
  /// The pose of least f, if that is below `bound.f`; else `bound`.
  [[nodiscard]] Tabulated nearest_pose(const Track& track, const Vec3& x, const Tabulated& bound) const;
  /// The same where nothing is known yet.
  [[nodiscard]] Tabulated nearest_pose(const Track& track, const Vec3& x) const;
  /// The pose nearest to a hint.
  [[nodiscard]] Tabulated at_hint(const SweptContact& hint, const Vec3& x) const;
  /// The vertex of the parabola through a least pose and its neighbours: at a minimum f is smooth in t.
  [[nodiscard]] SweptContact at_vertex(std::size_t motion, const Tabulated& least, const Vec3& x) const;
  [[nodiscard]] double slack(const Track& track) const;
  [[nodiscard]] double bound(const Vec3& x, const SweptContact& hint) const;

  ContactRefiner refiner_;
  std::vector<Track> tracks_;
  /// r and r'/sqrt(1-r'^2) at a step of s, and by how much they grow to the next.
  struct Row {
    double radius = 0.0, more_radius = 0.0, slope = 0.0, more_slope = 0.0;
  };
  std::vector<Row> table_;
  double axis_length_;
  double per_length_;  ///< table intervals per mm
  double least_radius_ = 0.0, largest_radius_ = 0.0;
  double steepest_ = 0.0, cosine_ = 0.0;  ///< largest |r'| of the table, at most 1, and sqrt(1 - r'^2) there
};

}  // namespace flank::internal
