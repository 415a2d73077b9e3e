#include "flank/pipeline/folder/judge_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <type_traits>

#include "flank/artefact/acceptance.h"
#include "flank/artefact/post_text.h"
#include "flank/error.h"
#include "flank/io/path/blank_json.h"
#include "flank/io/text/json_input.h"
#include "flank/machine/backplot.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/folder/judge_job.h"
#include "flank/pipeline/folder/machine_scene.h"
#include "flank/pipeline/program/followed_path.h"
#include "flank/pipeline/program/program_rapids.h"
#include "flank/pipeline/program/program_setup.h"
#include "flank/pipeline/program/stock_path.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/read_setup.h"
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
  std::optional<double> tolerance_mm;
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

WorkSetup setup_of(const VerifyJob& request, const NcProgram& program, Verification& outcome) {
  if (request.nc.setup) return parse_setup(*request.nc.setup);
  if (!program.header.setup.empty()) try {
      return parse_setup(program.header.setup);
    } catch (const UsageError& e) {
      throw InputError(*request.nc.file + ": its header: " + e.what());
    }
  outcome.notes.push_back(
      "neither `setup` nor the program gives the set-up: the part's origin is taken at the table's");
  return {};
}

void add_findings(const std::string& file, Figure figure, const std::vector<LimitFinding>& findings,
                  Acceptance& acceptance) {
  for (const LimitFinding& f : findings)
    add_reason(acceptance, figure, fmt::format("{}: line {}: {}", file, f.line, f.text));
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

/// A program that was looked at: what the reasons against it name.
struct Ran {
  const std::string& file;
  const NcProgram& program;
  const Backplot& plot;
};

/// Of the tolerance: how near a program keeps to its path. A post spends a hundredth of it.
constexpr double kFollowShare = 0.5;

/// Whether the program runs the folder's path. What it is on where, is known either way.
FollowedPath judge_way(const VerifyJob& request, const Question& q, double tolerance_mm, const Planned& planned,
                       const Ran& ran, Acceptance& acceptance) {
  FollowedPath followed =
      follow_path(*planned.path, ran.plot, {q.tool.radial.axis_length(), kFollowShare * tolerance_mm});
  if (request.nc.follow != "path" || followed.findings.empty()) return followed;
  const FollowFinding& first = followed.findings.front();
  std::string text = ran.file + ": " + (first.line > 0 ? fmt::format("line {}: ", first.line) : "") + first.text;
  if (followed.findings.size() > 1) text += fmt::format(", and {} more", followed.findings.size() - 1);
  add_reason(acceptance, Figure::kProgramPath, text + " (--follow any skips this check)");
  return followed;
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
void replay_stock(const Job& job, const Setup& setup, const Question& q, const Planned& planned,
                  const FollowedPath& followed, const Ran& ran, Verification& outcome) {
  if constexpr (std::is_same_v<Job, TrochoidJob>) {
    if (planned.blank.empty()) {
      outcome.notes.push_back("no blank.json: no stock simulation");
      return;
    }
    const StockPath cut = stock_path(ran.plot, *planned.path, followed.strips, q.tool.radial.axis_length());
    const std::vector<HalfSpace> blank = blank_of(planned.blank, setup.part.box);
    outcome.report.stock = judge_stock(setup, job, q.tool, cut.path, blank, 0.0).report;
    const StockReport& stock = *outcome.report.stock;
    const auto line = [&](std::size_t strip, std::size_t pose) {
      return fmt::format("{}: line {}", ran.file, cut.lines[strip][std::min(pose, cut.lines[strip].size() - 1)]);
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

/// Travel, speed, and what of the machine comes near.
void judge_machine(const Machine& machine, const Setup& setup, const Question& q, const BackplotOptions& options,
                   const Ran& ran, Acceptance& acceptance) {
  add_findings(ran.file, Figure::kTravel, ran.plot.travel, acceptance);
  add_findings(ran.file, Figure::kAxisSpeed, ran.plot.speed, acceptance);
  MachineScene scene = machine_scene(machine, q.tool, options.tip_offset);
  add_work(setup, q.obstacles, options.setup, scene);
  const auto where = [&](std::size_t place) {
    return fmt::format("{}: line {}", ran.file, ran.plot.track_lines[place]);
  };
  judge_scene(machine, machine.tool_length, scene, ran.plot.track, where, acceptance);
}

BackplotOptions options_of(const VerifyJob& request, const Question& q, double tolerance_mm, const Machine& machine,
                           const NcProgram& program, Verification& outcome) {
  BackplotOptions options;
  options.setup = setup_of(request, program, outcome);
  options.tool_length = program.header.tool.length > 0.0 ? program.header.tool.length : machine.tool_length;
  options.tip_offset = machine.controlled == ControlledPoint::kLowest ? q.tool.radial.at(0.0).r : 0.0;
  options.axis_length = q.tool.radial.axis_length();
  options.chord = kChordShare * tolerance_mm;
  return options;
}

template <class Job>
Verification judge(const VerifyJob& request, const Job& job, const Question& q) {
  const std::string& file = *request.nc.file;
  const Planned planned = planned_of(request, std::is_same_v<Job, TrochoidJob>);
  Machine machine = read_machine(*request.nc.machine);
  const NcProgram program = read_nc(read_file(file), file, machine.dialect);
  Verification outcome;
  outcome.job = job;
  std::vector<std::string> repairs;
  const Setup setup = read_setup(q.part, q.obstacles, q.tolerance_mm, repairs);
  const BackplotOptions options = options_of(request, q, setup.tolerance_mm, machine, program, outcome);
  const Backplot plot = backplot(machine, program, file, options);
  const Ran ran{file, program, plot};
  outcome.report = judge_job(setup, q.judge, q.tool, plot.path);
  const ClearanceScene scene = make_clearance_scene(setup, q.obstacles, has_body(q.tool), outcome.notes);
  measure_bodies(scene, q.tool, plot.path, outcome.report);
  outcome.acceptance = accept(q.tool, outcome.report, q.judge);
  accept_set_up(request.nc, program, machine, q.tool, options, outcome.acceptance);
  accept_rapids(file, setup, q.obstacles, q.tool, plot, outcome.acceptance);
  if (planned.path) {
    const FollowedPath followed = judge_way(request, q, setup.tolerance_mm, planned, ran, outcome.acceptance);
    replay_stock(job, setup, q, planned, followed, ran, outcome);
  }
  machine.tool_length = options.tool_length;
  judge_machine(machine, setup, q, options, ran, outcome.acceptance);
  outcome.notes.push_back(fmt::format("{} on {}: {} moves in {}, as {} CL points within {:.2g} mm of its motion",
                                      std::filesystem::path(file).filename().string(), machine.name,
                                      program.moves.size(), minutes_text(plot.time_s / 60.0), plot.path.pose_count(),
                                      plot.chord_bound_mm));
  return outcome;
}

}  // namespace

Verification judge_program(const VerifyJob& request) {
  if (!request.nc.machine) throw UsageError("machine", "must be given with `nc`: a name, or a file NAME.toml");
  if (request.folder.empty()) {
    const FitJob job = job_of(request);
    return judge(request, job, question_of(request, job));
  }
  const ResultFolder folder(request.folder, ResultFolder::Use::kRead);
  const FolderJob found = read_folder_job(request, folder);
  return std::visit([&](const auto& job) { return judge(request, job, question_of(request, job)); }, found.job);
}

}  // namespace flank::internal
