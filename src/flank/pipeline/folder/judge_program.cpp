#include "flank/pipeline/folder/judge_program.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "flank/artefact/acceptance.h"
#include "flank/artefact/post_text.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/machine/backplot.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/read/read_nc.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/folder/judge_job.h"
#include "flank/pipeline/folder/machine_scene.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/tool_body.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

/// Of the tolerance: between the control's motion and the poses that stand for it.
constexpr double kChordShare = 1e-3;

/// What the judge needs beside the program.
struct Question {
  PartRequest part;
  ObstacleRequest obstacles;
  JudgeRequest judge;
  double tolerance_mm = 0.01;
  Tool tool;
};

template <class Job>
Question question_of(const VerifyJob& request, const Job& job) {
  Question q{machined(job), job.obstacles, job.judge, job.tolerance_mm, {}};
  const std::string tool = request.nc.tool.value_or((std::filesystem::path(request.folder) / "tool.json").string());
  q.tool = read_and_equip(tool, request.obstacles, job.obstacles);
  if (request.nc.faces) q.part.faces = *request.nc.faces, q.part.skin.reset();
  return q;
}

/// Without a folder all of it must be given.
FitJob job_of(const VerifyJob& request) {
  if (!request.part) throw UsageError("part", "is needed with `nc`, or a folder of results");
  if (!request.nc.tool) throw UsageError("tool", "is needed with `nc`, or a folder of results");
  FitJob job;
  job.part.file = *request.part;
  job.part.side = request.side;
  job.obstacles = request.obstacles;
  job.judge = {.least_coverage = job.judge.least_coverage,
               .sample_mm = request.sample_mm,
               .reach_radius_mm = request.reach_radius_mm};
  job.tolerance_mm = request.tolerance_mm.value_or(job.tolerance_mm);
  return job;
}

WorkSetup setup_of(const VerifyJob& request, const NcProgram& program, Verification& outcome) {
  if (request.nc.setup) return parse_setup(*request.nc.setup);
  if (!program.header.setup.empty()) try {
      return parse_setup(program.header.setup);
    } catch (const UsageError& e) {
      throw InputError(*request.nc.file + ": its header: " + e.what());
    }
  outcome.notes.push_back(
      "neither `setup` nor the program says where the part sits: its origin is taken as the table's");
  return {};
}

void add_findings(const std::string& file, Figure figure, const std::vector<LimitFinding>& findings,
                  Acceptance& acceptance) {
  for (const LimitFinding& f : findings)
    add_reason(acceptance, figure, fmt::format("{}: line {}: {}", file, f.line, f.text));
}

Verification judge(const VerifyJob& request, PlanJob job, const Question& q) {
  const std::string& file = *request.nc.file;
  Machine machine = read_machine(*request.nc.machine);
  const NcProgram program = read_nc(read_file(file), file, machine.dialect);
  Verification outcome;
  outcome.job = std::move(job);
  BackplotOptions options;
  options.setup = setup_of(request, program, outcome);
  options.tool_length = program.header.tool.length > 0.0 ? program.header.tool.length : machine.tool_length;
  options.tip_offset = machine.controlled == ControlledPoint::kLowest ? q.tool.radial.at(0.0).r : 0.0;
  options.axis_length = q.tool.radial.axis_length();
  options.chord = kChordShare * q.tolerance_mm;
  const Backplot plot = backplot(machine, program, file, options);
  std::vector<std::string> repairs;
  const Setup setup = read_setup(q.part, q.obstacles, q.tolerance_mm, repairs);
  outcome.report = judge_job(setup, q.judge, q.tool, plot.path);
  const ClearanceScene scene = make_clearance_scene(setup, q.obstacles, has_body(q.tool), outcome.notes);
  outcome.report.clearance = measure_clearance(scene, q.tool, plot.path);
  outcome.acceptance = accept(q.tool, outcome.report, q.judge.least_coverage);
  add_findings(file, Figure::kTravel, plot.travel, outcome.acceptance);
  add_findings(file, Figure::kAxisSpeed, plot.speed, outcome.acceptance);
  machine.tool_length = options.tool_length;
  MachineScene scene_of_machine = machine_scene(machine, q.tool, options.tip_offset);
  add_work(setup, q.obstacles, options.setup, scene_of_machine);
  const auto where = [&](std::size_t place) { return fmt::format("{}: line {}", file, plot.track_lines[place]); };
  judge_scene(machine, machine.tool_length, scene_of_machine, plot.track, where, outcome.acceptance);
  outcome.notes.push_back(fmt::format("{} on {}: {} moves in {}, as {} poses within {:.2g} mm of its motion",
                                      std::filesystem::path(file).filename().string(), machine.name,
                                      program.moves.size(), minutes_text(plot.time_s / 60.0), plot.path.pose_count(),
                                      plot.chord_bound_mm));
  return outcome;
}

}  // namespace

Verification judge_program(const VerifyJob& request) {
  if (!request.nc.machine) throw UsageError("machine", "is needed with `nc`: a name, or a file NAME.toml");
  if (request.folder.empty()) {
    const FitJob job = job_of(request);
    return judge(request, job, question_of(request, job));
  }
  const ResultFolder folder(request.folder, ResultFolder::Use::kRead);
  const FolderJob found = read_folder_job(request, folder);
  return std::visit([&](const auto& job) { return judge(request, job, question_of(request, job)); }, found.job);
}

}  // namespace flank::internal
