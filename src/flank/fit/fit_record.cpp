#include "flank/fit/fit_record.h"

#include "flank/error.h"
#include "flank/motion/motion_record.h"
#include "flank/tool/radial_record.h"

namespace flank::internal {
namespace {

void code(StepCodec& codec, ResidualSummary& residuals) {
  for (double* value :
       {&residuals.rms_mm, &residuals.largest_mm, &residuals.inside_share, &residuals.largest_overcut_mm})
    codec.number(*value);
}

void code(StepCodec& codec, RadiusBounds& bounds) {
  for (double* value : {&bounds.smallest, &bounds.largest, &bounds.steepest, &bounds.slenderest, &bounds.neck,
                        &bounds.wheel_radius, &bounds.shank_length, &bounds.shank_radius})
    codec.number(*value);
  code(codec, bounds.shank_in_the_way);
}

}  // namespace

void code(StepCodec& codec, CoverageEstimate& estimate) {
  for (double* value :
       {&estimate.at_tolerance, &estimate.at_four_tolerances, &estimate.overcut_mm, &estimate.gouge_mm,
        &estimate.undercut_mm, &estimate.rms_mm, &estimate.largest_c, &estimate.stagger, &estimate.of_whole,
        &estimate.unheld, &estimate.turn, &estimate.slenderness, &estimate.least_slenderness})
    codec.number(*value);
  code(codec, estimate.legitimate);
}

void code(StepCodec& codec, IterationTrace& step) {
  for (double* value : {&step.cost, &step.rms_mm, &step.largest_mm, &step.damping}) codec.number(*value);
}

void code(StepCodec& codec, RejectedTool& rejected) {
  for (double* value : {&rejected.slenderness, &rejected.axis_length_mm, &rejected.largest_radius_mm})
    codec.number(*value);
  code(codec, rejected.strips);
  code(codec, rejected.estimate);
}

void code(StepCodec& codec, FlankFitResult& fit) {
  code_choice(codec, fit.status, 4);
  code(codec, fit.message);
  code(codec, fit.tool);
  code(codec, fit.motions);
  code(codec, fit.before);
  code(codec, fit.after);
  code(codec, fit.residuals);
  code(codec, fit.trace);
  code(codec, fit.notes);
  code(codec, fit.candidates);
  code(codec, fit.rejected);
  code_choice(codec, fit.unobstructed_search, 3);
  code(codec, fit.closely_measured);
  codec.require(fit.motions.empty() || fit.tool.axis_length() > 0.0, "expected a tool with its motions");
}

void code(StepCodec& codec, FitDraft& draft) {
  code(codec, draft.motions);
  code(codec, draft.tool);
  code(codec, draft.free_parameters);
  code(codec, draft.free_tool);
  code(codec, draft.facing);
  codec.require(draft.motions.empty() || draft.tool.axis_length() > 0.0, "expected a tool with its motions");
  for (const int index : draft.free_parameters)
    codec.require(index >= 0 && index < draft.tool.parameter_count(), "expected a free parameter that the tool has");
}

void code(StepCodec& codec, Polished& polished) {
  code(codec, polished.draft);
  code(codec, polished.estimate);
  code(codec, polished.exact);
}

void code(StepCodec& codec, FlankFitOptions& options) {
  codec.number(options.tolerance_mm);
  code(codec, options.axis_length_mm);
  code(codec, options.bounds);
  code(codec, options.strips);
  code(codec, options.polished_candidates);
  code(codec, options.finalists);
  codec.number(options.least_coverage);
  codec.number(options.enough_coverage);
  codec.number(options.most_turn_rad);
  codec.number(options.turn_window_mm);
  code(codec, options.search_without_obstacles);
  codec.number(options.least_coverage_for_last_passes);
  codec.number(options.least_coverage_for_close_look);
  bool beside_walls = options.obstacles != nullptr;
  code(codec, beside_walls);
  bool held = static_cast<bool>(options.is_free_line);
  code(codec, held);
  codec.number(options.reach_radius_mm);
  codec.number(options.sample_share);
  options.extra_overcut_points.resize(codec.count(options.extra_overcut_points.size()));
  for (Vec3& place : options.extra_overcut_points)
    for (int k = 0; k < 3; ++k) codec.number(place[k]);
}

void code(StepCodec& codec, ToolModel& tool) {
  bool free = tool.free();
  code(codec, free);
  code(codec, tool.free_parameters);
  code(codec, tool.radius);
  code(codec, tool.axis_length);
  code(codec, tool.longest_axis);
  code(codec, tool.first);
}

void reattach_targets(FitDraft& draft, const FitDraft& like) {
  if (draft.motions.size() != like.motions.size())
    throw InputError(
        "resume.json does not fit this run; start without --resume: a step has another number of motions than its "
        "start");
  draft.targets = like.targets;
  draft.obstacles = like.obstacles;
}

void reattach_targets(FitDraft& draft, const Target& target, const ObstacleField* obstacles) {
  draft.targets.assign(draft.motions.size(), &target);
  draft.obstacles.assign(draft.motions.size(), obstacles);
}

}  // namespace flank::internal
