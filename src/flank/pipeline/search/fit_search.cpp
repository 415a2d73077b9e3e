#include "flank/pipeline/search/fit_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "flank/base/work_count.h"
#include "flank/error.h"
#include "flank/path/turning.h"
#include "flank/pipeline/search/out_of_reach.h"
#include "flank/pipeline/search/reach_ball.h"
#include "flank/pipeline/search/reach_further.h"
#include "flank/pipeline/search/search_setup.h"
#include "flank/pipeline/search/tour_start.h"
#include "flank/seed/axis_line.h"
#include "flank/seed/guide_file.h"
#include "flank/seed/guide_start.h"
#include "flank/seed/line_start.h"
#include "flank/surface/facet_gaps.h"
#include "flank/tool_request/tool_model.h"

namespace flank::internal {
namespace {

/// The start that a user gives: one line, or the lines of a guide; both may be missing.
struct UserStart {
  std::optional<AxisLine> line;
  std::vector<AxisLine> guide;
  [[nodiscard]] bool given() const { return line || !guide.empty(); }
};

UserStart user_start(const FitJob& job) {
  UserStart start;
  if (job.start) start.line = parse_start_line(*job.start);
  if (job.guide) start.guide = read_guide(*job.guide);
  return start;
}

/// Of a fit that needs no rival: the judge, who is stricter than the estimate, still finds what is asked for covered. Little more
/// than wanted_estimate: a fit that just misses this and has that is searched for by all other means, and then taken.
double enough_for(double least_coverage) {
  constexpr double kOfTheRest = 0.4;  // of what may be missing
  return 1.0 - (1.0 - kOfTheRest) * (1.0 - least_coverage);
}

/// Where facets keep every motion from what was asked, no more than they leave is searched for, and that with little: other ways and
/// more candidates cost as much as all else, and facets stay what they are.
void limit_effort_to_facet_bound(double most, FlankFitOptions& options) {
  options.enough_coverage = std::min(options.enough_coverage, most);
  options.search_without_obstacles = false;
  options.polished_candidates = 2;
  options.finalists = 1;
}

/// How much a search does, by the word of the job.
struct Effort {
  double most_looks = 0.0;  ///< (base/work_count.h); a search that has done as much ends with its best so far
  int most_strips = kMostStrips;
  int polished_candidates = 0, finalists = 0;
  bool soften = true;
};

Effort effort_of(const FitJob& job) {
  constexpr double kNormal = 3e8, kQuick = 2e7, kNoLimit = 1e300;
  if (job.effort == "quick") return {kQuick, 4, 2, 1, false};
  if (job.effort == "thorough") return {kNoLimit, kMostStrips, 12, 6, true};
  return {kNormal, kMostStrips, 6, 3, true};
}

/// `free_tool`: what is reachable is asked with the ball of the demand.
FlankFitOptions options_of(const FitJob& job, const Setup& setup, const Target& target, bool free_tool) {
  FlankFitOptions options;
  const double most = coverage_bound_by_facets(target, *job.tolerance_mm),
               least = std::min(job.judge.least_coverage, most);
  options.tolerance_mm = *job.tolerance_mm;
  const Effort effort = effort_of(job);
  options.polished_candidates = effort.polished_candidates;
  options.finalists = effort.finalists;
  options.least_coverage = least;
  options.enough_coverage = std::min(options.enough_coverage, enough_for(least));
  if (job.judge.most_turn_deg > 0.0) options.most_turn_rad = job.judge.most_turn_deg * std::numbers::pi / 180.0;
  if (most < job.judge.least_coverage) limit_effort_to_facet_bound(most, options);
  options.axis_length_mm = job.tool.axis_length_mm;
  options.bounds = bounds_for(job, target);
  const double demanded = free_tool ? demanded_reach(job, setup, target, options.bounds) : 0.0;
  options.reach_radius_mm = job.judge.reach_radius_mm.value_or(demanded);
  return options;
}

/// The estimate that promises what was asked. The judge is stricter, by how much nobody knows before it has judged: then the search
/// goes on from there, with that much to spare (run_fit).
double wanted_estimate(const FitJob& job, const Target& target, double spare_coverage) {
  constexpr double kLeastEstimate = 0.97, kMost = 0.95;  // of the face; of what may be missing
  const double least = job.judge.least_coverage;
  const double wanted = std::max(least + std::min(spare_coverage, kMost * (1.0 - least)), kLeastEstimate);
  return std::min(wanted, coverage_bound_by_facets(target, *job.tolerance_mm));
}

/// The motion of a start over the target; `notes` gets what its propagation says.
RuledMotion motion_of(const FitJob& job, const UserStart& start, const ToolModel& tool, const Target& target,
                      std::vector<std::string>& notes) {
  const std::optional<double> length = tool.axis_length ? tool.axis_length : job.tool.axis_length_mm;
  if (!start.line) return start_from_guide(*job.guide, start.guide, length).motion;
  const LineStart found = start_from_line(target, start.line->pose(), length.value_or(start.line->length()));
  notes.push_back(found.report.message);
  if (found.report.status == LineStartStatus::kNoMotion)
    throw InputError("start", "the first tool axis cannot move along the face: " + found.report.message);
  return found.motion;
}

/// Where other faces leave no room for the demanded ball (a slot), the one that they leave room for.
void fit_ball_to_slot(const FitJob& job, FitSearch& search) {
  FlankFitOptions& options = search.options;
  const TargetGroup& group = search.targets.front();
  FlankFitOptions beside = options;
  beside.obstacles = group.obstacles.get();
  search.open_share = reachable_share(*group.target, beside);
  const bool demanded = search.reach_radius_mm && !job.judge.reach_radius_mm;
  if (!demanded || !group.obstacles || search.open_share >= kHardlyAny) return;
  const double ball = ball_with_room(*group.target, beside, options.reach_radius_mm);
  allow_thin(job, ball, options.bounds);
  // Thicker tools would only spoil the choice of those that starts are made with.
  constexpr double kThickest = 1.5;  // of the ball
  if (!job.radius.max_mm) options.bounds.largest = std::min(options.bounds.largest, kThickest * ball);
  search.reach_radius_mm = options.reach_radius_mm = three_digits(ball);
}

/// The window in which turns are asked, as the judge has it (path/turning.h): of the largest face; pieces of one belong together.
double turn_window_of(const std::vector<TargetGroup>& groups) {
  constexpr double kSpacing = 0.02;  // of the square root of the area
  std::map<int, Box3> faces;
  double size = 0.0;
  if (groups.size() == 1) return turn_window(size);
  for (const TargetGroup& group : groups)
    for (const int face : group.indices) {
      const double spacing = kSpacing * std::sqrt(group.target->area());
      for (const SurfaceSample& sample : group.target->samples(spacing)) faces[face].add(sample.point);
      for (const Vec3& point : group.target->border_points(spacing)) faces[face].add(point);
    }
  for (const auto& [face, box] : faces) size = std::max(size, box.diagonal());
  return turn_window(size);
}

/// Before anything is fitted: groups, the obstacles about them, and what is asked.
FitSearch begin_search(const FitJob& job, const Setup& setup, const ToolModel& tool, const FitDemand& demand) {
  FitSearch search;
  search.spare_coverage = demand.spare_coverage;
  search.targets = make_targets(setup);
  search.tool = tool;
  search.options = options_of(job, setup, *search.targets.front().target, tool.free());
  if (job.avoid) search.options.is_free_line = demand.is_free_line;
  search.options.bounds.shank_in_the_way = job.avoid && demand.shank_in_the_way;
  search.options.turn_window_mm = turn_window_of(search.targets);
  if (tool.free()) search.reach_radius_mm = search.options.reach_radius_mm;
  if (job.avoid) add_group_obstacles(setup, job.obstacles, search.options.bounds, search.targets);
  fit_ball_to_slot(job, search);
  return search;
}

/// What a user begins with must lie where the tool belongs.
void require_machined_side(const FitJob& job, const UserStart& start, const RuledMotion& motion, const Target& target) {
  const int side =
      start.line ? side_of_line(target, start.line->pose(), start.line->length()) : side_of_motion(target, motion);
  if (side < 0)
    throw InputError(
        start.line ? "start" : "guide",
        fmt::format("lies on the side of {} that is not machined; for an open sheet `side` chooses the other one",
                    job.part.target_text()));
}

FitSearch search_from(const FitJob& job, const Setup& setup, const ToolModel& tool, const UserStart& start,
                      const FitDemand& demand, const Progress& progress) {
  FitSearch search = begin_search(job, setup, tool, demand);
  const FlankFitOptions options = search.options;
  if (!start.given()) {
    const Effort effort = effort_of(job);
    GroupDemand groups{.strips = job.strips, .most_strips = effort.most_strips, .soften = effort.soften, .wanted = {}};
    for (const TargetGroup& group : search.targets)
      groups.wanted.push_back(wanted_estimate(job, *group.target, search.spare_coverage));
    auto [found, exact] = fit_groups_after_tours(setup, search.targets, tool, options, groups, progress);
    search.exact = exact;
    found.fit.notes.insert(found.fit.notes.begin(), search.fit.notes.begin(), search.fit.notes.end());
    search.fit = std::move(found.fit);
    search.group_of_motion = std::move(found.group_of_motion);
    return search;
  }
  if (search.targets.size() > 1) throw UsageError(start.line ? "start" : "guide", "needs faces that are connected");
  const TargetGroup& group = search.targets.front();
  std::vector<std::string> notes = search.fit.notes;
  const FitTask task{group.target.get(), motion_of(job, start, tool, *group.target, notes), group.obstacles.get()};
  require_machined_side(job, start, task.motion, *group.target);
  search.fit = fit_from_starts({task}, tool, options, progress);
  search.fit.notes.insert(search.fit.notes.begin(), notes.begin(), notes.end());
  search.group_of_motion = {0};
  return search;
}

/// Half a turn is searched; the whole face is what was asked for.
FitSearch search_half_turn(const FitJob& job, const Setup& setup, const WoundFace& wound_face, const ToolModel& tool,
                           const Progress& progress, const FitDemand& demand) {
  FitSearch search = search_from(job, half_turn_of(setup, wound_face), tool, {}, demand, progress);
  search.wound_face = wound_face;
  search.wound = make_targets(setup);
  if (job.avoid) add_group_obstacles(setup, job.obstacles, search.options.bounds, search.wound);
  search.fit.notes.push_back(
      fmt::format("{} winds {:.1f} times round its axis: the motion found for half a turn was extended along the helix",
                  search.wound.front().faces, wound_face.turns()));
  return search;
}

}  // namespace

std::vector<FitTask> FitSearch::tasks() const {
  std::vector<FitTask> tasks;
  for (std::size_t m = 0; m < fit.motions.size(); ++m) {
    const TargetGroup& group = targets[group_of_motion[m]];
    tasks.push_back({group.target.get(), fit.motions[m], group.obstacles.get()});
  }
  return tasks;
}

std::vector<RuledMotion> FitSearch::motions_of(const FlankFitResult& result) const {
  if (!wound_face) return result.motions;
  std::vector<RuledMotion> motions;
  for (const RuledMotion& motion : result.motions)
    motions.push_back(extend_along_screw(*wound_face, *targets.front().target, wound.front().obstacles.get(), motion,
                                         result.tool, options.tolerance_mm));
  return motions;
}

namespace {

/// A search that came to its limit has left out its last look, if its best was one of many strips that were still to be beaten.
void end_at_limit(FitSearch& search) {
  search.limited = true;
  search.fit.notes.push_back(
      "the search reached its limit of work; this is the best found. `--effort thorough` has no limit");
  if (!search.fit.closely_measured && !search.fit.motions.empty())
    search.fit = with_close_look(search.tasks(), search.fit, search.tool, search.options);
}

}  // namespace

FitSearch search_fit(const FitJob& job, const Setup& setup, const ToolSpec& spec, const Progress& asked,
                     const FitDemand& demand) {
  const Progress progress = limited(asked, effort_of(job).most_looks);
  const UserStart start = user_start(job);
  const ToolModel tool = make_tool_model(spec, job.tool.axis_length_mm);
  const std::optional<WoundFace> wound_face = start.given() ? std::nullopt : find_wound_face(setup);
  FitSearch search = wound_face ? search_half_turn(job, setup, *wound_face, tool, progress, demand)
                                : search_from(job, setup, tool, start, demand, progress);
  if (!search.exact) search.fit = reach_further(search.tasks(), search.fit, search.tool, search.options, progress);
  if (progress.stop() && !asked.stop()) end_at_limit(search);
  return search;
}

}  // namespace flank::internal
