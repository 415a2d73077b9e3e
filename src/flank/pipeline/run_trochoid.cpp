#include "flank/pipeline/run_trochoid.h"
#include "flank/pipeline/auto_shank.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/base/work_count.h"
#include "flank/error.h"
#include "flank/job/check_fields.h"
#include "flank/pipeline/cavity/cavity_faces.h"
#include "flank/pipeline/cavity/cavity_search.h"
#include "flank/pipeline/cavity_judge.h"
#include "flank/pipeline/cavity_notes.h"
#include "flank/pipeline/finish.h"
#include "flank/pipeline/run_fit.h"
#include "flank/pipeline/run_journal.h"
#include "flank/pipeline/search/reach_ball.h"
#include "flank/pipeline/search/search_setup.h"
#include "flank/run.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"
#include "flank/tool_request/tool_model.h"
#include "flank/trochoid/program.h"
#include "flank/trochoid/sides/side_fit.h"
#include "flank/trochoid/sides/side_room.h"

namespace flank::internal {
namespace {

constexpr double kRadian = 180.0 / std::numbers::pi;

std::string status_word(CycleStatus status) {
  switch (status) {
    case CycleStatus::kDone:
      return "done";
    case CycleStatus::kStuck:
      return "stuck";
    case CycleStatus::kShort:
      return "short";
    default:
      return "cancelled";
  }
}

}  // namespace

namespace {

void add_entry(const Entry& entry, LayerSummary& out) {
  out.entry = entry.method == EntryMethod::kPlunge ? "plunge" : "ramp";
  out.entry_deg = entry.largest_rad * kRadian;
  out.entry_mm = entry.way_mm;
  out.entry_mm3 = entry.volume_mm3;
  out.entry_depth_mm = entry.depth_mm;
  out.entry_slope_deg = entry.slope_rad * kRadian;
  out.entry_width_mm = entry.width_mm;
}

}  // namespace

LayerSummary summary_of(const PlannedLayer& planned) {
  LayerSummary out;
  out.cycles = static_cast<int>(planned.cycles.cycles.size());
  out.status = status_word(planned.cycles.status);
  out.sides_mm = planned.sides_mm;
  out.links_mm = planned.links_mm;
  out.side_volume_mm3 = planned.side_volume_mm3;
  out.side_deg = std::max(planned.first_side_rad, planned.second_side_rad) * kRadian;
  out.entered_mm = planned.entered_mm();
  if (planned.entry) add_entry(*planned.entry, out);
  for (const Cycle& cycle : planned.cycles.cycles) {
    const Half& front = cycle.front;
    double angle = front.peak.angle_rad, volume = front.engagement.volume_mm3, way = front.way_mm;
    out.front_deg = std::max(out.front_deg, angle * kRadian);
    out.fronts_mm += front.way_mm;
    if (cycle.back) {
      angle = std::max(angle, cycle.back->peak.angle_rad);
      volume += cycle.back->engagement.volume_mm3;
      way += cycle.back->way_mm;
      out.back_deg = std::max(out.back_deg, cycle.back->peak.angle_rad * kRadian);
      out.backs_mm += cycle.back->way_mm;
    }
    out.cycle_deg.push_back(angle * kRadian);
    out.cycle_mm3.push_back(volume);
    out.cycle_mm.push_back(way);
    out.volume_mm3 += volume;
  }
  return out;
}

}  // namespace flank::internal

namespace flank {
using namespace internal;
namespace {

void check_job(const TrochoidJob& job) {
  check_fields(job);
  check_radius(job.radius);
}

SideFitOptions side_options(const TrochoidJob& job, const CavityFaces& faces) {
  SideFitOptions options;
  options.fit.tolerance_mm = kToleranceBudget.cavity.sides * *job.tolerance_mm;
  options.fit.axis_length_mm = job.tool.axis_length_mm;
  options.fit.bounds = radius_bounds(job.radius, job.obstacles, faces.sides.front().target->diagonal());
  options.fit.bounds.largest = bounds_of(job, faces.width).front();
  options.fit.reach_radius_mm = job.judge.reach_radius_mm.value_or(0.0);
  options.least_coverage = job.judge.least_coverage;
  return options;
}

/// The job gets its tolerance. Where a face lies that could not be read nothing says, so no path beside it can be proved to keep out of it.
Setup read_whole(TrochoidJob& job, std::vector<std::string>& notes) {
  Setup setup = read_setup(machined(job), job.obstacles, job.tolerance_mm, notes);
  job.tolerance_mm = setup.tolerance_mm;
  if (setup.unread.empty()) return setup;
  const std::string face = setup.part.face_id(setup.unread.front());
  throw InputError(
      "part",
      fmt::format(
          "{}: {} cannot be read ({}), so a cavity beside it cannot be checked; `ignore_faces` {} leaves it out",
          setup.part.file, face, setup.part.left_out.at(setup.unread.front()), face));
}

/// What the flank keeps clear of, and how wide the cavity is where a tool comes.
void surround(const TrochoidJob& job, bool shank_in_the_way, const Setup& setup, CavityFaces& faces) {
  // As far as the thickest tool that is tried.
  RadiusBounds bounds = radius_bounds(job.radius, job.obstacles, faces.sides.front().target->diagonal());
  bounds.largest = bounds_of(job, faces.width).front();
  bounds.shank_in_the_way = shank_in_the_way;
  add_group_obstacles(setup, job.obstacles, bounds, faces.sides);
  faces.width = width_between(side_of(faces.sides[0]), side_of(faces.sides[1]));
  if (!(faces.width.narrowest_mm > 0.0))
    throw InputError("left",
                     job.left + ": other faces cover all of it; nothing can be milled between it and " + job.right);
}

/// The tool goes between the sides: where half of their places are too narrow for the thinnest of it, no way leads through.
void require_room(const TrochoidJob& job, const ToolSpec& spec, const CavityFaces& faces) {
  const ToolModel tool = make_tool_model(spec, job.tool.axis_length_mm);
  const bool given = !tool.free() && tool.free_parameters.empty() && tool.radius;
  if (!given && !job.radius.min_mm) return;
  const double length = tool.length_for(std::sqrt(faces.sides.front().target->area()), job.tool.axis_length_mm);
  const double radius = given ? tool.make(length, *tool.radius).smallest() : *job.radius.min_mm;
  const double thinnest = 2.0 * radius, width = faces.width.median_mm;
  if (thinnest >= width)
    throw InputError(given ? "tool" : "radius_min_mm",
                     fmt::format("the tool is at least {:.4g} mm thick, the cavity {:.4g} mm wide in the median "
                                 "({:.4g} mm at its narrowest): use a thinner tool",
                                 thinnest, width, faces.width.narrowest_mm));
}

/// Where a blade stands between the sides, fronts would have to go through it.
void require_way_across(const TrochoidJob& job, const CavityFaces& faces) {
  constexpr double kMost = 0.5;
  const double blocked = blocked_share(side_of(faces.sides[0]), side_of(faces.sides[1]));
  if (blocked <= kMost) return;
  throw InputError(
      "right", fmt::format("another face stands between {} and {} at {:.0f} % of their places: no cutting move gets "
                           "across; give the two sides of the channel on either side of it",
                           job.left, job.right, 100.0 * blocked));
}

/// From the floor to the middle of the sides.
std::optional<Vec3> up_from_floor(const TrochoidJob& job, const Setup& setup, const CavityFaces& faces) {
  if (!job.floor) return {};
  std::vector<Face> floor;
  for (const int face : parse_face_list(setup.part, *job.floor))
    floor.push_back(setup.part.faces[static_cast<std::size_t>(face)]);
  const std::unique_ptr<Target> target = make_target(std::move(floor), +1);
  Vec3 up = Vec3::Zero();
  for (const TargetGroup& side : faces.sides) {
    const Vec3 centre = side.target->box().center();
    up += (centre - target->closest(centre).point).normalized();
  }
  return up.normalized();
}

TrochoidSummary summary_of(const TrochoidJob& job, const SideFit& sides, const CavityProgram& program,
                           double narrowest_mm) {
  TrochoidSummary out;
  out.sides = fit_summary(sides.fit);
  out.most_engagement_deg = job.cycles.most_engagement_deg;
  out.narrowest_mm = narrowest_mm;
  double links = 0.0;
  for (const PlannedLayer& layer : program.layers) {
    out.layers.push_back(summary_of(layer));
    out.layers.back().why = why_not_done(job, layer, sides.fit.after);
    links += layer.links_mm;
  }
  out.minutes = out.way_mm() / job.cycles.feed_mm_min + links / job.cycles.rapid_mm_min;
  return out;
}

/// Tool, path and figures of a plan.
void take(const CavityPlan& plan, const TrochoidJob& job, const ToolSpec& spec, const CavityFaces& faces,
          const ClearanceScene& scene, const Box3& part, Result& result) {
  const FlankFitResult& fit = plan.sides.fit;
  // The verdict, now and later, is about what the cavity allows, and so was the search.
  if (spec.free)
    std::get<TrochoidJob>(result.job).judge.reach_radius_mm = three_digits(asked_ball(job, faces, fit.tool));
  result.motions = fit.motions;
  result.tool = found_tool(spec, fit.tool, job.obstacles);
  result.diagonal_mm = faces.sides.front().target->diagonal();
  const Legitimacy legitimacy = check_legitimacy(result.tool.radial);
  if (!legitimacy.legitimate) result.notes.push_back("the tool's profile is not valid: " + legitimacy.reason);
  result.path = plan.program.path;
  if (job.obstacles.shank == "auto" && !result.path.strips.empty())
    take_clear_shank(scene, part, spec.free ? job.radius.slenderness_max : 1e300,
                     std::get<TrochoidJob>(result.job).obstacles, result);
  result.chord_bound_mm = plan.program.chord_bound_mm;
  TrochoidSummary summary = summary_of(job, plan.sides, plan.program, faces.width.narrowest_mm);
  if (plan.program.layers.empty() && legitimacy.legitimate)
    summary.no_cycles = no_cycles_sentence(job, fit.after, why_no_cycles(plan, {job, faces}));
  result.plan = std::move(summary);
  if (plan.tools > 1)
    result.notes.push_back(
        fmt::format("{} upper limits of the radius were tried, from thick to thin; this tool was found with {:.4g} mm",
                    plan.tools, plan.largest_radius_mm));
  note_what_is_open(job, plan.program, result.notes);
}

/// How much a search does (base/work_count.h), by the word of the job.
double most_looks_of(const TrochoidJob& job) {
  constexpr double kNormal = 1e8, kQuick = 2e7, kNoLimit = 1e300;
  return job.effort == "quick" ? kQuick : job.effort == "thorough" ? kNoLimit : kNormal;
}

/// A shank that is to be chosen is that of the path found. The search ends after so many looks, with its best so far.
Result plan_trochoid(const TrochoidJob& request, KnownShank known, double most_looks, const Progress& asked) {
  const bool shank_in_the_way = known == KnownShank::kInTheWay;
  const Progress progress = with_journal(asked);
  check_job(request);
  Result result;
  TrochoidJob job = request;
  // The same as not asked for, to the byte.
  if (job.part.allowance_mm == 0.0) job.part.allowance_mm.reset();
  result.inputs = input_stamps(job);
  const ToolSpec spec = parse_tool_spec(job.tool.spec);
  result.notes.insert(result.notes.end(), spec.notes.begin(), spec.notes.end());
  job.obstacles.shank = default_shank(job.obstacles, spec.tool && has_body(*spec.tool));
  check_obstacles(job.obstacles, spec.tool ? &*spec.tool : nullptr);
  Stopwatch watch(result);
  progress.step("read", 0.0);
  const Setup setup = read_whole(job, result.notes);
  result.job = job;
  result.part_sha256 = setup.part.sha256;
  progress.journal->begin(journal_key(job, result.part_sha256));
  CavityFaces faces = cavity_faces(job, setup);
  const ClearanceScene scene = make_clearance_scene(setup, job.obstacles, has_body(spec, job.obstacles), result.notes);
  if (job.avoid) surround(job, shank_in_the_way, setup, faces);
  require_room(job, spec, faces);
  require_way_across(job, faces);
  if (spec.free) faces.ball_mm = reach_in_gap(setup, kMostOfWidth * faces.width.narrowest_mm);
  SideFitOptions options = side_options(job, faces);
  options.fit.bounds.shank_in_the_way = shank_in_the_way;
  options.up = up_from_floor(job, setup, faces);
  watch.lap("read");

  PlanJudge judge(
      setup, scene, job,
      [&](const CavityPlan& plan, Result& out) { take(plan, job, spec, faces, scene, setup.part.box, out); }, watch);
  const Progress searching = limited(progress, most_looks);
  const CavityPlan plan = search_cavity(
      job, faces, make_tool_model(spec, job.tool.axis_length_mm), options,
      [&](const CavityPlan& tried) { return judge.find(tried); }, searching);
  if (plan.sides.fit.motions.empty()) stop_here();
  if (plan.sides.fit.motions.empty())
    throw InputError(
        "left", fmt::format("no tool of radius up to {:.4g} mm fits into the cavity, {:.3f} mm wide at its narrowest",
                            options.fit.bounds.largest, faces.width.narrowest_mm));
  take(plan, job, spec, faces, scene, setup.part.box, result);
  watch.lap("cycles");
  result.complete = !progress.stop();
  if (result.complete && searching.stop()) note_limit_of_work(result);

  progress.step("verify", 0.9);
  judge.finish(plan, result);
  const FlankFitResult& sides = plan.sides.fit;
  const auto own_reach = [&] {
    return reach_of_tool(side_of(faces.sides[0]), side_of(faces.sides[1]), sides.motions, sides.tool);
  };
  note_own_reach(job, own_reach, result);
  note_nearest(result);
  if (!result.complete) result.journal = progress.journal;
  return result;
}

}  // namespace

Result run_trochoid(const TrochoidJob& request, const Progress& asked) {
  // Another search with the shank in the way has what the first one left.
  const auto plan = [&, before = work_done()](const TrochoidJob& job, KnownShank known, const Progress& progress) {
    const double left = most_looks_of(job) - static_cast<double>(work_done() - before);
    return plan_trochoid(job, known, left, progress);
  };
  return with_room_for_shank<TrochoidJob>(request, false, kAnySlenderness, plan, asked);
}

}  // namespace flank
