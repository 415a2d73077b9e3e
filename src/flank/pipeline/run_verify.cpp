// `flank verify DIR`: judges the tool and the path that lie in a folder.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "flank/artefact/acceptance.h"
#include "flank/artefact/verify_json.h"
#include "flank/artefact/view.h"
#include "flank/artefact/view_json.h"
#include "flank/error.h"
#include "flank/io/face_names.h"
#include "flank/io/text/json_input.h"
#include "flank/job/check_fields.h"
#include "flank/job/job_json.h"
#include "flank/manifest/result_folder.h"
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

/// The files of a job that moved together with the folder.
template <class Job>
void follow_moved(const ResultFolder& folder, Job& job) {
  if (!folder.manifest()) return;
  const auto follow = [&](std::string& file) { file = moved_with(*folder.manifest(), folder.path(), file); };
  follow(job.part.file);
  for (std::string& fixture : job.obstacles.fixtures) follow(fixture);
}

/// A path may only be about faces that the part has.
void require_known_faces(const Path& path, const Part& part, const std::string& file) {
  int last = part.is_mesh() ? part.face_count() : 0;
  for (const Face& face : part.faces) last = std::max(last, parse_face_name(face.id).number);
  for (const Strip& strip : path.strips)
    for (const std::string& item : face_list_items(strip.face))
      if (parse_face_name(item).number > last)
        throw InputError(fmt::format("{}: strip {} is of face {}, but {} has the faces F1 to F{} only", file, strip.id,
                                     item, part.file, last));
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

/// Whether tool, path and part are those that the result was made of: throws InputError where they are not, notes where
/// nobody knows.
void check_origin(const VerifyJob& request, const ResultFolder& folder, const Part& part, Verification& outcome) {
  const std::optional<Manifest>& manifest = folder.manifest();
  if (!manifest) {
    outcome.notes.push_back(std::string("no ") + kManifestFile + ": nothing says that tool and path belong together");
    return;
  }
  // Where tool and path came from elsewhere, they may come from there again; the verdict is made anew.
  if (manifest->made_by == kMadeByVerify) return;
  folder.require_whole({"verify.json", "view.json"});
  if (!request.part && part.sha256 != manifest->part.sha256)
    throw InputError(part.file + ": has changed since the result in " + folder.path() +
                     " was made for it; make the result again, or name a part to judge it against by `part`");
}

std::string absolute(const std::string& file) { return std::filesystem::absolute(file).lexically_normal().string(); }

/// The verdict, tied to what it is about.
void write_verdict(ResultFolder& folder, const PartStamp& part, const std::map<std::string, std::string>& files,
                   Verification& outcome) {
  if (!folder.writable()) {
    outcome.notes.push_back(folder.path() + " may not be written: the verdict is not in it");
    return;
  }
  Manifest manifest{
      .made_by = kMadeByVerify, .folder = absolute(folder.path()), .part = part, .judged = {}, .files = {}};
  // The folder stays that to which job.json's paths belong: both may have moved since, more than once.
  if (folder.manifest()) manifest = *folder.manifest();
  if (manifest.made_by == kMadeByVerify) manifest.part = part;
  manifest.judged = part;
  folder.add(files, std::move(manifest));
}

/// `named`: the part, as job.json has it.
template <class Job>
Verification judge_folder(const VerifyJob& request, const Job& job, const std::string& named, ResultFolder& folder) {
  const auto file = [&](const char* name) { return (std::filesystem::path(request.folder) / name).string(); };
  Verification outcome;
  outcome.job = job;
  const Tool tool = read_and_equip(file("tool.json"), body_of(request.obstacles, job.obstacles));
  const Path path = read_path(file("path.json"));
  std::vector<std::string> repairs;  // told when the folder was made
  const Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, repairs);
  outcome.notes.assign(repairs.begin() + static_cast<std::ptrdiff_t>(setup.part.repairs.size()), repairs.end());
  check_origin(request, folder, setup.part, outcome);
  require_known_faces(path, setup.part, file("path.json"));
  outcome.report = judge_job(setup, job.judge, tool, path);
  const ClearanceScene scene = make_clearance_scene(setup, job.obstacles, has_body(tool), outcome.notes);
  outcome.report.clearance = measure_clearance(scene, tool, path);
  outcome.acceptance = accept(tool, outcome.report, job.judge.least_coverage);
  write_verdict(folder, {absolute(request.part ? *request.part : named), setup.part.sha256},
                {{"verify.json", verify_to_json(outcome.report, outcome.acceptance)},
                 {"view.json", view_to_json(make_view(outcome.job, setup, tool, path, outcome.report))}},
                outcome);
  return outcome;
}

}  // namespace

Verification run_verify(const VerifyJob& request) {
  check_fields(request);
  ResultFolder folder(request.folder, ResultFolder::Use::kWriteOrRead);
  const std::string file = (std::filesystem::path(request.folder) / "job.json").string();
  if (!std::filesystem::exists(file))
    throw InputError(file + ": is not there; a folder written by `flank fit` is needed");
  PlanJob plan = job_from_json(read_file(file), file);
  return std::visit(
      [&](auto& job) {
        const std::string named = job.part.file;
        follow_moved(folder, job);
        apply(request, job);
        return judge_folder(request, job, named, folder);
      },
      plan);
}

}  // namespace flank
