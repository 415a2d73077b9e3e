#include "flank/pipeline/folder/folder_job.h"

#include <filesystem>
#include <variant>

#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/job/job_json.h"
#include "flank/setup/tool_body.h"
#include "flank/tool_file.h"

namespace flank::internal {
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
  replace(job.part.side, request.side);
  replace(job.tolerance_mm, request.tolerance_mm);
  replace(job.judge.sample_mm, request.sample_mm);
  replace(job.judge.reach_radius_mm, request.reach_radius_mm);
  if constexpr (std::is_same_v<Job, TrochoidJob>) replace(job.cycles.stock_cell_mm, request.stock_cell_mm);
  const ObstacleRequest& asked = request.obstacles;
  ObstacleRequest& obstacles = job.obstacles;
  if (asked.check_faces || asked.ignore_faces) {
    obstacles.check_faces = asked.check_faces;
    obstacles.ignore_faces = asked.ignore_faces;
  }
  if (!asked.fixtures.empty()) obstacles.fixtures = asked.fixtures;
  replace(obstacles.fixture_unit, asked.fixture_unit);
  replace(obstacles.clearance_mm, asked.clearance_mm);
  if (asked.shank != "given") obstacles.shank = asked.shank;
  replace(obstacles.shank_radius_mm, asked.shank_radius_mm);
  replace(obstacles.shank_length_mm, asked.shank_length_mm);
  replace(obstacles.holder, asked.holder);
}

/// The files of a job that moved together with the folder.
template <class Job>
void follow_moved(const ResultFolder& folder, Job& job) {
  if (!folder.manifest()) return;
  const auto follow = [&](std::string& file) { file = moved_with(*folder.manifest(), folder.path(), file); };
  follow(job.part.file);
  for (std::string& fixture : job.obstacles.fixtures) follow(fixture);
}

}  // namespace

FolderJob read_folder_job(const VerifyJob& request, const ResultFolder& folder) {
  const std::string file = (std::filesystem::path(folder.path()) / "job.json").string();
  if (!std::filesystem::exists(file)) throw InputError(file + ": is missing; give a folder written by `flank fit`");
  FolderJob found{job_from_json(read_file(file), file), {}};
  std::visit(
      [&](auto& job) {
        found.named_part = job.part.file;
        follow_moved(folder, job);
        apply(request, job);
      },
      found.job);
  return found;
}

Tool read_and_equip(const std::string& file, const ObstacleRequest& asked, const ObstacleRequest& merged) {
  // Shank and holder as asked for now, fixtures and clearance of the merged job: tool.json has the job's shank and holder.
  ObstacleRequest request = asked;
  request.fixtures = merged.fixtures;
  request.clearance_mm = merged.clearance_mm;
  Tool tool = read_tool(file);
  check_obstacles(request, &tool);
  equip_tool(request, tool);
  return tool;
}

}  // namespace flank::internal
