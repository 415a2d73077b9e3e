#include "flank/pipeline/folder/post_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "flank/error.h"
#include "flank/job/check_fields.h"
#include "flank/machine/links.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "flank/machine/setup_search.h"
#include "flank/pipeline/folder/machine_scene.h"
#include "flank/pipeline/folder/plan_operation.h"
#include "flank/pipeline/folder/post_operation.h"
#include "flank/results/acceptance.h"

namespace flank {
namespace internal {
namespace {

/// The operations of a program, each planned, and where their copies are.
struct ProgramPlan {
  std::vector<PlannedOperation> operations;
  CopyAxis axis;
  int copies = 1;
  [[nodiscard]] bool several() const { return operations.size() > 1 || copies > 1; }
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

ProgramPlan plan_program(const PostJob& request) {
  ProgramPlan plan;
  plan.copies = request.copies;
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
  if (plan.copies > 1)
    for (const PlannedOperation& one : plan.operations) require_same_when_turned(one.setup, plan.axis, plan.copies);
  return plan;
}

/// Which way up the part is clamped, and on what.
Clamping clamping_of(const PostJob& request, const ProgramPlan& plan) {
  if (request.clamp == "bottom") return {.up = Vec3::UnitZ()};
  if (request.clamp == "bore") return {.up = plan.axis.direction, .centred = plan.axis.point};
  return {};
}

/// All that the machine must reach, and the operation whose tool needs most room.
WorkSetup find_setup(const PostJob& request, const Machine& machine, const ProgramPlan& plan, PostOutcome& outcome) {
  if (request.setup) return parse_setup(*request.setup);
  SetupSearch search;
  const PlannedOperation* largest = &plan.operations.front();
  Machine longest = machine;
  for (const PlannedOperation& one : plan.operations) {
    const double below = tip_offset(machine, one.facts);
    if (one.way.tool_radius > largest->way.tool_radius) largest = &one;
    if (&one == &plan.operations.front() || with_length(machine, one).tool_length > longest.tool_length)
      longest = with_length(machine, one);
    for (int copy = 1; copy <= plan.copies; ++copy) {
      const Path path = turned(one.links.linked.path, copy_turn(plan.axis, copy, plan.copies));
      for (const Strip& strip : path.strips)
        for (const Pose& p : strip.poses) {
          search.poses.push_back({p.at(-below), p.axis});
          search.cutting.push_back(strip.kind != kLinkKind);
        }
    }
  }
  const double below = tip_offset(machine, largest->facts);
  search.clamping = clamping_of(request, plan);
  search.upright = [&](const Vec3& up) {
    const Pose p = above(largest->way, up);
    return Pose{p.at(-below), p.axis};
  };
  const MachineScene scene = machine_scene(longest, largest->tool, below);
  const FoundSetup found = search_setup(longest, Kinematics(longest, longest.tool_length), search, scene.solids);
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
  for (const Shortfall& reason : one.acceptance.reasons)
    all.acceptance.reasons.push_back({reason.figure, before + reason.text});
  for (const Shortfall& caution : one.acceptance.cautions)
    all.acceptance.cautions.push_back({caution.figure, before + caution.text});
  for (const std::string& note : one.notes) all.notes.push_back(before + note);
  all.operations.insert(all.operations.end(), one.operations.begin(), one.operations.end());
}

/// Every operation with all of its copies before the next: tools are changed as rarely as can be.
std::vector<NcProgram> post_all(const Machine& machine, const ProgramPlan& plan, const WorkSetup& place,
                                PostOutcome& outcome) {
  std::vector<NcProgram> programs;
  const int count = static_cast<int>(plan.operations.size()) * plan.copies;
  for (const PlannedOperation& one : plan.operations)
    for (int copy = 1; copy <= plan.copies; ++copy) {
      NcProgram program;
      const PostOutcome posted =
          post_operation(with_length(machine, one), one, place, {plan.axis, copy, plan.copies}, program);
      const int number = static_cast<int>(programs.size()) + 1;
      std::string before;
      if (plan.several()) {
        program.header.operation = NcOperation{number, count, copy, plan.copies, one.name};
        if (plan.copies > 1) program.header.copy_axis = copy_axis_text(plan.axis);
        before = heading(*program.header.operation);
      }
      add_operation(posted, before, programs.empty(), outcome);
      programs.push_back(std::move(program));
    }
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
