#include "flank/pipeline/folder/judge_wheel_program.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <utility>
#include <variant>

#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/folder/judge_roughing.h"
#include "flank/pipeline/folder/operation_run.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/pipeline/program/operation_words.h"
#include "flank/results/acceptance.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// What the operations of a program do, in the part's frame, with all copies.
struct Runs {
  Path finish;
  std::map<int, Path> rough;      ///< of each copy
  std::vector<Path> rough_steps;  ///< the first copy of each operation that roughs
};

std::string file_in(const std::string& folder, const char* name) { return (fs::path(folder) / name).string(); }

/// The steps that the program's operations are of, each with as many copies as the plan says.
std::vector<const WheelStep*> steps_of(const std::string& file, const WheelPlan& plan,
                                       const std::vector<NcProgram>& operations) {
  std::vector<const WheelStep*> done, each;
  for (const WheelStep& step : plan.steps)
    if (step.done) done.push_back(&step);
  for (const std::size_t k : folders_of(file, operations, done.size())) each.push_back(done[k]);
  for (std::size_t k = 0; k < each.size(); ++k) {
    const int copies = operations[k].header.operation.value_or(NcOperation{}).copies;
    if (copies != each[k]->copies)
      throw InputError(fmt::format("{}: operation {} has {} copies; expected the {} of operation {} in plan.json", file,
                                   k + 1, copies, each[k]->copies, each[k]->id));
  }
  return each;
}

void append(const Path& more, Path& to) { to.strips.insert(to.strips.end(), more.strips.begin(), more.strips.end()); }

/// Every operation alone: what its machine does, and whether it runs its path.
Runs run_all(const VerifyJob& request, ProgramQuestion question, const Setup& setup,
             const std::vector<const WheelStep*>& steps, const Machine& machine,
             const std::vector<NcProgram>& operations, Verification& all) {
  Runs runs;
  question.in_place = true;
  for (std::size_t k = 0; k < operations.size(); ++k) {
    const WheelStep& step = *steps[k];
    const bool rough = step.kind == "rough";
    question.tool = read_and_equip(file_in(step.folder, "tool.json"), request.obstacles, question.obstacles);
    if (!rough && read_file(file_in(step.folder, "tool.json")) != read_file(file_in(request.folder, "tool.json")))
      throw InputError(step.folder + ": its tool is not that of the wheel's folder; plan the wheel again");
    const NcOperation of = operations[k].header.operation.value_or(NcOperation{});
    Verification one;
    OperationRun run = run_operation(request, question, setup, machine, operations[k],
                                     read_path(file_in(step.folder, "path.json")), one);
    const std::string before = heading(of);
    add_under(before, one.acceptance, all.acceptance);
    for (const std::string& note : one.notes) all.notes.push_back(before + note);
    if (rough && of.copy == 1) runs.rough_steps.push_back(run.plot.path);
    append(run.plot.path, rough ? runs.rough[of.copy] : runs.finish);
  }
  return runs;
}

}  // namespace

Verification judge_wheel_program(const VerifyJob& request, const WheelPlan& plan, const Machine& machine,
                                 const std::vector<NcProgram>& operations) {
  if (request.nc.tool) throw UsageError("tool", "is for one operation; here each operation has its own tool");
  if (request.nc.faces) throw UsageError("faces", "are for one operation; here they are those of the wheel");
  if (request.nc.tool_number)
    throw UsageError("tool_number", "is for one operation; here each has its own number in the program");
  const std::vector<const WheelStep*> steps = steps_of(*request.nc.file, plan, operations);
  const ResultFolder folder(request.folder, ResultFolder::Use::kRead);
  Verification all;
  all.job = read_folder_job(request, folder).job;
  ProgramQuestion question = std::visit(
      [](const auto& job) {
        return ProgramQuestion{machined(job), job.obstacles, job.judge, job.tolerance_mm, {}};
      },
      all.job);
  std::vector<std::string> repairs;
  Setup setup = read_setup(question.part, question.obstacles, question.tolerance_mm, repairs);
  stand_whole(plan, setup);
  const Runs runs = run_all(request, question, setup, steps, machine, operations, all);
  std::vector<std::string> folders;
  for (const WheelStep* step : steps) folders.push_back(step->folder);
  accept_together(request, operations, folders, all.acceptance);
  const Tool tool = read_and_equip(file_in(request.folder, "tool.json"), request.obstacles, question.obstacles);
  all.report = judge_job(setup, question.judge, tool, runs.finish);
  const ClearanceScene scene = make_clearance_scene(setup, question.obstacles, has_body(tool), all.notes);
  measure_bodies(scene, tool, runs.finish, all.report);
  add_caveats(all.report, all.notes);
  prepend(accept(tool, all.report, question.judge), all.acceptance);
  Path rough;
  for (const auto& [copy, path] : runs.rough) append(path, rough);
  const std::optional<JudgedRoughing> roughing = judge_roughing(plan, setup, runs.rough_steps, rough);
  accept_steps(plan, roughing, all.acceptance);
  if (roughing) all.notes.push_back(roughing_text(*roughing));
  return all;
}

}  // namespace flank::internal
