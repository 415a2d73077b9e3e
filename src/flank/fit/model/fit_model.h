/// The variational fit as a least-squares model (MATH section 7; paper A (8)-(12), with the rigidity of section 2 built
/// in).
///
/// Residuals e_ij = d(R(s_j, t_i)) - r(s_j) over a grid of every motion, against that motion's target; one tool for
/// all. The cost is a mean of squares in mm^2, so every weight of FitStage is a plain number against 1 for the residuals, and
/// all but fairness mean the same on a grid of any size.
#pragma once

#include <vector>

#include "flank/fit.h"
#include "flank/fit/model/axis_grid.h"
#include "flank/fit/model/fit_stage.h"
#include "flank/fit/model/fit_state.h"
#include "flank/fit/model/obstacle_terms.h"
#include "flank/fit/model/rail_terms.h"
#include "flank/fit/model/tool_terms.h"
#include "flank/fit/solver/arrow_system.h"
#include "flank/target.h"

namespace flank::internal {

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
  void locate_obstacles(FitState& state) const { obstacles_.locate(state); }
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
  [[nodiscard]] Eigen::VectorXd tool_gradient(const RadialFunction& tool, double s) const {
    return tool_.gradient(tool, s);
  }

  /// d - r of a sample of a located state, mm: > 0 material left, < 0 overcut; without dead zone.
  [[nodiscard]] double residual(const FitState& state, int motion, int i, int j) const;
  /// The axis point of sample i in time, j along the axis, mm.
  [[nodiscard]] Vec3 point(const FitState& state, int motion, int i, int j) const;
  [[nodiscard]] const Target& target(int motion) const { return *targets_[static_cast<std::size_t>(motion)]; }
  [[nodiscard]] int samples_t() const { return stage_.samples_t; }
  [[nodiscard]] int samples_s() const { return stage_.samples_s; }
  [[nodiscard]] const FitStage& stage() const { return stage_; }

 private:
  /// Adds sum of w_ij g g' and of factor_ij g of one motion's residual rows.
  void assemble_rows(const FitState& state, int motion, const std::vector<double>& weights,
                     const std::vector<double>& gradient_factors, ArrowSystem& system) const;

  std::vector<const Target*> targets_;
  FitStage stage_;
  AxisGrid grid_;
  RailTerms rails_;
  ToolTerms tool_;
  ObstacleTerms obstacles_;
};

/// Gradient of the signed distance at p, a unit vector: the footpoint's normal, or for a border footpoint the direction
/// between it and p (its normal if p lies on the border, where the distance has no gradient).
[[nodiscard]] Vec3 distance_gradient(const Vec3& p, const Footpoint& foot);

}  // namespace flank::internal
