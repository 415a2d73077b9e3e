/// What the tolerance is spent on: every share of it that has to be left for somebody else, in one place.
///
/// The user's tolerance is what the judge allows: depth in the target, depth in other faces, material left. A planner
/// knows the tool only at samples, the triangles of a face are not the face, and the joined poses of a path are not the
/// motion. So a planner may use a share of the tolerance, and what it cannot see has the rest. The chains at the end of
/// this file add up what stands between a planner and the judge; none may exceed 1 (tests/base/tolerance_budget_test.cpp,
/// docs/decisions/0012).
///
/// Scales of a search are no shares of the budget and stay where they are used: they say where to look or what a result
/// is worth (robust scales, horizons, bands of refinement, ranking at several tolerances), and nothing is left for them.
#pragma once

namespace flank::internal {

/// Depth in the target, in tolerances, of strips of a given tool (cover). In their order: a place that must be lifted is
/// remembered, and what is held in a fit is held below what is certified.
struct TargetDepthBudget {
  /// Contacts deeper than this are kept for the lift, which can only lift what is kept.
  double remembered = 0.8;
  /// Places deeper than `held` are held in a pass of limits, at `held_aim`: those about to fail are held too, and a
  /// penalty is never met exactly.
  double held = 0.9, held_aim = 0.8;
  /// Of `certified`: what a lift aims at. Aimed at the limit itself, the approximation by the rails would leave places
  /// just beyond it.
  double lift_of_certified = 0.97;
  /// The most at the samples of a certificate. Not derived: with it the judge's overcut stays below the tolerance on all
  /// faces of docs/algorithms/cover.md.
  double certified = 0.93;
  /// What may lie between the poses of a certificate. The last look sees it at a thousand poses, and allows it.
  double between_poses = 0.04;
  /// What may lie between the places of the face at which the last look looks: without it, a propeller's strip that used
  /// up every other share was deeper than the tolerance by 2e-4 of it.
  double between_samples = 0.01;

  [[nodiscard]] constexpr double last_look() const { return certified + between_poses; }
};

/// Depth in other faces, in tolerances.
struct OtherFacesBudget {
  /// While a strip grows, and in a certificate: what lies between the poses, once they are joined smoothly, has the
  /// difference.
  double growing = 0.35, certified = 0.65;
  /// A fit of strips aims below what it is certified by, because a penalty is never met exactly.
  double aim = 0.6;
  /// The last look at a thousand poses.
  double last_look = 0.9;
  /// Triangles stand for these faces: how far they may be off. More of them would only cost time.
  double triangles = 0.3;
  /// What a fit of a tool (no certificate follows) lets its flank enter, by the exact surfaces; and what its term, which
  /// is soft, may give beyond that.
  double fit_allowance = 0.8, soft_term = 0.18;
};

/// Shank and holder against the target's own faces, in tolerances. Where they touch, the flank touches too.
struct ShankBudget {
  /// The target's triangles, for the planner: a shank as thick as the flank touches all along, so they are fine.
  double triangles = 0.1;
  /// Held back from the floor of other faces, which otherwise holds for the shank as well.
  double spare = 0.2;
  /// Triangles of all faces for the judge of clearances, which counts against the tool how far they may be off.
  double judge_triangles = 0.5;
};

/// Fits of a tool (flank fit): depth in the target and material left, in tolerances. These are aims: the last of them is
/// given up if it costs too much coverage, and the judge says what came of it.
struct FitBudget {
  /// Residuals below these count for nothing, so that a fit spends its freedom on what is near the tolerance: at points
  /// of the axis, and at points of the face, which see more. The rest is for what lies between the points.
  double dead_zone_axis = 0.7, dead_zone = 0.6;
  /// The same where part of the face is given up: a place that is within the tolerance is as good as it gets.
  double dead_zone_partial = 0.8;
  /// Of fits of orbits, which see one place of each: the dead zone, and what is within the tolerance for sure, because a
  /// ridge between two strips may lie between two places.
  double dead_zone_orbit = 0.5, sure_orbit = 0.8;
  /// Overcut to which a free tool's radii are reduced: while candidates are compared, and of the chosen one, which is
  /// looked at with denser samples.
  double overcut = 0.95, settled_overcut = 0.92;
  /// Overcut of an exact fit that is left alone: its last digits are worth more than that.
  double exact_overcut = 0.1;
  /// The deepest that any fit may be by its estimate to count as one that cuts nothing: the judge sees a little more.
  double clean = 0.99;
  /// What may lie between the samples of the estimate.
  double between_samples = 0.03;
  /// Depth to which a free tool is made thinner where the judge finds it a little deeper than the tolerance; how much
  /// deeper: beyond that, it is not the estimate that missed something.
  double thinned = 0.98, thinnable = 1.25;
};

/// Cavities: depth in any face, in tolerances.
struct CavityBudget {
  /// Side paths, of which cycles get the rest: half paths leave them and reach them, and are deepest just off these ends.
  double sides = 0.8;
  /// What run-outs beyond the sides, and tips that are lifted off a floor, aim at.
  double aim = 0.5;
  /// Half paths, at the places where they are looked at, and what may lie between these places; their joined poses, which
  /// finish nothing, may be so far off.
  double halves = 0.84, between_places = 0.06, half_chord = 0.1;
  /// Where a cycle can do no other: so deep, at those places, and it still gets through.
  [[nodiscard]] constexpr double through() const { return 1.0 - between_places; }
};

/// Shares of the tolerance, all in one.
struct ToleranceBudget {
  /// How far the joined poses of a path may leave the motion: half a micrometre of 0.02 mm. Every chain has it.
  double chord = 0.02;
  TargetDepthBudget target;
  OtherFacesBudget others;
  ShankBudget shank;
  FitBudget fit;
  CavityBudget cavity;
};

/// The budget of both planners.
inline constexpr ToleranceBudget kToleranceBudget{};

/// The chains: the worst that a judge may find, in tolerances, if every link uses its share up. Strips of a given tool
/// in the target:
[[nodiscard]] constexpr double worst_in_target(const ToleranceBudget& budget) {
  return budget.target.last_look() + budget.target.between_samples + budget.chord;
}
/// Their flank in other faces, of which triangles are known.
[[nodiscard]] constexpr double worst_in_other_faces(const ToleranceBudget& budget) {
  return budget.others.last_look + budget.others.triangles + budget.chord;
}
/// Their shank in the target.
[[nodiscard]] constexpr double worst_of_shank(const ToleranceBudget& budget) {
  return budget.others.last_look - budget.shank.spare + budget.shank.triangles + budget.chord;
}
/// A fitted tool in the target, if its aim is reached.
[[nodiscard]] constexpr double worst_of_fit_in_target(const ToleranceBudget& budget) {
  return budget.fit.overcut + budget.fit.between_samples + budget.chord;
}
/// A fitted tool in other faces.
[[nodiscard]] constexpr double worst_of_fit_in_other_faces(const ToleranceBudget& budget) {
  return budget.others.fit_allowance + budget.others.soft_term + budget.chord;
}
/// A half path between the sides of a cavity.
[[nodiscard]] constexpr double worst_of_halves(const ToleranceBudget& budget) {
  return budget.cavity.halves + budget.cavity.between_places + budget.cavity.half_chord;
}
/// Material that a residual within its dead zone leaves at a point.
[[nodiscard]] constexpr double worst_left_by_dead_zone(const ToleranceBudget& budget) {
  return budget.fit.dead_zone_axis + budget.chord;
}

}  // namespace flank::internal
