// Real blades, and the generated ruled one: the whole command from the file.
#include "claims/claims_support.h"

#include "flank/example/example_write.h"

namespace flank::internal::bench {
namespace {

Result fit_file(FitJob job, double& seconds) {
  Result outcome;
  seconds = seconds_of([&] { outcome = run_fit(job, {}); });
  return outcome;
}

struct PartCase {
  std::string name, file, faces;
  double tolerance, radius_min, radius_max;
  int strips;
  double coverage, overcut;  // asked for
};

FitJob job_of(const PartCase& c) {
  FitJob job;
  job.part.file = real_part(c.file);
  job.part.faces = c.faces;
  job.tolerance_mm = c.tolerance;
  job.radius.min_mm = c.radius_min;
  job.radius.max_mm = c.radius_max;
  job.strips = c.strips;
  job.avoid = false;  // the face alone: what its neighbours allow is in avoidance_claims
  return job;
}

std::vector<Figure> real(const PartCase& c) {
  double seconds = 0.0;
  const Result outcome = fit_file(job_of(c), seconds);
  return {at_least("coverage", outcome.verify.coverage, c.coverage),
          at_most("overcut, mm", outcome.verify.overcut_mm, c.overcut),
          shown("undercut over the covered strip, mm", outcome.verify.undercut_covered_mm),
          shown("rms, mm", outcome.verify.rms_mm),
          shown("strips", static_cast<double>(outcome.path.strips.size())),
          shown("seconds", seconds)};
}

std::vector<Figure> ruled_blade() {
  const Example example = make_example("ruled-blade");
  write_example(example, scratch("ruled.step"));
  FitJob job;
  job.part.file = scratch("ruled.step");
  job.tolerance_mm = 0.1;
  job.part.side = +1;
  double seconds = 0.0;
  const Result outcome = fit_file(job, seconds);
  return {at_least("coverage", outcome.verify.coverage, 0.99), at_most("overcut, mm", outcome.verify.overcut_mm, 0.01),
          shown("largest material left, mm", outcome.verify.undercut_mm), shown("seconds", seconds)};
}

/// Root-mean-square error of a free tool against that of the best cylinder, one strip each.
std::vector<Figure> custom_against_cylinder(const PartCase& c) {
  FitJob job = job_of(c);
  double seconds = 0.0;
  const Result custom = fit_file(job, seconds);
  job.tool.spec = "cylinder";
  const Result cylinder = fit_file(job, seconds);
  return {shown("rms of the custom tool, mm", custom.verify.rms_mm),
          shown("coverage of the custom tool", custom.verify.coverage),
          shown("rms of the best cylinder, mm", cylinder.verify.rms_mm),
          shown("coverage of the best cylinder", cylinder.verify.coverage),
          at_least("ratio of rms", cylinder.verify.rms_mm / custom.verify.rms_mm, 1.4)};
}

}  // namespace

void add_part_claims(std::vector<Claim>& claims) {
  constexpr double kOpen = 1e300;
  const PartCase cases[] = {
      {"kj66 F1", "kj66_impeller.step", "F1", 0.01, 1.5, 2.5, 1, 0.999, 0.015},
      {"kj66 F3", "kj66_impeller.step", "F3", 0.01, 1.5, 2.5, 1, 0.999, 0.015},
      {"r37 F1, one strip", "r37_blade.step", "F1", 0.1, 4, 8, 1, 0.97, kOpen},
      {"r37 F3, one strip", "r37_blade.step", "F3", 0.1, 4, 8, 1, 0.97, kOpen},
      {"r37 F1, one strip, fine", "r37_blade.step", "F1", 0.05, 4, 8, 1, 0.97, kOpen},
      {"r37 F3, one strip, fine", "r37_blade.step", "F3", 0.05, 4, 8, 1, 0.97, kOpen},
      {"r37 F1, four strips", "r37_blade.step", "F1", 0.05, 4, 8, 4, 0.94, kOpen},
      {"r37 F3, four strips", "r37_blade.step", "F3", 0.05, 4, 8, 4, 0.94, kOpen},
      {"r37 F1, strips auto", "r37_blade.step", "F1", 0.02, 4, 8, 0, 0.95, 0.025},
      {"r37 F3, strips auto", "r37_blade.step", "F3", 0.02, 4, 8, 0, 0.95, 0.025},
  };
  for (const PartCase& c : cases) claims.push_back({"part/" + c.name, [c] { return real(c); }});
  claims.push_back({"part/ruled-blade", ruled_blade});
  for (int k : {0, 1, 2, 3, 6, 7})
    claims.push_back(
        {"custom against cylinder/" + cases[k].name, [c = cases[k]] { return custom_against_cylinder(c); }});
}

}  // namespace flank::internal::bench
