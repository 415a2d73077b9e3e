// Faces that stand among others: what is reachable is covered, nothing else is entered, shank and holder keep clear.
#include <fmt/format.h>

#include "claims/claims_support.h"

namespace flank::internal::bench {
namespace {

struct Channel {
  std::string file, face;
  double tolerance, reach;  // mm
  double coverage;          // asked of the reachable share
};

FitJob job_of(const Channel& c) {
  FitJob job;
  job.strips = 1;
  job.part.file = real_part(c.file);
  job.part.faces = c.face;
  job.tolerance_mm = c.tolerance;
  job.judge.reach_radius_mm = c.reach;
  return job;
}

std::vector<Figure> beside_walls(const Channel& c, bool holder) {
  FitJob job = job_of(c);
  if (holder) {
    job.obstacles.shank_length_mm = 30.0;
    job.obstacles.holder = "30:10,60:10";
    job.obstacles.clearance_mm = 0.5;
  }
  Result outcome;
  const double seconds = seconds_of([&] { outcome = run_fit(job, {}); });
  std::vector<Figure> figures{
      shown("reachable share", outcome.verify.reachable_share),
      at_least("coverage of the reachable share", outcome.verify.coverage_reachable, c.coverage),
      at_most("overcut, mm", outcome.verify.overcut_mm, c.tolerance),
      at_most("deepest in another face, mm", outcome.verify.gouge_mm, c.tolerance),
      shown("largest |c|", outcome.largest_c),
      shown("smallest radius of the tool, mm", outcome.tool.radial.at(0.0).r),
      at_most("seconds", seconds, 20.0)};
  for (const ClearanceFigure& f : outcome.verify.clearance.figures)
    if (f.role != ObstacleRole::kTarget || f.body == ToolBody::kHolder)
      figures.push_back(at_least("clearance of the " + std::string(body_name(f.body)) + " from " +
                                     (f.role == ObstacleRole::kTarget ? "the target" : "other faces") + ", mm",
                                 f.clearance_mm - f.bound_mm, 0.5));
  return figures;
}

/// A given tool on a real blade leaves no overcut.
std::vector<Figure> given_on_r37(const std::string& tool) {
  FitJob job;
  job.strips = 1;
  job.part.file = real_part("r37_blade.step");
  job.tool.spec = tool;
  job.tolerance_mm = 0.1;
  job.judge.least_coverage = 1e-6;  // whatever comes out is shown
  Result outcome;
  const double seconds = seconds_of([&] { outcome = run_fit(job, {}); });
  return {at_most("overcut", outcome.verify.overcut_mm / outcome.diagonal_mm, 2e-5),
          at_most("deepest in another face, mm", outcome.verify.gouge_mm, *job.tolerance_mm),
          shown("coverage at 0.1 mm", outcome.verify.coverage), shown("rms, mm", outcome.verify.rms_mm),
          shown("seconds", seconds)};
}

}  // namespace

void add_avoidance_claims(std::vector<Claim>& claims) {
  const std::string wheel = "kj66_impeller.step", sector = "r37_blisk_sector_2blades.step";
  for (const Channel& c : {Channel{wheel, "F1", 0.02, 1.5, 0.99}, Channel{wheel, "F3", 0.02, 1.5, 0.99},
                           Channel{wheel, "F1", 0.01, 1.5, 0.99}, Channel{wheel, "F3", 0.01, 1.5, 0.99},
                           Channel{sector, "F9", 0.1, 5.0, 0.97}, Channel{sector, "F11", 0.1, 5.0, 0.97}}) {
    const std::string name = "beside walls/" + c.file + " " + c.face + " at " + fmt::format("{} mm", c.tolerance);
    claims.push_back({name, [c] { return beside_walls(c, false); }});
    if (c.tolerance != 0.01) claims.push_back({name + " with shank and holder", [c] { return beside_walls(c, true); }});
  }
  for (const char* tool : {"cylinder:radius=4", "cone:radius=3,angle=3", "barrel:arc=150,radius=4.5"})
    claims.push_back(
        {std::string("given tool/r37_blade F1 ") + tool, [tool = std::string(tool)] { return given_on_r37(tool); }});
}

}  // namespace flank::internal::bench
