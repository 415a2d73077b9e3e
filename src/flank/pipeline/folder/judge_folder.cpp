#include "flank/pipeline/folder/judge_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <type_traits>

#include "flank/base/tolerance_budget.h"
#include "flank/error.h"
#include "flank/io/face_names.h"
#include "flank/io/path/blank_json.h"
#include "flank/io/path/engagement_json.h"
#include "flank/io/text/json_input.h"
#include "flank/job/check_fields.h"
#include "flank/job/input_files.h"
#include "flank/manifest/folder_inputs.h"
#include "flank/manifest/result_folder.h"
#include "flank/path/bend_radius.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/folder/judge_program.h"
#include "flank/pipeline/folder/judge_roughing.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/pipeline/load/bending.h"
#include "flank/results/acceptance.h"
#include "flank/results/verify_json.h"
#include "flank/results/view.h"
#include "flank/results/view_json.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/shank_reach.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

/// A path may only be about faces that the part has.
void require_known_faces(const Path& path, const Part& part, const std::string& file) {
  int last = part.is_mesh() ? part.face_count() : 0;
  for (const Face& face : part.faces) last = std::max(last, parse_face_name(face.id).number);
  for (const Strip& strip : path.strips)
    for (const std::string& item : face_list_items(strip.face))
      if (parse_face_name(item).number > last)
        throw InputError(fmt::format("{}: pass {} is of face {}, but {} has the faces F1 to F{} only", file, strip.id,
                                     item, part.file, last));
}

/// Whether tool, path and part are those that the result was made of: throws InputError where they are not, notes where
/// nobody knows.
void check_origin(const VerifyJob& request, const ResultFolder& folder, const Part& part, Verification& outcome) {
  const std::optional<Manifest>& manifest = folder.manifest();
  if (!manifest) {
    outcome.notes.push_back(std::string("no ") + kManifestFile + ": tool and path may not belong together");
    return;
  }
  // Where tool and path came from elsewhere, they may come from there again; the verdict is made anew.
  if (manifest->made_by == kMadeByVerify) return;
  folder.require_whole({"verify.json", "view.json"});
  if (!request.part && part.sha256 != manifest->part.sha256)
    throw InputError(part.file + ": has changed since the result in " + folder.path() +
                     " was made for it; make the result again, or name a part to check it against by `part`");
}

std::string absolute(const std::string& file) { return std::filesystem::absolute(file).lexically_normal().string(); }

/// The verdict, tied to what it is about.
void write_verdict(ResultFolder& folder, const PartStamp& part, const FileTexts& files, Verification& outcome) {
  if (!folder.writable()) {
    outcome.notes.push_back(folder.path() + " is not writable: the verdict is printed, but not stored there");
    return;
  }
  Manifest manifest{.made_by = kMadeByVerify,
                    .folder = absolute(folder.path()),
                    .part = part,
                    .judged = {},
                    .inputs = {},
                    .files = {}};
  // The folder stays that to which job.json's paths belong: both may have moved since, more than once.
  if (folder.manifest()) manifest = *folder.manifest();
  if (manifest.made_by == kMadeByVerify) manifest.part = part;
  manifest.judged = part;
  folder.add(files, std::move(manifest));
}

/// The program of a cavity in the stock that blank.json describes: its engagement, pose by pose. Other jobs have none.
struct FolderStock {
  PathEngagement engagement;
  PathArcs arcs;
};
template <class Job>
FolderStock replay_stock(const Job& job, const Setup& setup, const Tool& tool, const Path& path,
                         const std::string& file, Verification& outcome) {
  if constexpr (std::is_same_v<Job, TrochoidJob>) {
    if (!std::filesystem::exists(file)) {
      outcome.notes.push_back("no blank.json: no stock simulation");
      return {};
    }
    ProgramStock stock = judge_stock(setup, job, tool, path, blank_from_json(read_file(file), file), 0.0);
    outcome.report.stock = std::move(stock.report);
    return {std::move(stock.engagement), std::move(stock.arcs)};
  }
  return {};
}

/// Of a cavity: what its stock shows, and what was not planned of it.
template <class Job>
void accept_program(const Job& job, const std::string& summary, Verification& outcome) {
  if constexpr (std::is_same_v<Job, TrochoidJob>) {
    if (std::filesystem::exists(summary)) keep_planned(read_file(summary), summary, outcome.acceptance);
    if (outcome.report.stock)
      accept_stock(*outcome.report.stock, job.cycles.most_engagement_deg, outcome.report.tolerance_mm,
                   outcome.acceptance);
  }
}

/// Of a wheel's folder: that its path is that of its operations, and roughing.
void judge_steps(const std::string& folder, const std::optional<WheelPlan>& plan, const Setup& setup, const Path& path,
                 Verification& outcome) {
  if (!plan) return;
  require_steps_make(*plan, path, (std::filesystem::path(folder) / "path.json").string());
  const std::optional<JudgedRoughing> roughing = judge_roughing(*plan, setup);
  accept_steps(*plan, roughing, outcome.acceptance);
  if (roughing) outcome.notes.push_back(roughing_text(*roughing));
}

/// `named`: the part, as job.json has it.
template <class Job>
Verification judge_path(const VerifyJob& request, const Job& job, const std::string& named, ResultFolder& folder) {
  const auto file = [&](const char* name) { return (std::filesystem::path(request.folder) / name).string(); };
  Verification outcome;
  outcome.job = job;
  Tool tool = read_and_equip(file("tool.json"), request.obstacles, job.obstacles);
  const Path path = read_path(file("path.json"));
  std::vector<std::string> repairs;  // told when the folder was made
  Setup setup = read_setup(machined(job), job.obstacles, job.tolerance_mm, repairs);
  const std::optional<WheelPlan> plan = read_wheel_plan(request.folder);
  if (plan) stand_whole(*plan, setup);
  outcome.notes.assign(repairs.begin() + static_cast<std::ptrdiff_t>(setup.part.repairs.size()), repairs.end());
  if (request.obstacles.shank == "auto") {
    ObstacleRequest chosen = request.obstacles;
    choose_shank(tool, path, setup.part.box, chosen);
    equip_tool(chosen, tool);
    outcome.notes.push_back(chosen_shank_text(tool, chosen));
  }
  check_origin(request, folder, setup.part, outcome);
  require_known_faces(path, setup.part, file("path.json"));
  outcome.report = judge_job(setup, job.judge, tool, path);
  const ClearanceScene scene = make_clearance_scene(setup, job.obstacles, has_body(tool), outcome.notes);
  measure_bodies(scene, tool, path, outcome.report);
  add_caveats(outcome.report, outcome.notes);
  const FolderStock stock = replay_stock(job, setup, tool, path, file("blank.json"), outcome);
  std::optional<BendingTool> bending;
  if (request.bending.on) {
    bending.emplace(request.bending, stock.arcs, setup, tool, judged_tool(setup, tool), path);
    outcome.report.bending = bending->report(setup, coarse_spacing(setup, kMostBent));
    bending->add_notes(outcome.report.bending, outcome.notes);
  }
  outcome.acceptance = accept(tool, outcome.report, job.judge);
  accept_program(job, file("summary.json"), outcome);
  const double chord_mm = kToleranceBudget.chord * setup.tolerance_mm;
  accept_bends(job, least_bend_radii(path, tool.radial.axis_length(), chord_mm), outcome.acceptance);
  judge_steps(request.folder, plan, setup, path, outcome);
  FileTexts files{{"verify.json", verify_to_json(outcome.report, outcome.acceptance)},
                  {"view.json", view_to_json(make_view(outcome.job, setup, tool, path, outcome.report,
                                                       bending ? bending->errors() : nullptr))}};
  if (!stock.engagement.empty()) files["engagement.json"] = engagement_to_json(stock.engagement, stock.arcs);
  write_verdict(folder, {absolute(request.part ? *request.part : named), setup.part.sha256}, files, outcome);
  return outcome;
}

}  // namespace

Verification judge_folder(const VerifyJob& request) {
  ResultFolder folder(request.folder, ResultFolder::Use::kWriteOrRead);
  folder.require_there({"job.json", "tool.json", "path.json"});
  FolderJob found = read_folder_job(request, folder);
  ReadFiles inputs = inputs_of_folder(request.folder);
  inputs.add(read_files(found.job));
  // Before the work, what writing the verdict would refuse after it.
  const Unwritten unwritten(inputs);
  if (folder.writable())
    for (const char* name : {"verify.json", "view.json"}) folder.require_own(name);
  return std::visit([&](auto& job) { return judge_path(request, job, found.named_part, folder); }, found.job);
}

}  // namespace flank::internal

namespace flank {

Verification run_verify(const VerifyJob& request) {
  internal::check_fields(request);
  internal::require_bending(request.bending);
  if (request.nc.file) return internal::judge_program(request);
  if (!request.more_folders.empty())
    throw UsageError("more_folders",
                     "several folders need a program by `nc`; without one, one folder is checked at a time");
  if (request.folder.empty()) throw UsageError("folder", "give a result folder, or an NC program by `nc`");
  return internal::judge_folder(request);
}

}  // namespace flank
