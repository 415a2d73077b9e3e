/// Fits among the values of a finished step (base/step_codec.h). What is in the way and the targets are left out: tie()
/// puts them back.
#pragma once

#include "flank/base/step_codec.h"
#include "flank/fit/polished.h"

namespace flank::internal {

void code(StepCodec& codec, CoverageEstimate& estimate);
void code(StepCodec& codec, IterationTrace& step);
void code(StepCodec& codec, RejectedTool& rejected);
void code(StepCodec& codec, FlankFitResult& fit);
/// Without targets and obstacles.
void code(StepCodec& codec, FitDraft& draft);
void code(StepCodec& codec, Polished& polished);
/// Of what distinguishes one call from another within one job. For fingerprints alone: nothing reads them.
void code(StepCodec& codec, FlankFitOptions& options);
void code(StepCodec& codec, ToolModel& tool);

/// The draft is one of `like`: of its targets and what is in their way. Throws InputError if it has not as many motions.
void reattach_targets(FitDraft& draft, const FitDraft& like);
/// All its motions are on one target; `obstacles` may be null.
void reattach_targets(FitDraft& draft, const Target& target, const ObstacleField* obstacles);

}  // namespace flank::internal
