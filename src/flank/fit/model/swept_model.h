/// The fit seen from the face: residuals are the swept distance itself (MATH section 9) at fixed points of the faces.
///
/// The residuals of FitModel belong to points of the axis; on a target that is no envelope they can be far below the
/// real error, and a motion that shrinks improves them. Here the points of the face are fixed, so nothing is gained by
/// covering less, several strips share a face as they do in the cut, and other faces enter as points with one side.
/// The derivative of f(x) = min over t, s of |x - R(s,t)| - r(s) is that of the sphere at the minimum (envelope theorem).
#pragma once

#include <vector>

#include "flank/fit/model/fit_model.h"
#include "flank/fit/model/minimise.h"

namespace flank::internal {

/// A fixed point of a face and what is asked of f there.
struct FacePoint {
  Vec3 point = Vec3::Zero();
  double share = 0.0;      ///< its weight: shares of the target's points sum to one
  bool one_sided = false;  ///< a check surface: only f < margin_mm counts
  double margin_mm = 0.0;
};

class SweptModel {
 public:
  /// As FitModel; of the stage, samples are not used for residuals (only for regularisers), robust_scale_mm bounds the
  /// pull of points that are out of reach, overcut_weight multiplies points with f < 0.
  SweptModel(std::vector<FacePoint> points, std::vector<const Target*> targets, const FitState& start,
             std::vector<int> free_parameters, const RadiusBounds& bounds, const FitStage& stage,
             std::vector<const FlankChecks*> checks = {});

  [[nodiscard]] ArrowSystem make_system() const { return base_.make_system(); }
  /// Fills state.contacts.
  void locate(FitState& state) const;
  [[nodiscard]] std::vector<double> sample_weights(const FitState& state) const;
  [[nodiscard]] double cost(const FitState& state, const std::vector<double>& weights) const;
  void assemble(const FitState& state, const std::vector<double>& weights, ArrowSystem& system) const;
  [[nodiscard]] FitState moved(const FitState& state, const Eigen::VectorXd& step) const {
    return base_.moved(state, step);
  }
  /// df/d(unknowns) of point k at its contact.
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

[[nodiscard]] ResidualSummary summarise_residuals(const SweptModel& model, const FitState& state);

}  // namespace flank::internal
