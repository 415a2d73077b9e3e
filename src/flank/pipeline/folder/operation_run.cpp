#include "flank/pipeline/folder/operation_run.h"

#include <fmt/format.h>

#include <filesystem>

#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/pipeline/folder/machine_scene.h"
#include "flank/pipeline/program/program_rapids.h"
#include "flank/pipeline/program/program_setup.h"
#include "flank/results/acceptance.h"
#include "flank/results/post_text.h"

namespace flank::internal {
namespace {

/// Of the tolerance: between the control's motion and the poses that stand for it.
constexpr double kChordShare = 1e-3;

WorkSetup setup_of(const VerifyJob& request, const NcProgram& program, Verification& outcome) {
  if (request.nc.setup) return parse_setup(*request.nc.setup);
  if (!program.header.setup.empty()) try {
      return parse_setup(program.header.setup);
    } catch (const UsageError& e) {
      throw InputError(*request.nc.file + ": its header: " + e.what());
    }
  outcome.notes.push_back(
      "neither `setup` nor the program gives the set-up: the part's origin is assumed at the table's origin");
  return {};
}

void add_findings(const std::string& file, Figure figure, const std::vector<LimitFinding>& findings,
                  Acceptance& acceptance) {
  for (const LimitFinding& f : findings)
    add_reason(acceptance, figure, fmt::format("{}: line {}: {}", file, f.line, f.text));
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
FollowedPath judge_way(const VerifyJob& request, const ProgramQuestion& q, double tolerance_mm, const Path& planned,
                       const Ran& ran, Acceptance& acceptance) {
  FollowedPath followed = follow_path(planned, ran.plot, {q.tool.radial.axis_length(), kFollowShare * tolerance_mm});
  if (request.nc.follow != "path" || followed.findings.empty()) return followed;
  const FollowFinding& first = followed.findings.front();
  std::string text = ran.file + ": " + (first.line > 0 ? fmt::format("line {}: ", first.line) : "") + first.text;
  if (followed.findings.size() > 1) text += fmt::format(", and {} more", followed.findings.size() - 1);
  add_reason(acceptance, Figure::kProgramPath, text + " (--follow any skips this check)");
  return followed;
}

/// Travel, speed, and what of the machine comes near.
void judge_machine(const Machine& machine, const Setup& setup, const ProgramQuestion& q, const BackplotOptions& options,
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

BackplotOptions options_of(const VerifyJob& request, const ProgramQuestion& q, double tolerance_mm,
                           const Machine& machine, const NcProgram& program, Verification& outcome) {
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
  const Eigen::Isometry3d turn = turn_of(file, program);
  if (of->copy == 1) require_same_when_turned(setup, parse_copy_axis(program.header.copy_axis), of->copies);
  plot.path = turned(std::move(plot.path), turn.inverse());
}

}  // namespace

Eigen::Isometry3d turn_of(const std::string& file, const NcProgram& program) {
  const std::optional<NcOperation>& of = program.header.operation;
  if (!of || of->copies == 1) return Eigen::Isometry3d::Identity();
  try {
    return copy_turn(parse_copy_axis(program.header.copy_axis), of->copy, of->copies);
  } catch (const UsageError& e) {
    throw InputError(file + ": its header (COPIES ABOUT): " + e.what());
  }
}

OperationRun run_operation(const VerifyJob& request, const ProgramQuestion& q, const Setup& setup, Machine machine,
                           const NcProgram& program, const std::optional<Path>& planned, Verification& outcome) {
  const std::string& file = *request.nc.file;
  OperationRun run;
  const double tolerance = setup.tolerance_mm;
  const BackplotOptions options = options_of(request, q, tolerance, machine, program, outcome);
  run.plot = backplot(machine, program, file, options);
  if (!q.in_place) turn_back(file, program, setup, run.plot);
  accept_set_up(request.nc, program, machine, q.tool, options, outcome.acceptance);
  accept_rapids(file, setup, q.obstacles, q.tool, run.plot, outcome.acceptance);
  if (planned) {
    const Path path = q.in_place ? turned(*planned, turn_of(file, program)) : *planned;
    run.followed = judge_way(request, q, tolerance, path, {file, program, run.plot}, outcome.acceptance);
  }
  machine.tool_length = options.tool_length;
  judge_machine(machine, setup, q, options, {file, program, run.plot}, outcome.acceptance);
  outcome.notes.push_back(
      fmt::format("{} on {}: {} moves in {}, checked as {} CL points within {:.2g} mm of its motion",
                  std::filesystem::path(file).filename().string(), machine.name, program.moves.size(),
                  minutes_text(run.plot.time_s / 60.0), run.plot.path.pose_count(), run.plot.chord_bound_mm));
  return run;
}

void prepend(Acceptance first, Acceptance& all) {
  first.reasons.insert(first.reasons.end(), all.reasons.begin(), all.reasons.end());
  first.cautions.insert(first.cautions.end(), all.cautions.begin(), all.cautions.end());
  all = std::move(first);
}

void accept_together(const VerifyJob& request, const std::vector<NcProgram>& operations,
                     const std::vector<std::string>& folders, Acceptance& acceptance) {
  const std::string& file = *request.nc.file;
  const auto tool_file = [&](std::size_t k) {
    return read_file((std::filesystem::path(folders[k]) / "tool.json").string());
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

}  // namespace flank::internal
