/// The variational fit as a least-squares model (MATH section 7; paper A (8)-(12), with the rigidity of section 2 built
/// in).
///
/// Residuals e_ij = d(R(s_j, t_i)) - r(s_j) over a grid of every motion, against that motion's target; one tool for
/// all. The cost is a mean of squares in mm^2, so every weight below is a plain number against 1 for the residuals, and
/// all but fairness mean the same on a grid of any size.
///
/// What a regulariser can cost: at the minimum the whole cost is at most that of the true motion. So if the target is
/// an exact envelope, a term of weight w that is off by e at the truth leaves a residual of at most sqrt(w) e (root
/// mean square). The weights of the passes (stages.cpp) are chosen by this bound.
#pragma once

#include <array>
#include <vector>

#include "flank/envelope/swept_estimate.h"
#include "flank/fit.h"
#include "flank/fit/solver/arrow_system.h"
#include "flank/obstacle_field.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

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
  /// > 0, no unit: the pass ends after two steps in a row that lower the cost by less than this share of it.
  double step_tolerance = 1e-9;
};

/// The distance from a point of the axis to the obstacles, kept between steps: a place nearby is as far from them,
/// less how far it is from `at`.
struct ObstacleSample {
  ObstacleDistance nearest;  ///< here, by its gradient where that is good enough
  double measured_mm = 0.0;  ///< the distance where it was measured
  Vec3 at = Vec3::Zero();    ///< that place, mm
  bool known = false;        ///< false: never measured
};

/// Everything that changes during a fit. Footpoints, obstacles and contacts are caches of the last `locate`: they are
/// hints for the next one, and wrong for anything else once motions or tool have changed.
struct FitState {
  std::vector<RuledMotion> motions;                    ///< control points are the unknowns
  RadialFunction tool;                                 ///< its free parameters are the others
  std::vector<std::vector<Footpoint>> feet;            ///< of a FitModel: [motion][i * samples_s + j]
  std::vector<std::vector<ObstacleSample>> obstacles;  ///< [motion][i * samples_s + j]; empty without obstacles
  std::vector<SweptContact> contacts;                  ///< of a SweptModel: of each of its points
};

/// The model: what stays the same during a pass. Immutable after construction; targets and obstacles are not owned.
/// The order of calls for a state is locate, then anything else.
class FitModel {
 public:
  /// free_parameters: indices of the tool's parameters that may change (none: the tool is given). The motions' rails
  /// must be clamped cubic over [0, 1] with stage.control_points control points each, all of one axis length. obstacles:
  /// of each motion, or none. Anchors and pins hold to `start`.
  FitModel(std::vector<const Target*> targets, const FitState& start, std::vector<int> free_parameters,
           const RadiusBounds& bounds, const FitStage& stage, std::vector<const ObstacleField*> obstacles = {});

  /// An empty system of the right size.
  [[nodiscard]] ArrowSystem make_system() const;
  /// Footpoints of all samples, warm from state.feet if it has them, else marched from one cold query per motion.
  void locate(FitState& state) const;
  /// The part of `locate` that belongs to obstacles.
  void locate_obstacles(FitState& state) const;
  /// Weight of each sample at this state, [motion][i * samples_s + j]: its share of the mean, by location (inside or
  /// past the border), robust scale and sign. They add up to at most 1 without overcut_weight.
  [[nodiscard]] std::vector<std::vector<double>> sample_weights(const FitState& state) const;
  /// Sum of all weighted squares, regularisers included, for frozen sample weights; mm^2.
  [[nodiscard]] double cost(const FitState& state, const std::vector<std::vector<double>>& weights) const;
  /// Gauss-Newton normal equations at the state (half of the cost's gradient and second derivative). Clears the system
  /// first. The derivative takes a footpoint's normal as constant, which is exact for a distance.
  void assemble(const FitState& state, const std::vector<std::vector<double>>& weights, ArrowSystem& system) const;
  /// State after a step in the system's unknowns; footpoints are kept as hints only.
  [[nodiscard]] FitState moved(const FitState& state, const Eigen::VectorXd& step) const;

  /// The terms that do not look at the targets: fairness, anchors, pins, the tool's bounds, obstacles.
  [[nodiscard]] double regulariser_cost(const FitState& state) const;
  /// Adds them to the normal equations.
  void assemble_regularisers(const FitState& state, ArrowSystem& system) const;
  /// Gradient of r(s) by the free parameters of the tool.
  [[nodiscard]] Eigen::VectorXd tool_gradient(const RadialFunction& tool, double s) const;

  /// d - r of a sample of a located state, mm: > 0 material left, < 0 overcut; without dead zone.
  [[nodiscard]] double residual(const FitState& state, int motion, int i, int j) const;
  /// The axis point of sample i in time, j along the axis, mm.
  [[nodiscard]] Vec3 point(const FitState& state, int motion, int i, int j) const;
  [[nodiscard]] const Target& target(int motion) const { return *targets_[static_cast<std::size_t>(motion)]; }
  [[nodiscard]] int samples_t() const { return stage_.samples_t; }
  [[nodiscard]] int samples_s() const { return stage_.samples_s; }
  [[nodiscard]] const FitStage& stage() const { return stage_; }

 private:
  struct TimeSample {
    double t;
    int first;
    /// Values of the four active basis functions, their derivatives, and their second derivatives times the squared step
    /// in time.
    std::array<double, 4> basis, basis_d1, basis_d2;
  };
  /// The start's axis at one time: its middle and that point's unit transversal velocity, its tip and direction; and
  /// which way it goes on, averaged over the times around it.
  struct Anchor {
    Vec3 middle, tangent, tip, axis, way;
  };
  /// A pose with the direction rail's own value w, u = w / |w|.
  struct PoseAt {
    Vec3 tip, w, u;
    double length_w;
  };

  [[nodiscard]] PoseAt pose_at(const RuledMotion& motion, const TimeSample& time) const;
  /// Derivative of a sample's distance by tip and by axis_length times w.
  [[nodiscard]] Vec6 row(const PoseAt& pose, double s, const Footpoint& foot) const;
  /// Adds sum of w_ij g g' and of factor_ij g of one motion's residual rows.
  void assemble_rows(const FitState& state, int motion, const std::vector<double>& weights,
                     const std::vector<double>& gradient_factors, ArrowSystem& system) const;
  /// tool_gradient at all s_j: free parameters x samples_s.
  void tool_gradients(const FitState& state, Eigen::MatrixXd& gradients) const;
  void assemble_rails(const FitState& state, int motion, ArrowSystem& system) const;
  void assemble_tool(const FitState& state, ArrowSystem& system) const;
  /// By how much the ball of a sample enters an obstacle beyond the allowance, mm; 0 if it is clear.
  [[nodiscard]] double intrusion(const FitState& state, std::size_t motion, std::size_t k, double radius) const;
  [[nodiscard]] double obstacle_weight() const;
  [[nodiscard]] double obstacle_cost(const FitState& state) const;
  void assemble_obstacles(const FitState& state, ArrowSystem& system) const;
  [[nodiscard]] double rail_cost(const FitState& state, int motion) const;
  /// By how much the points of the axis plunge at one time: visit(s, Plunge).
  template <class Visit>
  void visit_plunges(const RuledMotion& rails, const TimeSample& time, const Vec3& axis, const Visit& visit) const;
  /// By how much they lag, and that by their velocity: visit(s, mm, gradient).
  template <class Visit>
  void visit_lags(const RuledMotion& rails, int motion, std::size_t time, const Visit& visit) const;
  /// Anchors and mean speeds of one motion of the start.
  void add_anchors(const RuledMotion& motion);
  [[nodiscard]] double tool_cost(const FitState& state) const;

  std::vector<const Target*> targets_;
  std::vector<const ObstacleField*> obstacles_;  ///< of each motion; empty: none has any
  std::vector<int> free_;
  RadiusBounds bounds_;
  FitStage stage_;
  double axis_length_;
  std::vector<TimeSample> times_;
  std::vector<double> s_, bound_places_;  ///< samples of the axis; where the tool's bounds are asked
  std::vector<std::vector<Anchor>> anchors_;
  std::vector<std::vector<double>> speeds_;  ///< [motion][j]: mean speed of the axis' point s_j along the way, >= 0
  std::vector<double> start_radius_, start_slope_;  ///< r(s_j) and r'(s_j) at the start
  int tool_parameters_;
};

/// Gradient of the signed distance at p, a unit vector: the footpoint's normal, or for a border footpoint the direction
/// between it and p (its normal if p lies on the border, where the distance has no gradient).
[[nodiscard]] Vec3 distance_gradient(const Vec3& p, const Footpoint& foot);

}  // namespace flank::internal
