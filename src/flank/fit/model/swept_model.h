/// The fit seen from the face: residuals are the swept distance itself (MATH section 9) at fixed points of the faces.
///
/// The residuals of FitModel belong to points of the axis; on a target that is no envelope they can be far below the
/// real error, and a motion that shrinks improves them. Here the points of the face are fixed, so nothing is gained by
/// covering less, several strips share a face as they do in the cut, and other faces enter as one-sided points. The
/// derivative of f(x) = min over t, s of |x - R(s,t)| - r(s) is that of the sphere at the minimum (envelope theorem).
/// If two places are equally near, f has a kink there: steps that cross it are refused until the damping has grown.
#pragma once

#include <vector>

#include "flank/fit/model/fit_model.h"
#include "flank/fit/model/minimise.h"

namespace flank::internal {

/// A fixed point of a face and what is asked of f there.
struct FacePoint {
  enum class Role {
    kTouch,       ///< of the target: |f| counts beyond the dead zone, on both sides
    kOutOfReach,  ///< of the target, but no ball of the reach radius gets there: overcut alone counts (margin 0)
    kHold,        ///< of the target where it is cut nearly too deep: held at f >= margin_mm, material left is free
    kAvoid,       ///< of another face: f >= margin_mm, the tool stays out
  };
  Vec3 point = Vec3::Zero();  ///< mm
  double share = 0.0;         ///< its weight, >= 0: about the share of the area it stands for
  Role role = Role::kTouch;
  double margin_mm = 0.0;  ///< of one-sided points: f below it counts, as min(0, f - margin). Negative lets the tool in
  /// Material left at the point costs nothing.
  [[nodiscard]] bool one_sided() const { return role != Role::kTouch; }
};

/// The model; FitModel's other terms (fairness, anchors, pins, bounds, obstacles) are the same. Immutable after
/// construction. The order of calls for a state is locate, then anything else.
class SweptModel {
 public:
  /// As FitModel. Of the stage, samples_t and samples_s are those of the regularisers, robust_scale_mm bounds the pull
  /// of material that cannot be reached (f > 0), overcut_weight multiplies points to be touched with f < 0.
  SweptModel(std::vector<FacePoint> points, std::vector<const Target*> targets, const FitState& start,
             std::vector<int> free_parameters, const RadiusBounds& bounds, const FitStage& stage,
             std::vector<const ObstacleField*> obstacles = {});

  [[nodiscard]] ArrowSystem make_system() const { return base_.make_system(); }
  /// Fills state.contacts: the nearest place of the swept tool to each point, refined; the last contacts are hints.
  void locate(FitState& state) const;
  /// Weight of each point at this state: its share, by robust scale and sign.
  [[nodiscard]] std::vector<double> sample_weights(const FitState& state) const;
  /// Sum of weighted squares and regularisers, mm^2.
  [[nodiscard]] double cost(const FitState& state, const std::vector<double>& weights) const;
  /// Gauss-Newton normal equations; clears the system first.
  void assemble(const FitState& state, const std::vector<double>& weights, ArrowSystem& system) const;
  [[nodiscard]] FitState moved(const FitState& state, const Eigen::VectorXd& step) const {
    return base_.moved(state, step);
  }
  /// df/d(unknowns) of point k at its contact. A family with free parameters must have at most four
  /// (ResidualRow::tool).
  [[nodiscard]] ResidualRow row(const FitState& state, std::size_t k) const;
  [[nodiscard]] const FitStage& stage() const { return base_.stage(); }
  [[nodiscard]] const std::vector<FacePoint>& points() const { return points_; }

 private:
  [[nodiscard]] double residual(const FitState& state, std::size_t k) const;

  std::vector<FacePoint> points_;
  FitModel base_;
  std::vector<int> free_;
  double axis_length_;
};

/// f over the points to be touched of a located state, by share, without dead zone; inside_share is 1.
[[nodiscard]] ResidualSummary summarise_residuals(const SweptModel& model, const FitState& state);

}  // namespace flank::internal
