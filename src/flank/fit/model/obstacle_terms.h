/// The terms of the fit that keep flank and shank out of other faces (MATH section 7): one-sided, at points of the axis.
#pragma once

#include <vector>

#include "flank/fit/model/axis_grid.h"
#include "flank/fit/model/fit_stage.h"
#include "flank/fit/model/fit_state.h"
#include "flank/fit/model/tool_terms.h"
#include "flank/obstacle_field.h"

namespace flank::internal {

/// Immutable after construction; obstacles are not owned. The order of calls for a state is locate, then anything else.
class ObstacleTerms {
 public:
  /// obstacles: of each motion (nullptr: that one has none), or none at all. `start`: the tool at the start of the pass, for how
  /// densely its shank is asked; `bounds`: has that shank.
  ObstacleTerms(const AxisGrid& grid, std::vector<const ObstacleField*> obstacles, const FitStage& stage,
                const RadialFunction& start, const RadiusBounds& bounds);

  /// Distances of the samples to the obstacles, into state.obstacles: measured where those of the last call do not tell.
  void locate(FitState& state) const;
  /// Sum of the weighted squares of the depths by which flank and shank enter obstacles, mm^2.
  [[nodiscard]] double cost(const FitState& state) const;
  /// Adds them to the normal equations. tool: of the same fit.
  void assemble(const FitState& state, const ToolTerms& tool, ArrowSystem& system) const;

 private:
  void locate_pose(const FitState& state, std::size_t motion, std::size_t time, const std::vector<double>& needed_mm,
                   std::vector<ObstacleSample>& samples) const;
  /// Radii of the balls at all places, mm.
  [[nodiscard]] std::vector<double> radii(const RadialFunction& tool) const;
  /// By how much the ball of a sample enters an obstacle beyond the allowance, mm; 0 if it is clear.
  [[nodiscard]] double intrusion(const FitState& state, std::size_t motion, std::size_t k, double radius) const;
  /// Of one sample's square in the cost.
  [[nodiscard]] double weight() const;

  AxisGrid grid_;
  RadiusBounds bounds_;
  std::vector<double> places_;  ///< along the axis, mm: those of the grid, and above them those of the shank
  FitStage stage_;
  std::vector<const ObstacleField*> obstacles_;
};

}  // namespace flank::internal
