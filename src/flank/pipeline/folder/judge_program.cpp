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
#include "flank/machine/backplot.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/folder/judge_job.h"
#include "flank/pipeline/folder/machine_scene.h"
#include "flank/pipeline/folder/operation_words.h"
#include "flank/pipeline/folder/turned_copies.h"
#include "flank/pipeline/program/followed_path.h"
#include "flank/pipeline/program/program_rapids.h"
#include "flank/pipeline/program/program_setup.h"
#include "flank/pipeline/program/stock_path.h"
#include "flank/results/acceptance.h"
#include "flank/results/post_text.h"
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

/// The path of a turned copy, where the path of the folder is: turned, the part is the same.
void turn_back(const std::string& file, const NcProgram& program, const Setup& setup, Backplot& plot) {
  const std::optional<NcOperation>& of = program.header.operation;
  if (!of || of->copies == 1) return;
  CopyAxis axis;
  try {
    axis = parse_copy_axis(program.header.copy_axis);
  } catch (const UsageError& e) {
    throw InputError(file + ": its header (COPIES ABOUT): " + e.what());
  }
  if (of->copy == 1) require_same_when_turned(setup, axis, of->copies);
  plot.path = turned(std::move(plot.path), copy_turn(axis, of->copy, of->copies).inverse());
}

template <class Job>
Verification judge(const VerifyJob& request, const Job& job, const Question& q, Machine machine,
                   const NcProgram& program) {
  const std::string& file = *request.nc.file;
  const Planned planned = planned_of(request, std::is_same_v<Job, TrochoidJob>);
  Verification outcome;
  outcome.job = job;
  std::vector<std::string> repairs;
  const Setup setup = read_setup(q.part, q.obstacles, q.tolerance_mm, repairs);
  const BackplotOptions options = options_of(request, q, setup.tolerance_mm, machine, program, outcome);
  Backplot plot = backplot(machine, program, file, options);
  turn_back(file, program, setup, plot);
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

/// What operations must have in common, and what not.
void accept_together(const VerifyJob& request, const std::vector<NcProgram>& operations, std::size_t copies,
                     const std::vector<std::string>& folders, Acceptance& acceptance) {
  const std::string& file = *request.nc.file;
  const auto tool_file = [&](std::size_t k) {
    return read_file((std::filesystem::path(folders[k / copies]) / "tool.json").string());
  };
  const NcHeader& first = operations.front().header;
  for (std::size_t k = 1; k < operations.size(); ++k) {
    const NcHeader& header = operations[k].header;
    if (!request.nc.setup && (header.setup != first.setup || header.origin != first.origin))
      add_reason(acceptance, Figure::kSetup,
                 fmt::format("{}: operation {} has set-up {}, the first one {}; expected one set-up", file, k + 1,
                             header.setup, first.setup));
    if (header.copy_axis != first.copy_axis)
      add_reason(acceptance, Figure::kSetup,
                 fmt::format("{}: operation {} turns its copies about {}, the first one about {}", file, k + 1,
                             header.copy_axis, first.copy_axis));
    for (std::size_t i = 0; i < k; ++i)
      if (operations[i].header.tool.number == header.tool.number && tool_file(i) != tool_file(k))
        add_reason(acceptance, Figure::kToolNumber,
                   fmt::format("{}: operations {} and {} have two different tools, and both call tool {}", file, i + 1,
                               k + 1, header.tool.number));
  }
}

Verification judge_operations(const VerifyJob& request, const std::vector<std::string>& folders, const Machine& machine,
                              const std::vector<NcProgram>& operations) {
  if (request.nc.tool) throw UsageError("tool", "is of one operation; each folder has its own");
  if (request.nc.faces) throw UsageError("faces", "are of one operation; each folder has its own");
  if (request.nc.tool_number) throw UsageError("tool_number", "is of one operation; each has its own in its header");
  require_operations(*request.nc.file, operations, folders.size());
  const std::size_t copies = operations.size() / folders.size();
  Verification all;
  for (std::size_t k = 0; k < operations.size(); ++k) {
    VerifyJob one = request;
    one.folder = folders[k / copies];
    one.more_folders.clear();
    const std::string before = heading(operations[k].header.operation.value_or(NcOperation{}));
    Verification judged = judge_operation(one, machine, operations[k]);
    for (const Shortfall& reason : judged.acceptance.reasons)
      all.acceptance.reasons.push_back({reason.figure, before + reason.text});
    for (const Shortfall& caution : judged.acceptance.cautions)
      all.acceptance.cautions.push_back({caution.figure, before + caution.text});
    all.operation_names.push_back(before.substr(0, before.size() - 2));
    all.operations.push_back(std::move(judged));
  }
  accept_together(request, operations, copies, folders, all.acceptance);
  all.job = all.operations.front().job;
  return all;
}

}  // namespace

Verification judge_program(const VerifyJob& request) {
  if (!request.nc.machine) throw UsageError("machine", "must be given with `nc`: a name, or a file NAME.toml");
  const std::string& file = *request.nc.file;
  const Machine machine = read_machine(*request.nc.machine);
  const std::vector<NcProgram> operations = read_nc_operations(read_file(file), file, machine.dialect);
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
