#include "flank/sheet/setup_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <variant>

#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/machine/backplot.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/read_nc.h"
#include "flank/manifest/result_folder.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/folder/plan_operation.h"
#include "flank/pipeline/folder/wheel_plan.h"
#include "flank/pipeline/program/operation_words.h"
#include "flank/results/acceptance.h"
#include "flank/results/verify_json.h"
#include "flank/setup/read_setup.h"
#include "flank/sheet/part_drawing.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

/// Between the poses that stand for a program's motion, mm: only its time is asked for.
constexpr double kChordMm = 0.01;

/// A folder as it is read.
struct Read {
  SheetOperation told;
  Tool tool;
  std::string tool_text;
  Setup setup;
};

const char* kind_of(const FitJob&) { return "flank milling"; }
const char* kind_of(const CoverJob&) { return "flank milling, passes of a given tool"; }
const char* kind_of(const TrochoidJob&) { return "trochoidal roughing and finishing"; }

/// The verdict on the path of a folder.
Acceptance verdict_of(const std::string& folder) {
  const auto file = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
  Acceptance verdict;
  if (std::filesystem::exists(file("verify.json")))
    verdict = acceptance_from_json(read_file(file("verify.json")), file("verify.json"));
  else
    add_reason(verdict, Figure::kVerdict, "the path was not checked; run `flank verify`");
  return verdict;
}

/// The program's verdict beside it, where it was posted for this machine.
void add_program_verdict(const std::string& folder, const std::string& machine, Acceptance& verdict) {
  const auto file = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
  if (machine.empty()) return;
  const auto motion = std::filesystem::exists(file("motion.json"))
                          ? nlohmann::json::parse(read_file(file("motion.json")), nullptr, false)
                          : nlohmann::json();
  if (!motion.is_object() || motion.value("machine", "") != machine) {
    add_caution(verdict, Figure::kVerdict,
                "no program for this machine was posted from the folder as it is; run `flank verify --nc`");
    return;
  }
  const auto add = [&](const char* list, std::vector<Shortfall>& to) {
    if (!motion.contains(list) || !motion[list].is_array()) return;
    for (const auto& one : motion[list])
      // What the path lacks is there already.
      if (one.is_object() && !one.value("text", "").starts_with("the path: "))
        to.push_back({one.value("figure", ""), "the program: " + one.value("text", "")});
  };
  add("reasons", verdict.reasons);
  add("cautions", verdict.cautions);
}

/// `judged`: of a wheel's folder, whose verdict is that of all its operations.
Read read_operation(const std::string& folder, const std::string& machine, const std::optional<Acceptance>& judged) {
  const auto file = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
  const ResultFolder result(folder, ResultFolder::Use::kRead);
  VerifyJob wanted;
  wanted.folder = folder;
  const FolderJob found = read_folder_job(wanted, result);
  Read read;
  read.tool_text = read_file(file("tool.json"));
  read.told.strips = static_cast<int>(read_path(file("path.json")).strips.size());
  read.told.folder = folder;
  std::vector<std::string> notes;
  std::visit(
      [&](const auto& job) {
        read.tool = read_and_equip(file("tool.json"), {}, job.obstacles);
        read.setup = read_setup(machined(job), job.obstacles, job.tolerance_mm, notes);
        read.told.faces = machined(job).target_text();
        read.told.kind = kind_of(job);
      },
      found.job);
  read.told.tolerance_mm = read.setup.tolerance_mm;
  read.told.name = operation_name(folder, read.setup);
  read.told.verdict = judged ? *judged : verdict_of(folder);
  add_program_verdict(folder, machine, read.told.verdict);
  return read;
}

/// Feeds of what cuts, where the program states them in mm/min.
void add_feeds(const NcProgram& program, SheetOperation& operation) {
  if (program.feed_mode != NcFeedMode::kPerMinute) return;
  for (const NcMove& move : program.moves) {
    const bool cuts = move.kind == NcKind::kFeed && move.strip >= 0 &&
                      program.strips[static_cast<std::size_t>(move.strip)].kind != "link";
    if (!cuts) continue;
    operation.feed_low = operation.feed_high > 0.0 ? std::min(operation.feed_low, move.feed) : move.feed;
    operation.feed_high = std::max(operation.feed_high, move.feed);
  }
}

/// How long the machine takes for one operation, at the program's own feeds, minutes.
double minutes_of(const Machine& machine, const NcProgram& program, const std::string& file, const WorkSetup& place,
                  const Tool& tool) {
  BackplotOptions options;
  options.setup = place;
  options.tool_length = program.header.tool.length > 0.0 ? program.header.tool.length : machine.tool_length;
  options.tip_offset = machine.controlled == ControlledPoint::kLowest ? tool.radial.at(0.0).r : 0.0;
  options.axis_length = tool.radial.axis_length();
  options.chord = kChordMm;
  return backplot(machine, program, file, options).time_s / 60.0;
}

/// From its lowest point to where it is held.
double stick_out(const Tool& tool) {
  const double tip = tool.radial.at(0.0).r;
  if (!tool.holder.empty()) return tip + tool.holder.front().x();
  return tip +
         (tool.shank.empty() ? meridian_point(tool.radial, tool.radial.axis_length()).x() : tool.shank.back().x());
}

void add_tool(const Read& read, std::vector<std::string>& known, SetupSheet& sheet) {
  if (std::find(known.begin(), known.end(), read.tool_text) != known.end()) return;
  known.push_back(read.tool_text);
  sheet.tools.push_back({read.told.tool_number, read.tool, read.told.tool_length_mm, stick_out(read.tool)});
}

/// What the program says of the operations: of each folder all of its copies, as many as they are.
void add_program(const SheetJob& job, const Machine& machine, std::vector<Read>& reads, SetupSheet& sheet) {
  const std::string text = read_file(*job.nc);
  const std::vector<NcProgram> programs = read_nc_operations(text, *job.nc, machine.dialect);
  const std::vector<std::size_t> folders = folders_of(*job.nc, programs, reads.size());
  const NcHeader& first = programs.front().header;
  sheet.program = std::filesystem::path(*job.nc).filename().string();
  sheet.program_sha256 = sha256(text);
  sheet.machine = machine.name;
  sheet.work_offset = first.work_offset;
  sheet.origin = first.origin;
  sheet.dry_run = first.stated.dry_run;
  sheet.placed = job.setup || !first.setup.empty();
  if (job.setup || !first.setup.empty()) sheet.place = parse_setup(job.setup ? *job.setup : first.setup);
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const NcProgram& program = programs[k];
    Read& read = reads[folders[k]];
    SheetOperation& told = read.told;
    if (program.header.operation && !program.header.operation->name.empty()) told.name = program.header.operation->name;
    told.copies = program.header.operation.value_or(NcOperation{}).copies;
    told.tool_number = program.header.tool.number;
    told.tool_length_mm = program.header.tool.length;
    told.spindle_rpm = program.header.spindle_rpm;
    add_feeds(program, told);
    told.minutes += minutes_of(machine, program, *job.nc, sheet.place, read.tool);
  }
}

void add_verdicts(const std::optional<Acceptance>& judged, SetupSheet& sheet) {
  if (judged) sheet.verdict = *judged;
  // What a wheel's operations have in common is told once.
  const std::size_t reasons = judged ? judged->reasons.size() : 0, cautions = judged ? judged->cautions.size() : 0;
  for (const SheetOperation& one : sheet.operations) {
    const std::string before = sheet.operations.size() > 1 ? one.name + ": " : "";
    for (std::size_t k = reasons; k < one.verdict.reasons.size(); ++k)
      sheet.verdict.reasons.push_back({one.verdict.reasons[k].figure, before + one.verdict.reasons[k].text});
    for (std::size_t k = cautions; k < one.verdict.cautions.size(); ++k)
      sheet.verdict.cautions.push_back({one.verdict.cautions[k].figure, before + one.verdict.cautions[k].text});
  }
}

/// One sheet is for one part.
void require_one_part(const std::vector<Read>& reads) {
  for (const Read& read : reads)
    if (read.setup.part.sha256 != reads.front().setup.part.sha256)
      throw InputError(read.told.folder + ": is of another part than " + reads.front().told.folder +
                       "; expected folders of one part");
}

/// The folders that are given, or those of a wheel's operations, with the verdict on all of them.
std::vector<std::string> operations_of(const SheetJob& job, std::optional<Acceptance>& judged) {
  const std::optional<WheelPlan> wheel = job.folders.size() == 1 ? read_wheel_plan(job.folders.front()) : std::nullopt;
  if (!wheel) return job.folders;
  judged = verdict_of(job.folders.front());
  std::vector<std::string> folders;
  for (const WheelStep& step : wheel->steps)
    if (step.done) folders.push_back(step.folder);
  if (folders.empty()) throw InputError(job.folders.front() + ": plan.json: no operation has a result");
  return folders;
}

}  // namespace

SetupSheet make_setup_sheet(const SheetJob& job) {
  if (job.nc && !job.machine) throw UsageError("machine", "must be given with `nc`: a name, or a file NAME.toml");
  std::optional<Machine> machine;
  if (job.machine) machine = read_machine(*job.machine);
  std::vector<Read> reads;
  std::optional<Acceptance> judged;
  for (const std::string& folder : operations_of(job, judged))
    reads.push_back(read_operation(folder, job.nc ? machine->name : std::string(), judged));
  require_one_part(reads);
  SetupSheet sheet;
  if (job.setup) sheet.place = parse_setup(*job.setup), sheet.placed = true;
  if (machine) sheet.machine = machine->name;
  if (job.nc) add_program(job, *machine, reads, sheet);
  const Part& part = reads.front().setup.part;
  sheet.part = std::filesystem::path(part.file).filename().string();
  sheet.part_sha256 = part.sha256;
  std::vector<int> targets;
  std::vector<std::string> known;
  for (const Read& read : reads) {
    targets.insert(targets.end(), read.setup.targets.begin(), read.setup.targets.end());
    add_tool(read, known, sheet);
    sheet.operations.push_back(read.told);
  }
  const PartDrawing drawing(part, targets, sheet.place);
  sheet.box = drawing.box();
  sheet.front = drawing.svg(DrawnFrom::kFront);
  sheet.above = drawing.svg(DrawnFrom::kAbove);
  add_verdicts(judged, sheet);
  return sheet;
}

}  // namespace flank::internal
