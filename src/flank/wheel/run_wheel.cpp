#include "flank/wheel/run_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <variant>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/feature/recognise_wheel.h"
#include "flank/feature/wheel_table.h"
#include "flank/io/mesh/write_mesh.h"
#include "flank/job/input_files.h"
#include "flank/job/wheel_fields.h"
#include "flank/pipeline/folder/judge_roughing.h"
#include "flank/pipeline/folder/machine_tilt.h"
#include "flank/results/write_result.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"
#include "flank/wheel/blank.h"
#include "flank/wheel/face_operations.h"
#include "flank/wheel/floor_operation.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/operations.h"
#include "flank/wheel/plan_file.h"
#include "flank/wheel/rest_places.h"
#include "flank/wheel/rough_operation.h"
#include "flank/wheel/shanks.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

void check(const WheelRequest& job) {
  check_fields(job);
  if (job.machine) (void)machine_tilt_deg(*job.machine);
  // Read for its errors alone, before minutes are spent on a plan.
  if (job.holder) (void)holder_outline(*job.holder);
  if (job.holder && job.tool && brings_body(*job.tool))
    throw UsageError("holder", "is for a tool that brings neither shank nor holder; expected one of them");
  if (job.blank && !job.rough) throw UsageError("blank", "is for roughing, which is left out");
}

double tilt_of(const WheelRequest& job) {
  return job.machine ? std::min(job.most_tilt_deg, machine_tilt_deg(*job.machine)) : job.most_tilt_deg;
}

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(fs::path(folder) / "tools", error);
  fs::create_directories(fs::path(folder) / "ops", error);
  if (!fs::is_directory(fs::path(folder) / "ops")) throw InputError(folder + ": is not a folder and cannot be created");
}

/// The part as the whole was judged on it.
Setup setup_of(const Result& whole) {
  std::vector<std::string> told;
  return std::visit([&](const auto& job) { return read_setup(machined(job), job.obstacles, job.tolerance_mm, told); },
                    whole.job);
}

/// The files of the result of all sectors, with the verdict on all operations in them.
void write_whole(const WheelResult& result, const std::string& folder) {
  const ReadFiles inputs = read_files(result.whole->job);
  const Unwritten unwritten(inputs);
  ResultFolder held(folder, ResultFolder::Use::kWrite);
  held.require_not_inputs(inputs);
  held.replace(result_files(*result.whole, result.acceptance()), result_manifest(*result.whole, held));
}

/// The whole of what finishes something, its figures and what it leaves, into the wheel's folder.
void judge(WheelWork& work, WheelResult& result) {
  if (work.finish.strips.empty()) return;
  result.whole = judge_whole(work);
  result.figures = role_figures(result.roles, result.whole->verify);
  const WheelPlan plan = *read_wheel_plan(work.job.folder);
  Setup setup = setup_of(*result.whole);
  stand_whole(plan, setup);
  result.roughing = judge_roughing(plan, setup);
  write_whole(result, work.job.folder);
  WheelRest rest = rest_of(work, *result.whole);
  result.rest = std::move(rest.places);
  if (!rest.mesh.triangles.empty()) write_mesh((fs::path(work.job.folder) / "rest.stl").string(), rest.mesh);
}

/// blank.stl in the folder; none where nothing is roughed.
WheelBlank make_blank(const WheelRequest& job, const Part& part, WheelResult& result) {
  if (!job.rough) return {};
  WheelBlank blank = job.blank ? read_blank(*job.blank, job.unit, result.roles.axis)
                               : turned_blank(part, result.roles, job.allowance_mm);
  ReadFiles inputs;
  inputs.add(job.part, "as `part`");
  if (job.blank) inputs.add(*job.blank, "as `blank`");
  if (job.holder && fs::exists(*job.holder)) inputs.add(*job.holder, "as `holder`");
  const Unwritten unwritten(inputs);
  write_mesh((fs::path(job.folder) / "blank.stl").string(), blank.body);
  result.blank = job.blank.value_or("turned");
  result.most_engagement_deg = job.most_engagement_deg;
  result.most_free_mm = most_free_mm(job, result.roles);
  return blank;
}

}  // namespace

WheelResult run_wheel(const WheelRequest& job, const Progress& progress) {
  check(job);
  progress.step("read", 0.0);
  const Part part = read_part(job.part, job.unit);
  WheelResult result;
  result.roles = recognise_wheel(part, {job.hub, job.blades, job.splitters, job.count});
  const WheelSector sector = make_sector(result.roles);
  result.copies = sector.copies, result.lacking = missing_blades(result.roles, sector);
  make_folder(job.folder);
  const std::string file = (fs::path(job.folder) / "plan.json").string();
  PlanKeeper plan(file, result);
  const WheelBlank blank = make_blank(job, part, result);
  WheelWork work{
      job, result.roles, sector, part, blank, FaceTargets(part), wheel_faces(part), finished_operations(file)};
  work.most_tilt_deg = tilt_of(job);
  work.begins = [&](const std::string& id) { plan.begin(id); };
  const auto run = [&](WheelOperation operation) {
    plan.add(std::move(operation));
    // What is finished is in the folder, and the verdict on a part of it would be worth nothing.
    if (progress.stop()) throw Stopped();
  };
  write_file((fs::path(job.folder) / "wheel.json").string(), wheel_json(result.roles));
  run(side_operation(work, progress.part(0.0, 0.4)));
  result.copies = work.copies(), result.hub_sectors = work.sectors_of_hub(), result.up = work.up(),
  result.notes = work.notes;
  run(floor_operation(work, progress.part(0.4, 0.5)));
  progress.step("edges", 0.5);
  const auto has = [&](const auto& some) { return std::any_of(sector.blades.begin(), sector.blades.end(), some); };
  const bool fillets = has([](const WheelBlade&blade) { return !blade.fillets.empty(); }),
             edges = has([](const WheelBlade&blade) { return !blade.edges.empty(); });
  if (fillets)
    if (std::optional<WheelOperation> operation = fillet_operation(work)) run(std::move(*operation));
  // A round vane has none.
  if (job.edges && edges) run(edge_operation(work));
  if (std::optional<WheelOperation> operation = rest_operation(work)) run(std::move(*operation));
  progress.step("rough", 0.6);
  if (job.rough)
    for (WheelOperation& operation : rough_operations(work)) run(std::move(operation));
  progress.step("verify", 0.8);
  work.forget();
  give_shanks(work, result.operations, result.notes);
  judge(work, result);
  plan.end();
  return result;
}

}  // namespace flank::internal
