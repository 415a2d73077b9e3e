#include "flank/pipeline/folder/post_operation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/machine/links.h"
#include "flank/pipeline/folder/machine_scene.h"
#include "flank/pipeline/folder/motion_json.h"
#include "flank/results/acceptance.h"
#include "flank/results/verify_json.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

/// Of the tolerance, for what the control's motion adds to the path: small beside all that the planner spends.
constexpr double kDeviationShare = 0.005;
/// Steps of a program are not worth less than this, mm.
constexpr double kLeastDeviation = 1e-6;
/// Of the tolerance: what chords and digits of a program may add to a path that uses up all of it. As much lies outside of the
/// budget that planner and judge share; beyond it there must be room below the tolerance.
constexpr double kOutsideShare = 0.02;

/// How deep the links cut, and how near shank and holder come on them.
void accept_links(const PlannedOperation& plan, PostOutcome& outcome) {
  const double depth = plan.links.depth_mm(), tolerance = plan.setup.tolerance_mm;
  if (depth > tolerance) {
    const WorstPlace* worst = plan.links.report.worst.empty() ? nullptr : &plan.links.report.worst.front();
    add_reason(outcome.acceptance, Figure::kGouge,
               fmt::format("every link tried between two passes cuts something: link {} cuts {} by {:.4f} mm, more "
                           "than the tolerance of {} mm",
                           worst != nullptr ? worst->strip + 1 : 0, worst != nullptr ? worst->face : "the part", depth,
                           tolerance));
  }
  const ClearanceScene scene = make_clearance_scene(plan.setup, plan.obstacles, has_body(plan.tool), outcome.notes);
  if (!keeps_clear(scene, plan.tool, plan.links.links()))
    add_reason(outcome.acceptance, Figure::kClearance, "shank, holder or a fixture comes too close on a link");
}

/// The whole motion, links included, with table and head, where the machine's file says what they look like.
void judge_machine(const Machine& machine, const Post& result, const MachineScene& scene, PostOutcome& outcome) {
  std::vector<JointValues> track;
  for (const TracePoint& at : result.trace) track.push_back(at.joints);
  const auto where = [&](std::size_t place) {
    const TracePoint& at = result.trace[place];
    return fmt::format("after {:.1f} s, {}", at.time_s, at.cutting ? "while cutting" : "on a link");
  };
  judge_scene(machine, machine.tool_length, scene, track, where, outcome.acceptance);
}

/// A program is no better than its path: takes the verdict of the folder. Returns how deep the judge has proved the path to cut at
/// most, mm; 0 where nobody has judged it.
double take_verdict(const std::string& folder, PostOutcome& outcome) {
  const std::string file = (std::filesystem::path(folder) / "verify.json").string();
  if (!std::filesystem::exists(file)) {
    add_caution(outcome.acceptance, Figure::kVerdict, "the path was not checked; run `flank verify`");
    return 0.0;
  }
  const std::string text = read_file(file);
  const Acceptance path = acceptance_from_json(text, file);
  for (const Shortfall& reason : path.reasons)
    outcome.acceptance.reasons.push_back({reason.figure, "the path: " + reason.text});
  for (const Shortfall& caution : path.cautions)
    outcome.acceptance.cautions.push_back({caution.figure, "the path: " + caution.text});
  const VerifyReport report = verify_from_json(text, file);
  return std::max(report.overcut_bound_mm, report.gouge_bound_mm);
}

/// The program's chords and digits move the tool off the path that was judged: what they add must leave it in the tolerance.
void accept_rounding(double depth, const PlannedOperation& plan, const Post& result, PostOutcome& outcome) {
  const double tolerance = plan.setup.tolerance_mm, room = std::max(tolerance - depth, kOutsideShare * tolerance);
  if (result.deviation_mm + result.rounding_mm <= room) return;
  add_reason(outcome.acceptance, Figure::kRounding,
             fmt::format("rounding moves the tool by up to {:.6f} mm, straight blocks by {:.6f} mm, the path gouges by "
                         "up to {:.6f} mm: together possibly more than the tolerance of {} mm; give more digits "
                         "(length_decimals, angle_decimals of the machine's file) or a smaller --deviation",
                         result.rounding_mm, result.deviation_mm, depth, tolerance));
}

/// Of the spindle and of what falls short, for people at the machine.
void fill_header(const PlannedOperation& plan, NcHeader& header, const PostOutcome& outcome) {
  const PostJob& request = plan.request;
  header.part = std::filesystem::path(plan.setup.part.file).filename().string();
  header.setup = outcome.setup;
  header.spindle_rpm = request.spindle_rpm.value_or(0.0);
  header.dry_run = request.dry;
  header.tool.number = plan.tool_number;
  if (request.coolant != "off" && !request.dry) header.coolant = request.coolant;
  for (const Shortfall& reason : outcome.acceptance.reasons) header.shortfalls.push_back(reason.text);
  for (const Shortfall& caution : outcome.acceptance.cautions) header.cautions.push_back(caution.text);
}

[[noreturn]] void refuse(const Post& result, const PostOutcome& outcome) {
  const Unreachable& why = *result.unreachable;
  throw InputError("machine", outcome.machine,
                   fmt::format("pass {}, CL point {}: {}; set-up {}; give another one by `setup`",
                               result.unreachable_strip, why.pose + 1, why.reason, outcome.setup));
}

void fill(const Machine& machine, const Post& result, PostOutcome& outcome) {
  outcome.poses = result.planned;
  outcome.inserted = result.inserted;
  outcome.left_out = result.left_out;
  outcome.moves = result.program.moves.size();
  outcome.deviation_mm = result.deviation_mm;
  outcome.rounding_mm = result.rounding_mm;
  outcome.least_tilt_deg = std::asin(std::min(1.0, result.least_sine)) * 180.0 / std::numbers::pi;
  outcome.minutes = result.resting_s.value_or(result.time_s) / 60.0;
  outcome.cutting_minutes = (result.resting_s ? result.resting_cutting_s : result.cutting_s) / 60.0;
  for (std::size_t k = 0; k < result.use.size(); ++k) {
    const JointUse& use = result.use[k];
    outcome.joints.push_back({use.name, machine.joints[k].kind == JointKind::kRotary ? "deg" : "mm", use.low, use.high,
                              use.speed, use.acceleration});
  }
}

PostOptions options_of(const PlannedOperation& plan, const WorkSetup& place) {
  PostOptions options;
  options.setup = place;
  options.deviation =
      std::max(kLeastDeviation, plan.request.deviation_mm.value_or(kDeviationShare * plan.setup.tolerance_mm));
  options.feed = plan.feed;
  options.slowness = plan.links.linked.known;
  options.time_optimal = plan.request.speed == "optimal";
  return options;
}

PostOperation told_of(const PlannedOperation& plan, const CopyOf& copy, const PostOutcome& outcome) {
  PostOperation told{.folder = plan.request.folder,
                     .name = plan.name,
                     .tool_number = plan.tool_number,
                     .tool = plan.tool.name,
                     .copy = copy.copy,
                     .copies = copy.copies};
  told.spindle_rpm = plan.request.dry ? 0.0 : plan.request.spindle_rpm.value_or(0.0);
  told.minutes = outcome.minutes;
  told.cutting_minutes = outcome.cutting_minutes;
  return told;
}

}  // namespace

Path turned_path(const Machine& machine, const PlannedOperation& plan, const WorkSetup& place, const CopyOf& copy) {
  const Eigen::Isometry3d turn = copy_turn(copy.axis, copy.copy, copy.copies);
  LinkOptions way = plan.way;
  if (copy.copy > 1) {
    // The sphere on which links go round the part turns with them.
    const Vec3 by = turn * way.keep_out.center() - way.keep_out.center();
    way.keep_out.low += by;
    way.keep_out.high += by;
  }
  const Vec3 up = place.rotation().transpose() * Kinematics(machine, machine.tool_length).direction({0.0, 0.0});
  const Path& linked = plan.links.linked.path;
  return upright(copy.copy > 1 ? turned(linked, turn) : linked, way, up);
}

Machine with_length(Machine machine, const PlannedOperation& plan) {
  if (plan.request.tool_length_mm) machine.tool_length = *plan.request.tool_length_mm;
  return machine;
}

PostOutcome post_operation(const Machine& machine, const PlannedOperation& plan, const WorkSetup& place,
                           const CopyOf& copy, NcProgram& program) {
  PostOutcome outcome;
  if (copy.copy == 1) outcome.notes = plan.notes;
  const PostOptions options = options_of(plan, place);
  outcome.machine = machine.name;
  outcome.nesting = machine.nesting();
  outcome.setup = setup_text(place);
  outcome.strips = static_cast<int>(plan.strips);
  Post result = post(machine, turned_path(machine, plan, place, copy), plan.facts, options);
  if (result.unreachable) refuse(result, outcome);
  fill(machine, result, outcome);
  if (copy.copy == 1 && result.resting_s)
    outcome.notes.emplace_back(
        "LinuxCNC stops at the end of every block in which rotary axes may turn, and the times include these stops; "
        "a larger --deviation makes longer blocks");
  if (copy.copy == 1) accept_links(plan, outcome);
  MachineScene scene = machine_scene(machine, plan.tool, tip_offset(machine, plan.facts));
  add_work(plan.setup, plan.obstacles, place, scene);
  judge_machine(machine, result, scene, outcome);
  PostOutcome known;
  const double depth = take_verdict(plan.judged_in, copy.copy == 1 && plan.tells_verdict ? outcome : known);
  accept_rounding(depth, plan, result, outcome);
  fill_header(plan, result.program.header, outcome);
  outcome.motion = motion_json(machine, result, plan.setup.part.box, place, outcome.acceptance);
  outcome.operations.push_back(told_of(plan, copy, outcome));
  outcome.operations.back().motion = outcome.motion;
  program = std::move(result.program);
  return outcome;
}

}  // namespace flank::internal
