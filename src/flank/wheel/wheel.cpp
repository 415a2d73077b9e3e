#include "flank/wheel.h"

#include "flank/wheel/plan_file.h"
#include "flank/wheel/run_wheel.h"

namespace flank {

std::string mill_wheel(const WheelRequest& request, const Progress& progress) {
  internal::WheelJob job;
  job.part = request.part, job.folder = request.folder, job.unit = request.unit;
  job.tolerance_mm = request.tolerance_mm, job.least_coverage = request.least_coverage;
  job.effort = request.effort, job.tool = request.tool, job.sample_mm = request.sample_mm;
  job.blank = request.blank, job.allowance_mm = request.allowance_mm;
  job.most_engagement_deg = request.most_engagement_deg;
  job.most_tilt_deg = request.most_tilt_deg;
  job.rough = request.rough, job.edges = request.edges;
  job.choice = {request.hub, request.blades, request.splitters, request.count};
  return internal::plan_json(internal::run_wheel(job, progress));
}

}  // namespace flank
