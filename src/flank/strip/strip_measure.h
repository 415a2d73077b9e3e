/// What one strip machines: the samples of the target that its swept tool leaves within tolerance.
#pragma once

#include <vector>

#include "flank/envelope/swept_estimate.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/strip/line_fit.h"
#include "flank/target.h"

namespace flank::internal {

/// Samples of the target by which strips are measured, chosen and reported. Shares of the area are shares of `area`:
/// after cells that the tool cannot reach are left out, they are shares of the reachable part.
struct CoverSamples {
  std::vector<SurfaceSample> cells;  ///< middles of cells; areas in mm^2
  std::vector<Vec3> border;          ///< points of the border, closer to each other than the cells
  double area = 0.0;                 ///< sum over the cells, mm^2
};
/// Cells about `spacing_mm` apart, border points a quarter of that, both in a fixed order. spacing_mm > 0.
[[nodiscard]] CoverSamples cover_samples(const Target& target, double spacing_mm);

/// Number of equal steps of t that see every wave that the rails can make: eight per control point, at most 384.
[[nodiscard]] int depth_poses(const RuledMotion& motion);

/// A strip as a motion, measured.
struct CoverStrip {
  RuledMotion motion;
  std::vector<int> cells;  ///< within tolerance, ascending
  double area = 0.0;       ///< mm^2, of `cells`
  /// Depth of the tool in the target, mm, at the depth_poses(motion) + 1 ends of equal steps of t: the larger one of
  /// two. (1) By the spheres of the axis, inside the target: max over s of r(s) - d(R(s, t)), which varies slowly along
  /// s and t, while f over the face has narrow ridges beside the ends of the axis that points of the face miss. (2) By
  /// points of the target: -f at points of the border, and at cells that are nearly too deep, each at the step nearest
  /// to its t. At the border, at corners above all, and at ripples narrower than the samples of the axis, those see
  /// what (1) misses. Negative: clear by as much.
  std::vector<double> depths;
  double overcut_mm = 0.0;  ///< the largest of them
  /// Contacts of points of the target that are deeper than TargetDepthBudget::remembered tolerances: what a lift has to
  /// take out (certify.h).
  std::vector<SweptContact> deep;
};

/// How often each cell is covered. All strips must have been measured with `samples`, which must outlive this.
class CellCount {
 public:
  explicit CellCount(const CoverSamples& samples) : samples_(samples), counts_(samples.cells.size()) {}
  /// sign -1 takes a strip away again that was added before.
  void add(const CoverStrip& strip, int sign = 1) {
    for (const int k : strip.cells) counts_[static_cast<std::size_t>(k)] += sign;
  }
  /// Share of the area, in [0, 1], of the strip's cells that no counted strip covers: take it away first if it is
  /// counted.
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
  /// Share of the area that is covered at least once.
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

/// Motion near the poses of a strip, t by the mean chord length of both ends of the axis. Needs five poses or more, no
/// two in succession equal; each rail gets as many control points as there are poses, at most `control_points`. Least
/// squares: the poses are not met exactly, so what was certified at them has to be certified again.
[[nodiscard]] RuledMotion motion_through(const std::vector<Pose>& poses, double axis_length, int control_points);

/// The strip of a motion: which cells have |f| <= tolerance (fitter.options().tolerance_mm), by the planner's estimate
/// (swept_estimate.h), refined where that is close to call; depths along the motion. `fitter` is scratch of the same
/// tool.
[[nodiscard]] CoverStrip measure_strip(const CoverSamples& samples, RuledMotion motion, const RadialFunction& radial,
                                       LineFitter& fitter);

/// The part of a motion over [t0, t1], t0 < t1, as a motion over [0, 1] with as many control points. A least-squares
/// fit to 161 poses: nearly the same motion, not exactly.
[[nodiscard]] RuledMotion part_of_motion(const RuledMotion& motion, double t0, double t1);

}  // namespace flank::internal
