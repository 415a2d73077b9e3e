/// The terms of the fit that hold the rails of its motions, whatever the targets are: fairness, anchor and pin to the start,
/// and how points of the axis plunge and lag (the weights of FitStage say what each is for).
#pragma once

#include <vector>

#include "flank/fit/model/axis_grid.h"
#include "flank/fit/model/fit_stage.h"
#include "flank/fit/model/fit_state.h"
#include "flank/fit/solver/arrow_system.h"

namespace flank::internal {

/// Of all motions of a pass; anchors and pins hold to its start. Immutable after construction. All terms are means over the
/// times and the motions, so that weights mean the same on any grid and for any number of motions.
class RailTerms {
 public:
  RailTerms(const AxisGrid& grid, const FitState& start, const FitStage& stage);

  /// Sum of the weighted squares of one motion, mm^2.
  [[nodiscard]] double cost(const RuledMotion& rails, std::size_t motion) const;
  /// Adds one motion's terms to the normal equations.
  void assemble(const RuledMotion& rails, std::size_t motion, ArrowSystem& system) const;

 private:
  /// The start's axis at one time: its middle and that point's unit transversal velocity, its tip and direction; and
  /// which way it goes on, averaged over the times around it.
  struct Anchor {
    Vec3 middle, tangent, tip, axis, way;
    /// The common way of this motion and the one over the other side, a unit vector, and how far the axis is to lean along
    /// it. Set where FitStage::parallel_weight is.
    Vec3 forward = Vec3::Zero();
    double lean = 0.0;
  };

  /// Of the motions of a start that face each other.
  void lean_alike(const FitState& start);
  /// Anchors and mean speeds of one motion of the start.
  void add_anchors(const RuledMotion& motion);
  [[nodiscard]] bool weighs_velocities() const { return stage_.plunge_weight > 0.0 || stage_.lag_weight > 0.0; }
  /// By how much the points of the axis plunge at one time, and that by their velocity: visit(s, Plunge).
  template <class Visit>
  void visit_plunges(const RuledMotion& rails, std::size_t motion, std::size_t time, const Visit& visit) const;
  /// By how much they lag, and that by their velocity: visit(s, mm, gradient).
  template <class Visit>
  void visit_lags(const RuledMotion& rails, std::size_t motion, std::size_t time, const Visit& visit) const;
  void assemble_fairness(const RuledMotion& rails, std::size_t motion, std::size_t time, ArrowSystem& system) const;
  /// Anchor, pin and |w| = 1.
  void assemble_anchor(const RuledMotion& rails, std::size_t motion, std::size_t time, ArrowSystem& system) const;
  void assemble_velocities(const RuledMotion& rails, std::size_t motion, std::size_t time, ArrowSystem& system) const;

  AxisGrid grid_;
  FitStage stage_;
  double share_;                              ///< of one time of one motion in the mean
  std::vector<std::vector<Anchor>> anchors_;  ///< [motion][time]
  std::vector<std::vector<double>> speeds_;   ///< [motion][j]: mean speed of the axis' point s_j along the way, >= 0
  std::vector<double> start_slope_;           ///< r'(s_j) of the tool at the start
};

}  // namespace flank::internal
