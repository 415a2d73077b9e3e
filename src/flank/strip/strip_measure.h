/// What one strip machines: the samples of the target that its swept tool leaves within tolerance.
#pragma once

#include <vector>

#include "flank/envelope/swept_estimate.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/strip/line_fit.h"
#include "flank/target.h"

namespace flank::internal {

/// Samples of the target by which strips are measured, chosen and reported.
struct CoverSamples {
  std::vector<SurfaceSample> cells;  ///< middles of cells; areas in mm^2
  std::vector<Vec3> border;          ///< points of the border, closer to each other than the cells
  double area = 0.0;                 ///< sum over the cells
};
[[nodiscard]] CoverSamples cover_samples(const Target& target, double spacing_mm);

/// Overcut is certified to this share of the tolerance: what lies between the samples has the rest.
inline constexpr double kCertifiedShare = 0.94;

/// Steps of t that see every wave that the rails can make.
[[nodiscard]] int depth_poses(const RuledMotion& motion);

/// A strip as a motion, measured.
struct CoverStrip {
  RuledMotion motion;
  std::vector<int> cells;  ///< within tolerance, ascending
  double area = 0.0;       ///< mm^2, of `cells`
  /// Depth of the tool in the target at equal steps of t, depth_poses(motion) of them; the largest of two. Where the swept
  /// tool cuts deepest into the inside of a face it does so by one of its spheres: max over s of r(s) - d(R(s, t)), which
  /// varies slowly along s and t, while f over the face has narrow ridges beside the ends of the axis. Where it runs over
  /// the border, over corners above all, or over a ripple narrower than the samples of the axis, that is the other way
  /// round: -f at the points of the border and of the inside.
  std::vector<double> depths;
  double overcut_mm = 0.0;  ///< the largest of them
  std::vector<SweptContact>
      deep;  ///< contacts of points of the target that are about as deep as the tolerance, or more
};

/// How often each cell is covered.
class CellCount {
 public:
  explicit CellCount(const CoverSamples& samples) : samples_(samples), counts_(samples.cells.size()) {}
  void add(const CoverStrip& strip, int sign = 1) {
    for (const int k : strip.cells) counts_[static_cast<std::size_t>(k)] += sign;
  }
  /// Share of the area that the strip covers and nothing else does.
  [[nodiscard]] double gain(const CoverStrip& strip) const {
    double area = 0.0;
    for (const int k : strip.cells)
      if (counts_[static_cast<std::size_t>(k)] == 0) area += samples_.cells[static_cast<std::size_t>(k)].area;
    return area / samples_.area;
  }
  /// Cells that nothing covers.
  [[nodiscard]] std::vector<std::size_t> open() const {
    std::vector<std::size_t> cells;
    for (std::size_t k = 0; k < counts_.size(); ++k)
      if (counts_[k] == 0) cells.push_back(k);
    return cells;
  }
  [[nodiscard]] double covered() const {
    double area = 0.0;
    for (std::size_t k = 0; k < counts_.size(); ++k)
      if (counts_[k] > 0) area += samples_.cells[k].area;
    return area / samples_.area;
  }

 private:
  const CoverSamples& samples_;
  std::vector<int> counts_;
};

/// Motion through the poses of a strip (5 or more), by chord length; at most `control_points` a rail.
[[nodiscard]] RuledMotion motion_through(const std::vector<Pose>& poses, double axis_length, int control_points);

/// f at the samples by the planner's estimate (swept_estimate.h); depths along the motion.
[[nodiscard]] CoverStrip measure_strip(const CoverSamples& samples, RuledMotion motion, const RadialFunction& radial,
                                       LineFitter& fitter);

/// The part of a motion over [t0, t1], as a motion over [0, 1].
[[nodiscard]] RuledMotion part_of_motion(const RuledMotion& motion, double t0, double t1);

}  // namespace flank::internal
