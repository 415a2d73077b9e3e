// `flank verify DIR`: judges the tool and the path that lie in a folder.
#include <fmt/format.h>

#include <filesystem>

#include "flank/artefact/acceptance.h"
#include "flank/artefact/verify_json.h"
#include "flank/artefact/view.h"
#include "flank/artefact/view_json.h"
#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/job/check_fields.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/pipeline/judge_job.h"
#include "flank/run.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/tool_body.h"
#include "flank/tool_file.h"

namespace flank {
using namespace internal;
namespace {

/// What is given takes the place of what was there.
template <class T, class From>
void replace(T& value, const From& by) {
  if (by) value = *by;
}
template <class T>
void replace(std::optional<T>& value, const std::optional<T>& by) {
  if (by) value = by;
}

template <class Job>
void apply(const VerifyJob& request, Job& job) {
  replace(job.part.file, request.part);
  replace(job.tolerance_mm, request.tolerance_mm);
  replace(job.judge.sample_mm, request.sample_mm);
  replace(job.judge.reach_radius_mm, request.reach_radius_mm);
  const ObstacleRequest& asked = request.obstacles;
  ObstacleRequest& obstacles = job.obstacles;
  if (asked.check_faces || asked.ignore_faces) {
    obstacles.check_faces = asked.check_faces;
    obstacles.ignore_faces = asked.ignore_faces;
  }
  if (!asked.fixtures.empty()) obstacles.fixtures = asked.fixtures;
  replace(obstacles.clearance_mm, asked.clearance_mm);
  replace(obstacles.shank_radius_mm, asked.shank_radius_mm);
  replace(obstacles.shank_length_mm, asked.shank_length_mm);
  replace(obstacles.holder, asked.holder);
}

/// Shank and holder as asked for now, fixtures and clearance of the merged job: tool.json has the job's shank and holder.
ObstacleRequest body_of(const ObstacleRequest& asked, const ObstacleRequest& merged) {
  ObstacleRequest request = asked;
  request.fixtures = merged.fixtures;
  request.clearance_mm = merged.clearance_mm;
  return request;
}

Tool read_and_equip(const std::string& file, const ObstacleRequest& request) {
  Tool tool = read_tool(file);
  check_obstacles(request, &tool);
  equip_tool(request, tool);
  return tool;
}

template <class Job>
Verification judge_folder(const VerifyJob& request, const Job& job) {
  const auto file = [&](const char* name) { return (std::filesystem::path(request.folder) / name).string(); };
  Verification outcome;
  outcome.job = job;
  const Tool tool = read_and_equip(file("tool.json"), body_of(request.obstacles, job.obstacles));
  const Path path = read_path(file("path.json"));
  std::vector<std::string> repairs;  // told when the folder was made
  const Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, repairs);
  outcome.notes.assign(repairs.begin() + static_cast<std::ptrdiff_t>(setup.part.repairs.size()), repairs.end());
  outcome.report = judge_job(setup, job.judge, tool, path);
  const ClearanceScene scene = make_clearance_scene(setup, job.obstacles, has_body(tool), outcome.notes);
  outcome.report.clearance = measure_clearance(scene, tool, path);
  outcome.acceptance = accept(tool, outcome.report, job.judge.least_coverage);
  write_file(file("verify.json"), verify_to_json(outcome.report, outcome.acceptance));
  write_file(file("view.json"), view_to_json(make_view(outcome.job, setup, tool, path, outcome.report)));
  return outcome;
}

}  // namespace

Verification run_verify(const VerifyJob& request) {
  check_fields(request);
  if (!std::filesystem::is_directory(request.folder))
    throw InputError(request.folder + ": no such folder; a folder written by `flank fit` is needed");
  const std::string file = (std::filesystem::path(request.folder) / "job.json").string();
  if (!std::filesystem::exists(file))
    throw InputError(file + ": is not there; a folder written by `flank fit` is needed");
  PlanJob plan = job_from_json(read_file(file), file);
  return std::visit(
      [&](auto& job) {
        apply(request, job);
        return judge_folder(request, job);
      },
      plan);
}

}  // namespace flank
