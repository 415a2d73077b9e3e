#include "flank/pipeline/folder/judge_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <type_traits>

#include "flank/error.h"
#include "flank/io/path/blank_json.h"
#include "flank/io/text/json_input.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/folder/judge_wheel_program.h"
#include "flank/pipeline/folder/operation_run.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/pipeline/program/operation_words.h"
#include "flank/pipeline/program/program_rapids.h"
#include "flank/pipeline/program/stock_path.h"
#include "flank/results/acceptance.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

template <class Job>
ProgramQuestion question_of(const VerifyJob& request, const Job& job) {
  ProgramQuestion q{machined(job), job.obstacles, job.judge, job.tolerance_mm, {}};
  const std::string tool = request.nc.tool.value_or((std::filesystem::path(request.folder) / "tool.json").string());
  q.tool = read_and_equip(tool, request.obstacles, job.obstacles);
  if (request.nc.faces) q.part.faces = *request.nc.faces, q.part.skin.reset();
  return q;
}

/// Without a folder all of it must be given.
FitJob job_of(const VerifyJob& request) {
  if (!request.part) throw UsageError("part", "must be given with `nc`, unless a result folder is");
  if (!request.nc.tool) throw UsageError("tool", "must be given with `nc`, unless a result folder is");
  FitJob job;
  job.part.file = *request.part;
  job.part.side = request.side;
  job.obstacles = request.obstacles;
  job.judge = {.least_coverage = job.judge.least_coverage,
               .sample_mm = request.sample_mm,
               .reach_radius_mm = request.reach_radius_mm};
  job.tolerance_mm = request.tolerance_mm;
  return job;
}

/// What the program is to be, of a folder.
struct Planned {
  std::optional<Path> path;
  std::string blank;  ///< blank.json; empty: of no cavity
};

Planned planned_of(const VerifyJob& request, bool cavity) {
  const auto file = [&](const char* name) { return (std::filesystem::path(request.folder) / name).string(); };
  Planned planned;
  if (request.folder.empty()) return planned;
  planned.path = read_path(file("path.json"));
  if (cavity && std::filesystem::exists(file("blank.json"))) planned.blank = file("blank.json");
  return planned;
}

/// The blank of blank.json as far as the part goes: its half spaces need not close, and a program, unlike a path, comes and goes
/// beside the part.
std::vector<HalfSpace> blank_of(const std::string& file, const Box3& part) {
  std::vector<HalfSpace> blank = blank_from_json(read_file(file), file);
  for (int k = 0; k < 3; ++k) {
    blank.push_back({Vec3::Unit(k), part.high[k]});
    blank.push_back({-Vec3::Unit(k), -part.low[k]});
  }
  return blank;
}

/// The stock that is cut by the program: engagement and what is left, as of a path.
template <class Job>
void replay_stock(const Job& job, const Setup& setup, const ProgramQuestion& q, const Planned& planned,
                  const std::string& file, const OperationRun& run, Verification& outcome) {
  if constexpr (std::is_same_v<Job, TrochoidJob>) {
    if (planned.blank.empty()) {
      outcome.notes.push_back("no blank.json: no stock simulation");
      return;
    }
    const StockPath cut = stock_path(run.plot, *planned.path, run.followed.strips, q.tool.radial.axis_length());
    const std::vector<HalfSpace> blank = blank_of(planned.blank, setup.part.box);
    outcome.report.stock = judge_stock(setup, job, q.tool, cut.path, blank, 0.0).report;
    const StockReport& stock = *outcome.report.stock;
    const auto line = [&](std::size_t strip, std::size_t pose) {
      return fmt::format("{}: line {}", file, cut.lines[strip][std::min(pose, cut.lines[strip].size() - 1)]);
    };
    accept_stock(stock, job.cycles.most_engagement_deg, setup.tolerance_mm, outcome.acceptance, line);
    const double grain = std::pow(stock.cell_mm, 3);  // less is the grid's
    for (std::size_t k = 0; k < cut.path.strips.size(); ++k)
      if (cut.path.strips[k].kind == kRapidKind && stock.strip_mm3[k] > grain) {
        add_reason(outcome.acceptance, Figure::kRapid,
                   fmt::format("{}: stock simulation: a rapid move cuts {:.3g} mm^3 of the stock", line(k, 1),
                               stock.strip_mm3[k]));
        return;
      }
  }
}

template <class Job>
Verification judge(const VerifyJob& request, const Job& job, const ProgramQuestion& q, const Machine& machine,
                   const NcProgram& program) {
  const Planned planned = planned_of(request, std::is_same_v<Job, TrochoidJob>);
  Verification outcome;
  outcome.job = job;
  std::vector<std::string> repairs;
  const Setup setup = read_setup(q.part, q.obstacles, q.tolerance_mm, repairs);
  const OperationRun run = run_operation(request, q, setup, machine, program, planned.path, outcome);
  outcome.report = judge_job(setup, q.judge, q.tool, run.plot.path);
  const ClearanceScene scene = make_clearance_scene(setup, q.obstacles, has_body(q.tool), outcome.notes);
  measure_bodies(scene, q.tool, run.plot.path, outcome.report);
  add_caveats(outcome.report, outcome.notes);
  prepend(accept(q.tool, outcome.report, q.judge), outcome.acceptance);
  if (planned.path) replay_stock(job, setup, q, planned, *request.nc.file, run, outcome);
  return outcome;
}

/// One operation, or a program that is one, of the folder of `request`.
Verification judge_operation(const VerifyJob& request, const Machine& machine, const NcProgram& program) {
  if (request.folder.empty()) {
    const FitJob job = job_of(request);
    return judge(request, job, question_of(request, job), machine, program);
  }
  const ResultFolder folder(request.folder, ResultFolder::Use::kRead);
  const FolderJob found = read_folder_job(request, folder);
  return std::visit([&](const auto& job) { return judge(request, job, question_of(request, job), machine, program); },
                    found.job);
}

Verification judge_operations(const VerifyJob& request, const std::vector<std::string>& folders, const Machine& machine,
                              const std::vector<NcProgram>& operations) {
  if (request.nc.tool) throw UsageError("tool", "is for one operation; here each folder has its own tool");
  if (request.nc.faces) throw UsageError("faces", "are for one operation; here each folder has its own faces");
  if (request.nc.tool_number)
    throw UsageError("tool_number", "is for one operation; here each has its own number in the program");
  require_operations(*request.nc.file, operations, folders.size());
  std::vector<std::string> each;  // the folder of each operation
  for (const std::size_t k : folders_of(*request.nc.file, operations, folders.size())) each.push_back(folders[k]);
  Verification all;
  for (std::size_t k = 0; k < operations.size(); ++k) {
    VerifyJob one = request;
    one.folder = each[k];
    one.more_folders.clear();
    const std::string before = heading(operations[k].header.operation.value_or(NcOperation{}));
    Verification judged = judge_operation(one, machine, operations[k]);
    add_under(before, judged.acceptance, all.acceptance);
    all.operation_names.push_back(before.substr(0, before.size() - 2));
    all.operations.push_back(std::move(judged));
  }
  accept_together(request, operations, each, all.acceptance);
  all.job = all.operations.front().job;
  return all;
}

}  // namespace

Verification judge_program(const VerifyJob& request) {
  if (!request.nc.machine) throw UsageError("machine", "must be given with `nc`: a name, or a file NAME.toml");
  const std::string& file = *request.nc.file;
  const Machine machine = read_machine(*request.nc.machine);
  const std::vector<NcProgram> operations = read_nc_operations(read_file(file), file, machine.dialect);
  if (!request.folder.empty() && request.more_folders.empty())
    if (const std::optional<WheelPlan> plan = read_wheel_plan(request.folder))
      return judge_wheel_program(request, *plan, machine, operations);
  if (operations.size() == 1 && request.more_folders.empty())
    return judge_operation(request, machine, operations.front());
  if (request.folder.empty())
    throw InputError(
        fmt::format("{}: has {} operations; give the folder of each, in their order", file, operations.size()));
  std::vector<std::string> folders{request.folder};
  folders.insert(folders.end(), request.more_folders.begin(), request.more_folders.end());
  return judge_operations(request, folders, machine, operations);
}

}  // namespace flank::internal
