// A tool that is given, on faces that are not its envelope: no overcut, and not much more material left than the best
// two-sided motion leaves as error.
#include "claims/claims_support.h"
#include "flank/example/example_write.h"
#include "flank/fit/swept_polish.h"
#include "flank/tool_request/tool_model.h"

namespace flank::internal::bench {
namespace {

/// The least largest |f| over the face that a motion of either sign reaches, from the one-sided result: passes whose dead
/// zone narrows, the best by the judge kept.
double two_sided(const Example& example, const Result& outcome) {
  const std::unique_ptr<Target> target = make_target(std::vector<Face>{example.faces.front()});
  FitDraft draft;
  draft.tool = outcome.tool.radial;
  for (const RuledMotion& motion : outcome.motions) {
    draft.motions.push_back(motion);
    draft.targets.push_back(target.get());
  }
  const std::vector<FacePoint> points = target_points(draft, 50);
  double best = std::max(outcome.verify.undercut_mm, outcome.verify.overcut_mm);
  for (const double share : {0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.9, 0.9}) {
    FitStage stage;
    stage.control_points = 48;
    stage.fairness = 1e-6;
    stage.transversal_anchor = 1e-7;
    stage.axial_pin = 1e-8;
    stage.iterations = 30;
    stage.dead_zone_mm = share * best;
    const FitDraft trial = run_swept(draft, RadiusBounds{}, stage, points, nullptr);
    FlankFitResult fit;
    fit.tool = trial.tool;
    fit.motions = trial.motions;
    const VerifyReport verdict = judge_fit({example.faces.front()}, fit, 0.1, example.diagonal_mm / 200.0);
    const double largest = std::max(verdict.undercut_mm, verdict.overcut_mm);
    if (largest >= best) continue;
    best = largest;
    draft = trial;
  }
  return best;
}

std::vector<Figure> given(const std::string& part, const std::string& tool) {
  const Example example = make_example(part);
  const double d = example.diagonal_mm;
  write_example(example, scratch(part + ".step"));
  FitJob job;
  job.strips = 1;
  job.part.file = scratch(part + ".step");
  job.tool.spec = tool;
  job.part.side = +1;
  job.tolerance_mm = 0.1;
  job.judge.least_coverage = 1e-6;  // whatever comes out is shown
  Result outcome;
  const double seconds = seconds_of([&] { outcome = run_fit(job, {}); });
  const double rival = two_sided(example, outcome);
  return {at_most("overcut", outcome.verify.overcut_mm / d, 2e-5),
          shown("undercut", outcome.verify.undercut_mm / d),
          shown("largest error of the two-sided fit", rival / d),
          at_most("ratio of undercut", outcome.verify.undercut_mm / rival, 3.0),
          shown("rms", outcome.verify.rms_mm / d),
          shown("coverage at 0.1 mm", outcome.verify.coverage),
          shown("seconds", seconds)};
}

}  // namespace

void add_given_tool_claims(std::vector<Claim>& claims) {
  for (const char* part : {"ruled-blade", "twisted-blade"})
    for (const char* tool : {"cylinder:radius=4", "cone:radius=3,angle=3", "barrel:arc=150,radius=4.5"})
      claims.push_back({std::string("given tool/") + part + " " + tool,
                        [part = std::string(part), tool = std::string(tool)] { return given(part, tool); }});
}

}  // namespace flank::internal::bench
