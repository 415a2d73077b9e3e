/// The variational fit as a least-squares model (MATH section 7; paper A (8)-(12), with the rigidity of section 2 built
/// in).
///
/// Residuals e_ij = d(R(s_j, t_i)) - r(s_j) over a grid of every motion, against that motion's target; one tool for
/// all.
#pragma once

#include <array>
#include <vector>

#include "flank/envelope/swept_estimate.h"
#include "flank/fit/solver/arrow_system.h"
#include "flank/obstacle/flank_checks.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank::internal {

/// One motion and the target that its envelope is to be.
struct FitTask {
  const Target* target = nullptr;
  RuledMotion motion;
  const FlankChecks* checks = nullptr;  ///< what its flank must not enter; null: nothing
};

/// Bounds on the tool, kept by one-sided terms in the fit and exactly at its end. Millimetres.
struct RadiusBounds {
  double smallest = 0.0;  ///< a minimum core radius, too
  double largest = 1e300;
  double steepest = 0.95;  ///< |r'|
};

/// Weights and sizes of one pass of the fit. Weights multiply mean squares of lengths in mm.
struct FitStage {
  int samples_t = 100, samples_s = 30;
  int control_points = 24;
  int tool_coefficients = 12;  ///< of a free tool
  int iterations = 30;
  double fairness = 1e-3;            ///< of second differences of tip and direction rails at the samples (A (11))
  double tool_fairness = 1e-6;       ///< of second differences of a free tool's coefficients
  double transversal_anchor = 1e-2;  ///< drift of the middle of the axis along its transversal velocity at the start
  double axial_pin = 1e-3;           ///< slide of the tip along the axis at the start
  double radius_pin = 0.0;  ///< of r(s) - r(s) at the start: an offset of tool and axis together is nearly a gauge
  double extension_weight = 0.05;   ///< of samples whose footpoint is past the border (zero invites the pose to leave)
  double robust_scale_mm = 0.0;     ///< Geman-McClure scale of samples inside the target; 0: plain least squares
  double extension_scale_mm = 0.0;  ///< the same for samples past the border, whose surface is only extrapolated
  double dead_zone_mm = 0.0;        ///< residuals count only beyond this, as sign(e) max(0, |e| - dead zone)
  double overcut_weight = 1.0;      ///< factor on the weight of samples with e < 0 (the tool enters the face)
  double clear_weight = 30.0;       ///< of the mean square by which the flank enters check faces
  bool clear_estimated = false;     ///< distances to check faces by interpolation
  double step_tolerance = 1e-9;     ///< stop when a step changes the cost by less than this share
};

/// What is known of a point of the axis and the check faces; true of places nearby, too, less their distance.
struct CheckSample {
  CheckDistance nearest;
  Vec3 at = Vec3::Zero();
  bool known = false;
};

/// Everything that changes during a fit.
struct FitState {
  std::vector<RuledMotion> motions;
  RadialFunction tool;
  std::vector<std::vector<Footpoint>> feet;      ///< of a FitModel: [motion][i * samples_s + j]
  std::vector<std::vector<CheckSample>> checks;  ///< [motion][i * samples_s + j], where there are check faces
  std::vector<SweptContact> contacts;            ///< of a SweptModel: of each of its points
};

class FitModel {
 public:
  /// free_parameters: indices of the tool's parameters that may change (none: the tool is given). The motions' rails
  /// must be clamped cubic over [0, 1] with stage.control_points control points each. checks: of each motion, or none.
  FitModel(std::vector<const Target*> targets, const FitState& start, std::vector<int> free_parameters,
           const RadiusBounds& bounds, const FitStage& stage, std::vector<const FlankChecks*> checks = {});

  [[nodiscard]] ArrowSystem make_system() const;
  /// Footpoints of all samples, warm from state.feet where it has them, else marched from one cold query a motion.
  void locate(FitState& state) const;
  /// The part of it that belongs to check faces.
  void locate_checks(FitState& state) const;
  /// Weights of the samples at this state: location, robust.
  [[nodiscard]] std::vector<std::vector<double>> sample_weights(const FitState& state) const;
  /// Sum of all weighted squares for frozen sample weights.
  [[nodiscard]] double cost(const FitState& state, const std::vector<std::vector<double>>& weights) const;
  /// Normal equations at the state.
  void assemble(const FitState& state, const std::vector<std::vector<double>>& weights, ArrowSystem& system) const;
  /// State after a step; footpoints are kept as hints only.
  [[nodiscard]] FitState moved(const FitState& state, const Eigen::VectorXd& step) const;

  /// The terms that do not look at the targets: fairness, anchors, pins, the tool's bounds, check faces.
  [[nodiscard]] double regulariser_cost(const FitState& state) const;
  /// Adds them to the normal equations.
  void assemble_regularisers(const FitState& state, ArrowSystem& system) const;
  /// Gradient of the radius by the free parameters of the tool.
  [[nodiscard]] Eigen::VectorXd tool_gradient(const RadialFunction& tool, double s) const;

  [[nodiscard]] double residual(const FitState& state, int motion, int i, int j) const;
  /// The axis point of a sample.
  [[nodiscard]] Vec3 point(const FitState& state, int motion, int i, int j) const;
  [[nodiscard]] const Target& target(int motion) const { return *targets_[static_cast<std::size_t>(motion)]; }
  [[nodiscard]] int samples_t() const { return stage_.samples_t; }
  [[nodiscard]] int samples_s() const { return stage_.samples_s; }
  [[nodiscard]] const FitStage& stage() const { return stage_; }

 private:
  struct TimeSample {
    double t;
    int first;
    std::array<double, 4> basis, basis_d2;  ///< values and second derivatives of the four active basis functions
  };
  struct Anchor {
    Vec3 middle, tangent, tip, axis;
  };
  struct PoseAt {
    Vec3 tip, w, u;
    double length_w;
  };

  [[nodiscard]] PoseAt pose_at(const RuledMotion& motion, const TimeSample& time) const;
  [[nodiscard]] Vec6 row(const PoseAt& pose, double s, const Footpoint& foot) const;
  /// Adds sum of w_ij g g' and of factor_ij g of one motion's residual rows.
  void assemble_rows(const FitState& state, int motion, const std::vector<double>& weights,
                     const std::vector<double>& gradient_factors, ArrowSystem& system) const;
  void tool_gradients(const FitState& state, Eigen::MatrixXd& gradients) const;
  void assemble_rails(const FitState& state, int motion, ArrowSystem& system) const;
  void assemble_tool(const FitState& state, ArrowSystem& system) const;
  /// By how much the ball of a sample enters a check face; 0 where it is clear.
  [[nodiscard]] double intrusion(const FitState& state, std::size_t motion, std::size_t k, double radius) const;
  [[nodiscard]] double check_weight() const;
  [[nodiscard]] double check_cost(const FitState& state) const;
  void assemble_checks(const FitState& state, ArrowSystem& system) const;
  [[nodiscard]] double rail_cost(const FitState& state, int motion) const;
  [[nodiscard]] double tool_cost(const FitState& state) const;

  std::vector<const Target*> targets_;
  std::vector<const FlankChecks*> checks_;  ///< of each motion; empty: none has any
  std::vector<int> free_;
  RadiusBounds bounds_;
  FitStage stage_;
  double axis_length_;
  std::vector<TimeSample> times_;
  std::vector<double> s_;
  std::vector<std::vector<Anchor>> anchors_;
  std::vector<double> start_radius_;  ///< r(s_j) at the start
  int tool_parameters_;
};

/// Signed direction in which the distance of a footpoint grows: its normal, or for a border point the direction to the
/// query point.
[[nodiscard]] Vec3 distance_gradient(const Vec3& p, const Footpoint& foot);

}  // namespace flank::internal
