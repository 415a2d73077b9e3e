#include "flank/pipeline/folder/post_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>
#include <utility>

#include "flank/error.h"
#include "flank/job/check_fields.h"
#include "flank/machine/links.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "flank/machine/setup_search.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/machine_scene.h"
#include "flank/pipeline/folder/plan_operation.h"
#include "flank/pipeline/folder/post_operation.h"
#include "flank/pipeline/folder/wheel_plan.h"
#include "flank/results/acceptance.h"

namespace flank {
namespace internal {
namespace {

/// The operations of a program, each planned, and where their copies are.
struct ProgramPlan {
  std::vector<PlannedOperation> operations;
  CopyAxis axis;
  std::optional<Vec3> up;  ///< of a wheel, along its axis
  [[nodiscard]] int count() const {
    return std::accumulate(operations.begin(), operations.end(), 0,
                           [](int sum, const PlannedOperation& one) { return sum + one.copies; });
  }
};

/// The same file of a tool is the same tool: one number, unless the request gives another.
void number_tools(const std::vector<OperationWords>& words, std::vector<PlannedOperation>& operations) {
  int last = 0;
  for (const OperationWords& given : words) last = std::max(last, given.tool.value_or(0));
  for (std::size_t k = 0; k < operations.size(); ++k) {
    if (words[k].tool) continue;
    const auto same = std::find_if(operations.begin(), operations.begin() + static_cast<std::ptrdiff_t>(k),
                                   [&](const auto& one) { return one.tool_text == operations[k].tool_text; });
    const bool known = same != operations.begin() + static_cast<std::ptrdiff_t>(k);
    operations[k].tool_number = known ? same->tool_number : ++last;
  }
  for (std::size_t k = 1; k < operations.size(); ++k)
    for (std::size_t i = 0; i < k; ++i)
      if (operations[i].tool_number == operations[k].tool_number && operations[i].tool_text != operations[k].tool_text)
        throw UsageError("operations", fmt::format("operations {} and {} have two different tools and one number, {}; "
                                                   "expected a number for each tool",
                                                   i + 1, k + 1, operations[k].tool_number));
}

/// One program is for one part, as it is clamped once.
void require_one_part(const std::vector<PlannedOperation>& operations) {
  for (const PlannedOperation& one : operations)
    if (one.setup.part.sha256 != operations.front().setup.part.sha256)
      throw InputError(one.request.folder + ": is of " + one.setup.part.file + ", and " +
                       operations.front().request.folder + " of " + operations.front().setup.part.file +
                       "; expected folders of one part");
}

/// The operations of a wheel's folder, in the order of machining. The verdict of that folder is of all copies, on all faces: a copy needs no part
/// that is the same when it is turned.
ProgramPlan plan_wheel(const PostJob& request, const WheelPlan& wheel) {
  if (request.copies != 1 || request.copy_axis)
    throw UsageError("copies", "are in plan.json of a wheel's folder; expected none");
  const std::string file = (std::filesystem::path(request.folder) / "path.json").string();
  require_steps_make(wheel, read_path(file), file);
  std::vector<const WheelStep*> steps;
  for (const WheelStep& step : wheel.steps) {
    if (!step.done) continue;
    if (step.copies > 1 && (!wheel.whole || step.copies != wheel.sectors))
      throw InputError(fmt::format("{}: {} copies of operation {} are not a whole turn of {}; expected a whole wheel",
                                   request.folder, step.copies, step.id, wheel.sectors));
    steps.push_back(&step);
  }
  const std::vector<OperationWords> words = parse_operations(request.operations, steps.size());
  ProgramPlan plan;
  plan.axis = wheel.axis, plan.up = wheel.up;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    plan.operations.push_back(plan_operation(request_of(request, steps[k]->folder, words[k]), words[k]));
    PlannedOperation& one = plan.operations.back();
    one.copies = steps[k]->copies;
    one.judged_in = request.folder, one.tells_verdict = k == 0;
  }
  number_tools(words, plan.operations);
  require_one_part(plan.operations);
  return plan;
}

ProgramPlan plan_program(const PostJob& request) {
  if (request.more_folders.empty())
    if (const std::optional<WheelPlan> wheel = read_wheel_plan(request.folder)) return plan_wheel(request, *wheel);
  ProgramPlan plan;
  if (request.copy_axis) {
    if (request.copies == 1 && request.clamp != "bore")
      throw UsageError("copy_axis", "needs `copies`: how often each operation is run, or `clamp` bore");
    plan.axis = parse_copy_axis(*request.copy_axis);
  }
  const std::vector<OperationWords> words = parse_operations(request.operations, request.more_folders.size() + 1);
  std::vector<PostJob> each{request_of(request, request.folder, words.front())};
  for (std::size_t k = 0; k < request.more_folders.size(); ++k)
    each.push_back(request_of(request, request.more_folders[k], words[k + 1]));
  // Before any of them is planned, which takes a while.
  for (const PostJob& one : each) require_cutting_data(one);
  for (std::size_t k = 0; k < each.size(); ++k) plan.operations.push_back(plan_operation(each[k], words[k]));
  number_tools(words, plan.operations);
  require_one_part(plan.operations);
  for (PlannedOperation& one : plan.operations) one.copies = request.copies;
  if (request.copies > 1)
    for (const PlannedOperation& one : plan.operations) require_same_when_turned(one.setup, plan.axis, request.copies);
  return plan;
}

/// Ways to clamp the part, the one that is tried first in front: which way up, and on what. A wheel that may be clamped anyhow sits on its
/// axis, if the machine can do so.
std::vector<Clamping> clampings_of(const PostJob& request, const ProgramPlan& plan, bool table_turns) {
  if (request.clamp == "bottom") return {{.up = Vec3::UnitZ()}};
  if (request.clamp == "bore") return {{.up = plan.up.value_or(plan.axis.direction), .centred = plan.axis.point}};
  if (plan.up && table_turns) return {{.up = plan.up, .centred = plan.axis.point}, {}};
  return {{}};
}

/// The poses of the controlled point along a path.
void add_poses(const Path& path, double below, SetupSearch& search) {
  for (const Strip& strip : path.strips)
    for (const Pose& p : strip.poses) {
      search.poses.push_back({p.at(-below), p.axis});
      search.cutting.push_back(strip.kind != kLinkKind);
    }
}

/// All poses of all copies that the machine must reach.
SetupSearch all_poses(const Machine& machine, const ProgramPlan& plan) {
  SetupSearch search;
  for (const PlannedOperation& one : plan.operations)
    for (int copy = 1; copy <= one.copies; ++copy)
      add_poses(turned(one.links.linked.path, copy_turn(plan.axis, copy, one.copies)), tip_offset(machine, one.facts),
                search);
  return search;
}

/// The same, each by itself, with the ways from upright and back, which depend on the set-up.
std::vector<std::vector<Pose>> whole_ways(const Machine& machine, const ProgramPlan& plan, const WorkSetup& place) {
  std::vector<std::vector<Pose>> ways;
  for (const PlannedOperation& one : plan.operations)
    for (int copy = 1; copy <= one.copies; ++copy) {
      SetupSearch search;
      add_poses(turned_path(with_length(machine, one), one, place, {plan.axis, copy, one.copies}),
                tip_offset(machine, one.facts), search);
      ways.push_back(std::move(search.poses));
    }
  return ways;
}

WorkSetup find_setup(const PostJob& request, const Machine& machine, const ProgramPlan& plan, PostOutcome& outcome) {
  if (request.setup) return parse_setup(*request.setup);
  // The operation whose tool needs most room, and the longest tool.
  const PlannedOperation* largest = &plan.operations.front();
  Machine longest = with_length(machine, *largest);
  for (const PlannedOperation& one : plan.operations) {
    if (one.way.tool_radius > largest->way.tool_radius) largest = &one;
    if (with_length(machine, one).tool_length > longest.tool_length) longest = with_length(machine, one);
  }
  const double below = tip_offset(machine, largest->facts);
  SetupSearch search = all_poses(machine, plan);
  search.upright = [&](const Vec3& up) {
    const Pose p = above(largest->way, up);
    return Pose{p.at(-below), p.axis};
  };
  search.whole = [&](const WorkSetup& place) { return whole_ways(machine, plan, place); };
  const MachineScene scene = machine_scene(longest, largest->tool, below);
  const Kinematics kinematics(longest, longest.tool_length);
  FoundSetup found;
  for (const Clamping& clamping : clampings_of(request, plan, machine.joints[kinematics.rotary_joints()[0]].table)) {
    search.clamping = clamping;
    found = search_setup(longest, kinematics, search, scene.solids);
    if (found.setup) break;
  }
  if (!found.setup)
    throw InputError("setup", fmt::format("machine {} reaches the part in none of {} set-ups tried: {}", machine.name,
                                          found.tried, found.reason));
  outcome.setup_found = true;
  return *found.setup;
}

void add_joints(const std::vector<JointRange>& more, std::vector<JointRange>& all) {
  if (all.empty()) all = more;
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].low = std::min(all[k].low, more[k].low);
    all[k].high = std::max(all[k].high, more[k].high);
    all[k].speed = std::max(all[k].speed, more[k].speed);
    all[k].acceleration = std::max(all[k].acceleration, more[k].acceleration);
  }
}

/// Figures of one operation into those of all. `before`: what its texts begin with.
void add_operation(const PostOutcome& one, const std::string& before, bool first, PostOutcome& all) {
  all.machine = one.machine;
  all.nesting = one.nesting;
  all.setup = one.setup;
  all.strips += one.strips;
  all.poses += one.poses;
  all.moves += one.moves;
  all.inserted += one.inserted;
  all.left_out += one.left_out;
  all.deviation_mm = std::max(all.deviation_mm, one.deviation_mm);
  all.rounding_mm = std::max(all.rounding_mm, one.rounding_mm);
  all.least_tilt_deg = first ? one.least_tilt_deg : std::min(all.least_tilt_deg, one.least_tilt_deg);
  all.minutes += one.minutes;
  all.cutting_minutes += one.cutting_minutes;
  add_joints(one.joints, all.joints);
  add_under(before, one.acceptance, all.acceptance);
  all.operations.insert(all.operations.end(), one.operations.begin(), one.operations.end());
}

/// What is told of an operation: the words before it, and the text.
using Told = std::vector<std::pair<std::string, std::string>>;

/// What is told of every operation alike is said once, of all.
void add_notes(const Told& told, std::size_t operations, std::vector<std::string>& notes) {
  std::set<std::string> known;
  for (const auto& [before, text] : told) {
    const auto alike =
        std::count_if(told.begin(), told.end(), [&, &own = text](const auto& x) { return x.second == own; });
    if (static_cast<std::size_t>(alike) < operations)
      notes.push_back(before + text);
    else if (known.insert(text).second)
      notes.push_back(text);
  }
}

/// Every operation with all of its copies before the next: tools are changed as rarely as can be.
std::vector<NcProgram> post_all(const Machine& machine, const ProgramPlan& plan, const WorkSetup& place,
                                PostOutcome& outcome) {
  std::vector<NcProgram> programs;
  Told told;
  const int count = plan.count();
  for (const PlannedOperation& one : plan.operations)
    for (int copy = 1; copy <= one.copies; ++copy) {
      NcProgram program;
      const PostOutcome posted =
          post_operation(with_length(machine, one), one, place, {plan.axis, copy, one.copies}, program);
      const int number = static_cast<int>(programs.size()) + 1;
      std::string before;
      if (count > 1) {
        program.header.operation = NcOperation{number, count, copy, one.copies, one.name};
        if (one.copies > 1) program.header.copy_axis = copy_axis_text(plan.axis);
        before = heading(*program.header.operation);
      }
      add_operation(posted, before, programs.empty(), outcome);
      for (const std::string& note : posted.notes) told.emplace_back(before, note);
      programs.push_back(std::move(program));
    }
  add_notes(told, plan.operations.size(), outcome.notes);
  outcome.motion = outcome.operations.front().motion;
  return programs;
}

/// A rotary axis that ends turns away from where it began would be taken for a fault by who reads its display.
void note_turns(const Machine& machine, const NcProgram& last, PostOutcome& outcome) {
  if (!last.end_rotary) return;
  for (std::size_t k = 0; k < 2; ++k)
    if (const double turns = std::round((*last.end_rotary)(static_cast<int>(k)) / 360.0); turns != 0.0)
      outcome.notes.push_back(
          fmt::format("axis {} ends at {:g} degrees, {:g} turn{} from zero: the next program must unwind it",
                      machine.rotary_joint(k).name, 360.0 * turns, std::abs(turns), std::abs(turns) == 1.0 ? "" : "s"));
}

}  // namespace

PostOutcome post_folder(const PostJob& request) {
  check_fields(request);
  const Machine machine = read_machine(request.machine);
  if (request.setup) (void)parse_setup(*request.setup);
  const ProgramPlan plan = plan_program(request);
  PostOutcome outcome;
  const WorkSetup place = find_setup(request, machine, plan, outcome);
  const std::vector<NcProgram> programs = post_all(machine, plan, place, outcome);
  note_turns(machine, programs.back(), outcome);
  if (outcome.acceptance.pass() || request.force) outcome.program = write_nc(std::span(programs), machine.dialect);
  return outcome;
}

}  // namespace internal

PostOutcome run_post(const PostJob& job) { return internal::post_folder(job); }

}  // namespace flank
