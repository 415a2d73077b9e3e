/// What one strip machines: the samples of the target that its swept tool leaves within tolerance.
#pragma once

#include <vector>

#include "flank/cover/line_fit.h"
#include "flank/motion/ruled_motion.h"
#include "flank/surface/target.h"
#include "flank/tool/radial_function.h"

namespace flank {

/// Samples of the target by which strips are measured, chosen and reported.
struct CoverSamples {
  std::vector<SurfaceSample> cells;  ///< middles of cells; areas in mm^2
  double area = 0.0;                 ///< sum over the cells
};
[[nodiscard]] CoverSamples cover_samples(const Target& target, double spacing_mm);

/// Overcut is certified to this share of the tolerance: what lies between the samples has the rest.
inline constexpr double kCertifiedShare = 0.96;

/// Depth of the tool in the target along a motion, max over s of r(s) - d(R(s, t)) with d the distance of the trimmed
/// target, at equal steps of t. Where the swept tool cuts deepest into a face it does so by one of its spheres, so this
/// is the overcut itself; and it varies slowly along s and t, where f varies quickly over the face near the ends of the
/// axis.
[[nodiscard]] std::vector<double> depths_along(LineFitter& fitter, const RuledMotion& motion, int poses);
/// Steps of t that see every wave that the rails can make.
[[nodiscard]] int depth_poses(const RuledMotion& motion);

/// A strip as a motion, measured.
struct CoverStrip {
  RuledMotion motion;
  std::vector<int> cells;   ///< within tolerance, ascending
  double overcut_mm = 0.0;  ///< largest depth along the motion
  double area = 0.0;        ///< mm^2, of `cells`
};

/// Motion through the poses of a strip (5 or more), by chord length; at most `control_points` a rail.
[[nodiscard]] RuledMotion motion_through(const std::vector<Pose>& poses, double axis_length, int control_points);

/// f at the samples by the planner's estimate (swept_estimate.h); overcut along the motion.
[[nodiscard]] CoverStrip measure_strip(const CoverSamples& samples, RuledMotion motion, const RadialFunction& radial,
                                       LineFitter& fitter);

/// The part of a motion over [t0, t1], as a motion over [0, 1].
[[nodiscard]] RuledMotion part_of_motion(const RuledMotion& motion, double t0, double t1);

}  // namespace flank
