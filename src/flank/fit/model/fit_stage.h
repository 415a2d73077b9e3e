/// One pass of the fit in numbers (MATH section 7).
///
/// What a regulariser can cost: at the minimum the whole cost is at most that of the true motion. So if the target is
/// an exact envelope, a term of weight w that is off by e at the truth leaves a residual of at most sqrt(w) e (root
/// mean square). The weights of the passes (stages.cpp) are chosen by this bound.
#pragma once

namespace flank::internal {

/// Weights and sizes of one pass of the fit. Weights have no unit: they multiply mean squares of lengths in mm. The
/// defaults are those of a least-squares pass on a good start (MATH section 7); the passes that the fit runs are the
/// presets of stages.h.
struct FitStage {
  /// Grid over every motion: times and places along the axis, both >= 2, ends included. The resolution of the papers.
  /// More than twice as many times as control points, else the rails can swing between samples. Time per step grows in
  /// proportion.
  int samples_t = 100, samples_s = 30;
  /// Per rail, >= 4 (cubic). More follow a face that bends more often; each makes room for waves that only `fairness`
  /// stops.
  int control_points = 24;
  /// Of a free tool's spline, >= 4; not used if the tool is given or of a family. More follow a finer meridian.
  int tool_coefficients = 12;
  /// Accepted steps at most, >= 0. A pass from a good start converges earlier, by step_tolerance.
  int iterations = 30;
  /// >= 0: of second differences, from sample to sample in time, of tip rail and axis_length times direction rail (A
  /// (11)). A second difference falls as 1 / samples_t^2, so the same value is (n1 / n2)^4 times softer on n1 samples
  /// than on n2. 1e-4 to 1e-3 on exact data, 1e-2 to 1e-1 otherwise; nearly 0 for the last digits of an exact
  /// envelope.
  double fairness = 1e-3;
  /// >= 0: of second differences of a free tool's coefficients, mm. Holds r where no footpoint counts; raise it if the
  /// profile waves.
  double tool_fairness = 1e-6;
  /// >= 0: of the drift of the axis' middle along its transversal velocity at the start. Against the collapse to a
  /// motion that stands still, which makes every residual zero. Motion along the path only changes its timing, so even
  /// 1 biases nothing; low values let a start that is off find its way.
  double transversal_anchor = 1e-2;
  /// >= 0: of the slide of the tip along the axis since the start. Without it a cone or cylinder slides on itself; 1e-3
  /// is too stiff for the final passes, 1e-6 and less is not (MATH section 7).
  double axial_pin = 1e-3;
  /// >= 0: of r(s) - r_start(s). Shifting tool and axis together hardly changes the residuals (nearly a gauge freedom);
  /// a small weight stops that drift. 0 if something else fixes the radius.
  double radius_pin = 0.0;
  /// In [0, 1]: factor on samples whose footpoint is past the target's border, where the surface is only extrapolated.
  /// Not 0 unless the motion is nearly right: samples that do not count invite the pose to leave the face.
  double extension_weight = 0.05;
  /// mm, >= 0: Geman-McClure scale c of samples inside the target: their weight is 1 / (1 + e^2 / c^2)^2, a quarter at
  /// e = c. 0: plain least squares. Set it for starts that touch only part of the face, not for a final pass: it hides
  /// overcut. Of a SweptModel: of material left (f > 0) alone.
  double robust_scale_mm = 0.0;
  /// mm, >= 0: the same for samples past the border.
  double extension_scale_mm = 0.0;
  /// mm, >= 0: residuals count only beyond this, as sign(e) max(0, |e| - dead zone). A little below the wanted error it
  /// turns "small on average" into "everything below it" (docs/algorithms/fit.md).
  double dead_zone_mm = 0.0;
  /// > 0: factor on the weight of residuals below zero (the tool enters the target). Above 1 if cutting too deep is
  /// worse than leaving material.
  double overcut_weight = 1.0;
  /// Ask the bounds of a free spline at its knots, too (tool_excess.h). Only for a pass that mends a tool which is none
  /// between the samples: on the way to an envelope such a bound is in the way, and a fit sticks at it.
  bool bounds_at_knots = false;
  /// >= 0: of the mean square depth by which the flank enters obstacles. MATH section 7 found 30 to 100 to work.
  double clear_weight = 30.0;
  /// Distances to obstacles by interpolation (ObstacleField::estimate): faster, good enough for ranking starts.
  bool clear_estimated = false;
  /// >= 1: at every so many samples along the path, obstacles are asked for. Their distance changes slowly along it, and
  /// to measure it costs more than all else of a sample.
  int clear_stride = 1;
  /// >= 0: of the mean square by which points of the axis plunge (plunge.h), velocities counted for the whole motion.
  /// Axis and slopes are those of the start. 1e-4 outweighs what plunging saves on a face that can be had without; 0 where
  /// the motion is known.
  double plunge_weight = 0.0;
  /// >= 0: of the mean square by which points of the axis lag: move along the start's way by less than kLeastSpeed of
  /// their mean speed, velocities counted for the whole motion. Where a motion stands still, the axis can rock and slide
  /// on the spot, and what is left over is cut by that and not by going on.
  double lag_weight = 0.0;
  /// >= 0: of the mean square by which the axes of motions 2 k and 2 k + 1 at equal times differ along their common way, mm at
  /// the axis' upper end; each is drawn to the mean that both have at the start of the pass. Only for motions over the
  /// facing sides of a cavity: there a tool must turn on its way across by what they differ.
  double parallel_weight = 0.0;
  /// > 0, no unit: the pass ends after two steps in a row that lower the cost by less than this share of it.
  double step_tolerance = 1e-9;
};

}  // namespace flank::internal
