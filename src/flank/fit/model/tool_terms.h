/// The terms of the fit that hold its tool: the pin to the start's radii, the bounds, and the fairness of a free spline. And
/// which of the tool's parameters the fit may change.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "flank/fit.h"
#include "flank/fit/model/fit_stage.h"
#include "flank/fit/solver/arrow_system.h"
#include "flank/radial_function.h"

namespace flank::internal {

/// Immutable after construction. A tool without free parameters has no terms.
class ToolTerms {
 public:
  /// free_parameters: indices of the parameters that may change. s: samples of the axis, mm, ascending. The pin holds to
  /// `start`.
  ToolTerms(const RadialFunction& start, std::vector<int> free_parameters, const RadiusBounds& bounds,
            const FitStage& stage, const std::vector<double>& s);

  [[nodiscard]] const std::vector<int>& free() const { return free_; }
  [[nodiscard]] int free_count() const { return static_cast<int>(free_.size()); }

  /// Gradient of r(s) by the free parameters.
  [[nodiscard]] Eigen::VectorXd gradient(const RadialFunction& tool, double s) const;
  /// The same at all samples of the axis: free parameters x samples.
  [[nodiscard]] Eigen::MatrixXd gradients(const RadialFunction& tool) const;

  /// Sum of the weighted squares, mm^2.
  [[nodiscard]] double cost(const RadialFunction& tool) const;
  /// Adds them to the tool's own block of the normal equations and to the tail of their gradient.
  void assemble(const RadialFunction& tool, ArrowSystem& system) const;

 private:
  std::vector<int> free_;
  RadiusBounds bounds_;
  FitStage stage_;
  std::vector<double> s_, bound_places_;  ///< samples of the axis; where the bounds are asked
  std::vector<double> start_radius_;      ///< r(s_j) at the start
};

}  // namespace flank::internal
