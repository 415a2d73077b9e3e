#include "flank/pipeline/folder/post_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <type_traits>

#include "flank/artefact/acceptance.h"
#include "flank/artefact/verify_json.h"
#include "flank/error.h"
#include "flank/io/path/engagement_json.h"
#include "flank/io/text/json_input.h"
#include "flank/job/check_fields.h"
#include "flank/machine/cutting/materials.h"
#include "flank/machine/links.h"
#include "flank/machine/model/machine_file.h"
#include "flank/machine/nc/dialects/write_nc.h"
#include "flank/machine/post.h"
#include "flank/machine/setup_search.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/folder/judged_links.h"
#include "flank/pipeline/folder/machine_scene.h"
#include "flank/pipeline/folder/motion_json.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"

namespace flank {
namespace internal {
namespace {

/// Of the tolerance, for what the control's motion adds to the path: small beside all that the planner spends.
constexpr double kDeviationShare = 0.005;
/// Steps of a program are not worth less than this, mm.
constexpr double kLeastDeviation = 1e-6;
/// Where little is engaged the feed is so much faster at most: beyond, runout and the stock's own resolution of a few
/// degrees count for more than the chip. At a limit of 60 degrees it is reached at 17.
constexpr double kMostFeedFactor = 3.0;
/// Of a dry run, mm/min, unless another one is given.
constexpr double kDryFeed = 1000.0;
/// Of the tolerance: what chords and digits of a program may add to a path that uses up all of it. As much lies outside of the
/// budget that planner and judge share; beyond it there must be room below the tolerance.
constexpr double kOutsideShare = 0.02;

struct Input {
  Setup setup;
  Tool tool;
  Path path;
  PathEngagement engagement;  ///< of each pose; empty lists where it is not known
  ObstacleRequest obstacles;
  JudgeRequest judge;
  bool fixed_order = false;     ///< of the path's strips
  double engagement_rad = 0.0;  ///< the limit of a cavity's cycles; 0: no cavity
};

template <class Job>
Input read_input(const PostJob& request, const Job& job, const ResultFolder& folder, std::vector<std::string>& notes) {
  const auto file = [&](const char* name) { return (std::filesystem::path(request.folder) / name).string(); };
  Input input;
  input.tool = read_and_equip(file("tool.json"), {}, job.obstacles);
  input.path = read_path(file("path.json"));
  input.engagement.resize(input.path.strips.size());
  if (std::filesystem::exists(file("engagement.json")))
    input.engagement = engagement_from_json(read_file(file("engagement.json")), file("engagement.json"), input.path);
  input.setup = read_setup(machined(job), job.obstacles, job.tolerance_mm, notes);
  input.obstacles = job.obstacles;
  input.judge = job.judge;
  input.fixed_order = std::is_same_v<Job, TrochoidJob>;
  if constexpr (std::is_same_v<Job, TrochoidJob>)
    input.engagement_rad = job.cycles.most_engagement_deg * std::numbers::pi / 180.0;
  notes.clear();  // told when the folder was made
  if (folder.manifest() && !request.part && input.setup.part.sha256 != folder.manifest()->part.sha256)
    throw InputError(input.setup.part.file + ": has changed since the result in " + folder.path() +
                     " was made for it; make the result again, or name a part by `part`");
  return input;
}

PostTool post_tool(const Tool& tool) {
  PostTool facts{.name = tool.name, .axis_length = tool.radial.axis_length(), .tip_radius = tool.radial.at(0.0).r};
  constexpr int kLooks = 200;
  for (int k = 0; k <= kLooks; ++k)
    facts.largest_radius = std::max(facts.largest_radius, tool.radial.at(facts.axis_length * k / kLooks).r);
  return facts;
}

/// Of all that could touch: flank, shank and holder.
double body_radius(const Tool& tool, const PostTool& facts) {
  double radius = facts.largest_radius;
  for (const auto* profile : {&tool.shank, &tool.holder})
    for (const Vec2& p : *profile) radius = std::max(radius, p.y());
  return radius;
}

/// The strips in the order in which they are run. Cycles of a cavity need what the ones before them have cut.
KnownPath in_order(const Input& input, const Box3& around, const PostJob& request) {
  KnownPath path = joined({input.path, input.engagement});
  if (input.fixed_order || request.order == "given") return path;
  KnownPath ordered;
  for (const std::size_t k : short_order(path.path, around)) {
    ordered.path.strips.push_back(std::move(path.path.strips[k]));
    ordered.known.push_back(std::move(path.known[k]));
  }
  return ordered;
}

/// What links keep out of, and of what size.
LinkOptions link_options(const Input& input, const PostTool& facts, const PostJob& request) {
  LinkOptions options;
  options.keep_out = input.setup.part.box;
  for (const Part& fixture : input.setup.fixtures) options.keep_out.add(fixture.box);
  options.tool_radius = body_radius(input.tool, facts);
  options.clearance = request.link_clearance_mm;
  return options;
}

WorkSetup find_setup(const PostJob& request, const Machine& machine, const Path& path, const LinkOptions& links,
                     const PostTool& facts, const MachineScene& scene, PostOutcome& outcome) {
  if (request.setup) return parse_setup(*request.setup);
  std::vector<Pose> poses;
  const double below = tip_offset(machine, facts);
  for (const Strip& strip : path.strips)
    for (const Pose& p : strip.poses) poses.push_back({p.at(-below), p.axis});
  const auto upright = [&](const Vec3& up) {
    const Pose p = above(links, up);
    return Pose{p.at(-below), p.axis};
  };
  const FoundSetup found =
      search_setup(machine, Kinematics(machine, machine.tool_length), poses, scene.solids, upright);
  if (!found.setup)
    throw InputError("setup", fmt::format("machine {} reaches the part in none of {} set-ups tried: {}", machine.name,
                                          found.tried, found.reason));
  outcome.setup_found = true;
  return *found.setup;
}

/// How deep the links cut, and how near shank and holder come on them.
void accept_links(const Input& input, const JudgedLinks& links, PostOutcome& outcome) {
  const double depth = links.depth_mm(), tolerance = input.setup.tolerance_mm;
  if (depth > tolerance) {
    const WorstPlace* worst = links.report.worst.empty() ? nullptr : &links.report.worst.front();
    add_reason(outcome.acceptance, Figure::kGouge,
               fmt::format("no link between passes was found that cuts nothing: link {} cuts {} by {:.4f} mm, more "
                           "than the tolerance of {} mm",
                           worst != nullptr ? worst->strip + 1 : 0, worst != nullptr ? worst->face : "the part", depth,
                           tolerance));
  }
  const ClearanceScene scene = make_clearance_scene(input.setup, input.obstacles, has_body(input.tool), outcome.notes);
  if (!measure_clearance(scene, input.tool, links.links()).kept())
    add_reason(outcome.acceptance, Figure::kClearance, "shank, holder or a fixture comes too close on a link");
}

/// A cavity's cycles are planned for a limit of the engagement: there the feed is what was asked for.
EngagementFeed feed_rule(const PostJob& request, const Input& input, PostOutcome& outcome) {
  const double feed = request.feed_mm_min.value_or(kDryFeed);
  EngagementFeed rule{.feed = feed / 60.0};
  rule.most_feed = request.most_feed_mm_min.value_or(kMostFeedFactor * feed) / 60.0;
  if (request.speed != "feed" || !(input.engagement_rad > 0.0)) return rule;
  if (input.engagement.empty() || input.engagement.front().empty()) {
    outcome.notes.push_back("no engagement.json: the feed is the same everywhere; flank verify writes it");
    return rule;
  }
  rule.reference = input.engagement_rad;
  outcome.notes.push_back(
      fmt::format("the feed follows the engagement: its thickest chip is that of {:g} mm/min at {:g} degrees, the feed "
                  "at most {:g} "
                  "mm/min",
                  feed, input.engagement_rad * 180.0 / std::numbers::pi, 60.0 * rule.most_feed));
  return rule;
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
double take_verdict(const PostJob& request, PostOutcome& outcome) {
  const std::string file = (std::filesystem::path(request.folder) / "verify.json").string();
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
void accept_rounding(double depth, const Input& input, const Post& result, PostOutcome& outcome) {
  const double tolerance = input.setup.tolerance_mm, room = std::max(tolerance - depth, kOutsideShare * tolerance);
  if (result.deviation_mm + result.rounding_mm <= room) return;
  add_reason(outcome.acceptance, Figure::kRounding,
             fmt::format("rounding moves the tool by up to {:.6f} mm and its chords by {:.6f} mm, the path gouges by "
                         "up to {:.6f} mm: together possibly more than the tolerance of {} mm; give more digits "
                         "(length_decimals, angle_decimals of the machine's file) or a smaller --deviation",
                         result.rounding_mm, result.deviation_mm, depth, tolerance));
}

/// A rotary axis that ends turns away from where it began would be taken for a fault by who reads its display.
void note_turns(const Machine& machine, const Post& result, PostOutcome& outcome) {
  if (!result.program.end_rotary) return;
  for (std::size_t k = 0; k < 2; ++k)
    if (const double turns = std::round((*result.program.end_rotary)(static_cast<int>(k)) / 360.0); turns != 0.0)
      outcome.notes.push_back(
          fmt::format("axis {} ends at {:g} degrees, {:g} turn{} from zero: the next program must unwind it",
                      machine.rotary_joint(k).name, 360.0 * turns, std::abs(turns), std::abs(turns) == 1.0 ? "" : "s"));
}

/// Of the spindle and of what falls short, for people at the machine.
void fill_header(const PostJob& request, const Input& input, NcHeader& header, const PostOutcome& outcome) {
  header.part = std::filesystem::path(input.setup.part.file).filename().string();
  header.setup = outcome.setup;
  header.spindle_rpm = request.spindle_rpm.value_or(0.0);
  header.dry_run = request.dry;
  for (const Shortfall& reason : outcome.acceptance.reasons) header.shortfalls.push_back(reason.text);
  for (const Shortfall& caution : outcome.acceptance.cautions) header.cautions.push_back(caution.text);
}

/// The speed of the spindle and the feed that a material gives, where they are not given themselves.
PostJob with_material(PostJob request, const PostTool& facts, PostOutcome& outcome) {
  if (!request.material || request.dry) return request;
  const Material material = find_material(*request.material);
  const double diameter = 2.0 * facts.largest_radius;
  const CuttingData data = cutting_data(material, diameter, *request.flutes, 0.0);
  if (!request.spindle_rpm) request.spindle_rpm = std::floor(data.spindle_rpm);
  // The chip stays what it is at any speed of the spindle. "optimal" has no feed of its own.
  if (!request.feed_mm_min && request.speed != "optimal")
    request.feed_mm_min = data.chip_mm * *request.flutes * *request.spindle_rpm;
  outcome.notes.push_back(
      fmt::format("{}: {:.0f} to {:.0f} m/min and a chip of {:.4f} mm at a diameter of {:.4g} mm with {} flutes: "
                  "spindle {:g}, feed {:.4g} "
                  "mm/min ({})",
                  material.name, material.speed_low, material.speed_high, data.chip_mm, diameter, *request.flutes,
                  *request.spindle_rpm, request.feed_mm_min.value_or(0.0), material.source));
  return request;
}

/// A program that cuts with a spindle that stands still, or at a feed that nobody has chosen, is none.
void require_cutting_data(const PostJob& request) {
  if (request.dry) {
    if (request.spindle_rpm)
      throw UsageError("dry", "give `spindle` and `feed_mm_min`, or `dry`; a dry run has no spindle");
    return;
  }
  if (request.material) {
    (void)find_material(*request.material);
    if (!request.flutes) throw UsageError("flutes", "must be given: the feed of a `material` needs it");
    return;
  }
  if (request.flutes) throw UsageError("flutes", "needs a `material`");
  if (!request.spindle_rpm || (!request.feed_mm_min && request.speed != "optimal"))
    throw UsageError(
        fmt::format("a program needs spindle speed and feed; give {}{}{}, or `dry` for a dry run",
                    request.spindle_rpm ? "" : "`spindle`, 1/min,",
                    request.spindle_rpm || request.feed_mm_min || request.speed == "optimal" ? "" : " and ",
                    request.feed_mm_min || request.speed == "optimal" ? "" : "`feed_mm_min`"));
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
  outcome.minutes = result.time_s / 60.0;
  outcome.cutting_minutes = result.cutting_s / 60.0;
  for (std::size_t k = 0; k < result.use.size(); ++k) {
    const JointUse& use = result.use[k];
    outcome.joints.push_back({use.name, machine.joints[k].kind == JointKind::kRotary ? "deg" : "mm", use.low, use.high,
                              use.speed, use.acceleration});
  }
}

PostOutcome post_input(const PostJob& asked, Machine machine, const Input& input, PostOutcome outcome) {
  const PostTool facts = post_tool(input.tool);
  const PostJob request = with_material(asked, facts, outcome);
  if (request.tool_length_mm) machine.tool_length = *request.tool_length_mm;
  const LinkOptions way = link_options(input, facts, request);
  JudgedLinks links =
      judged_links(input.setup, input.judge, input.tool, in_order(input, way.keep_out, request), way, request.lift_mm);
  Path& linked = links.linked.path;
  PostOptions options;
  MachineScene scene = machine_scene(machine, input.tool, tip_offset(machine, facts));
  options.setup = find_setup(request, machine, linked, way, facts, scene, outcome);
  linked =
      upright(std::move(linked), way,
              options.setup.rotation().transpose() * Kinematics(machine, machine.tool_length).direction({0.0, 0.0}));
  options.deviation =
      std::max(kLeastDeviation, request.deviation_mm.value_or(kDeviationShare * input.setup.tolerance_mm));
  options.feed = feed_rule(request, input, outcome);
  options.engagement = std::move(links.linked.known);
  options.time_optimal = request.speed == "optimal";
  outcome.machine = machine.name;
  outcome.nesting = machine.nesting();
  outcome.setup = setup_text(options.setup);
  outcome.strips = static_cast<int>(input.path.strips.size());
  Post result = post(machine, linked, facts, options);
  if (result.unreachable) refuse(result, outcome);
  fill(machine, result, outcome);
  accept_links(input, links, outcome);
  add_work(input.setup, input.obstacles, options.setup, scene);
  judge_machine(machine, result, scene, outcome);
  accept_rounding(take_verdict(request, outcome), input, result, outcome);
  note_turns(machine, result, outcome);
  fill_header(request, input, result.program.header, outcome);
  if (outcome.acceptance.pass() || request.force) outcome.program = write_nc(result.program, machine.dialect);
  outcome.motion = motion_json(machine, result, input.setup.part.box, options.setup, outcome.acceptance);
  return outcome;
}

}  // namespace

PostOutcome post_folder(const PostJob& request) {
  check_fields(request);
  require_cutting_data(request);
  const Machine machine = read_machine(request.machine);
  if (request.setup) (void)parse_setup(*request.setup);
  const ResultFolder folder(request.folder, ResultFolder::Use::kRead);
  VerifyJob wanted;
  wanted.folder = request.folder;
  wanted.part = request.part;
  const FolderJob found = read_folder_job(wanted, folder);
  PostOutcome outcome;
  const Input input =
      std::visit([&](const auto& job) { return read_input(request, job, folder, outcome.notes); }, found.job);
  return post_input(request, machine, input, std::move(outcome));
}

}  // namespace internal

PostOutcome run_post(const PostJob& job) { return internal::post_folder(job); }

}  // namespace flank
