#include "flank/pipeline/fit_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "flank/base/tolerance_budget.h"
#include "flank/error.h"
#include "flank/seed/guide_start.h"
#include "flank/seed/line_start.h"
#include "flank/setup/make_obstacles.h"
#include "flank/toolbox/tool_model.h"

namespace flank::internal {
namespace {

/// The two ends of "x,y,z,x,y,z".
std::pair<Vec3, Vec3> parse_line(const std::string& text) {
  std::stringstream stream(text);
  double v[6];
  char comma = ',';
  for (int k = 0; k < 6; ++k) {
    if (k > 0 && (!(stream >> comma) || comma != ',')) comma = 0;
    if (comma != ',' || !(stream >> v[k]) || !std::isfinite(v[k]))
      throw UsageError("--start '" + text +
                       "': six numbers x,y,z,x,y,z are needed (tip and holder end of the axis, mm)");
  }
  if (stream >> comma) throw UsageError("--start '" + text + "': more than six numbers");
  return {Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])};
}

/// One group: automatic, or with the strips that the tolerance needs.
FlankFitResult fit_group(const Target& target, const ToolModel& tool, FlankFitOptions options, int strips,
                         double least_coverage, const Progress& progress) {
  if (strips > 0) {
    options.strips = strips;
    return fit_automatic(target, tool, options, progress);
  }
  FlankFitResult best;
  double best_score = -1.0;
  for (int count : {1, 2, 3, 4, 6, 8, 10, kMostStrips}) {
    options.strips = count;
    options.least_coverage_for_last_passes = count < kMostStrips ? 0.7 : 0.0;
    FlankFitResult result = fit_automatic(target, tool, options, progress);
    const double score = result.after.score(options.tolerance_mm);
    if (score > best_score) {
      best_score = score;
      best = std::move(result);
    }
    const bool done =
        best.after.at_tolerance >= std::max(least_coverage, 0.97) && best.after.overcut_mm <= options.tolerance_mm;
    if (done || progress.stop()) break;
  }
  return best;
}

/// All groups with one tool: the first finds it, the others are fitted to it, then all are polished together.
void fit_groups(const FitJob& job, FitSearch& search, const ToolModel& tool, const FlankFitOptions& options,
                const Progress& progress) {
  std::vector<FitTask> tasks;
  ToolModel shared = tool;
  for (std::size_t g = 0; g < search.targets.size(); ++g) {
    const Target& target = *search.targets[g].target;
    FlankFitOptions own = options;
    own.obstacles = search.targets[g].obstacles.get();
    FlankFitResult result = fit_group(target, shared, own, job.strips, job.least_coverage, progress);
    for (const RuledMotion& motion : result.motions) {
      tasks.push_back({&target, motion, own.obstacles});
      search.group_of_motion.push_back(g);
    }
    if (g == 0) {
      const RadialFunction radial = result.tool;
      shared.make = [radial](double, double) { return radial; };
      shared.free_parameters.clear();
      shared.axis_length = radial.axis_length();
      shared.radius = radial.at(0.5 * radial.axis_length()).r;
    }
    if (search.targets.size() == 1) search.fit = std::move(result);
  }
  if (search.targets.size() > 1) search.fit = fit_from_starts(tasks, tool, options, progress);
}

double mean_score(const FitSearch& search, double tolerance_mm) { return search.fit.after.score(tolerance_mm); }

/// Gives every target the faces that its flank keeps clear of: the check faces, the other targets and fixtures.
void add_obstacles(const FitJob& job, const Part& part, const std::vector<int>& faces, const std::vector<int>& checks,
                   double largest_radius, FitSearch& search) {
  /// The flank lies within a diameter of its target, and the walls of a channel beyond it count.
  constexpr double kReach = 2.0;
  /// Above the target by about a small tool's radius.
  constexpr double kVoterHeight = 0.5;
  const std::vector<Part> fixtures = read_fixtures(job.clearance.fixtures, job.unit);
  for (TargetGroup& group : search.targets) {
    ObstacleChoice choice = choose_obstacles(group.indices, faces, checks);
    choice.fixtures = fixtures;
    choice.clearance_mm = job.clearance.required_mm;
    choice.tolerance_mm = job.tolerance_mm;
    ObstacleDetail detail;
    detail.faces_within_mm = kReach * largest_radius;
    const Obstacles obstacles = make_obstacles(part, *group.target, choice, detail, search.fit.notes);
    if (!obstacles.faces.empty())
      group.obstacles = std::make_unique<ObstacleField>(obstacles, *group.target, kVoterHeight * largest_radius,
                                                        kToleranceBudget.others.fit_allowance * job.tolerance_mm);
  }
}

FitSearch search_side(const FitJob& job, const Part& part, const std::vector<int>& faces,
                      const std::vector<int>& checks, const ToolSpec& spec, int side,
                      const std::function<RadiusBounds(const FitJob&, double)>& bounds, const Progress& progress) {
  FitSearch search;
  search.targets = make_targets(part, faces, side);
  FlankFitOptions options;
  options.tolerance_mm = job.tolerance_mm;
  options.axis_length_mm = job.axis_length_mm;
  options.bounds = bounds(job, search.targets.front().target->diagonal());
  options.reach_radius_mm = job.reach_radius_mm.value_or(0.0);
  const ToolModel tool = make_tool_model(spec);
  if (job.avoid) add_obstacles(job, part, faces, checks, options.bounds.largest, search);
  if (!job.start && !job.guide) {
    fit_groups(job, search, tool, options, progress);
    return search;
  }
  if (search.targets.size() > 1) throw UsageError("--start and --guide take faces that hang together");
  const Target& target = *search.targets.front().target;
  FitTask task{&target, {}, search.targets.front().obstacles.get()};
  if (job.start) {
    const auto [tip, end] = parse_line(*job.start);
    const double length = tool.axis_length.value_or(job.axis_length_mm.value_or((end - tip).norm()));
    if (!(length > 0.0)) throw UsageError("--start: the two ends of the axis coincide");
    const LineStart start = start_from_line(target, {tip, (end - tip).normalized()}, length);
    search.fit.notes.push_back(start.report.message);
    if (start.report.status == LineStartStatus::kNoMotion)
      throw InputError("--start: this line cannot move along the face: " + start.report.message);
    task.motion = start.motion;
  } else {
    const std::optional<double> length = tool.axis_length ? tool.axis_length : job.axis_length_mm;
    const GuideStart start = start_from_guide(*job.guide, read_guide(*job.guide), length);
    task.motion = start.motion;
  }
  const std::vector<std::string> notes = search.fit.notes;
  search.fit = fit_from_starts({task}, tool, options, progress);
  search.fit.notes.insert(search.fit.notes.begin(), notes.begin(), notes.end());
  search.group_of_motion = {0};
  return search;
}

/// The side of an open sheet on which the user's line lies.
int side_of_start(const FitJob& job, const Part& part, const std::vector<int>& faces) {
  const std::vector<TargetGroup> targets = make_targets(part, faces, +1);
  if (job.start) {
    const auto [tip, end] = parse_line(*job.start);
    return side_of_line(*targets.front().target, {tip, (end - tip).normalized()}, (end - tip).norm());
  }
  const GuideStart start = start_from_guide(*job.guide, read_guide(*job.guide), job.axis_length_mm);
  return side_of_motion(*targets.front().target, start.motion);
}

}  // namespace

FitSearch search_fit(const FitJob& job, const Part& part, const std::vector<int>& faces, const std::vector<int>& checks,
                     const ToolSpec& spec, const std::function<RadiusBounds(const FitJob&, double diagonal)>& bounds,
                     const Progress& progress) {
  const bool sheet =
      part.is_mesh() || std::any_of(faces.begin(), faces.end(), [&](int f) { return !part.faces[f].of_solid; });
  if (!sheet || job.side) return search_side(job, part, faces, checks, spec, job.side.value_or(+1), bounds, progress);
  if (job.start || job.guide)
    return search_side(job, part, faces, checks, spec, side_of_start(job, part, faces), bounds, progress);
  FitSearch plus = search_side(job, part, faces, checks, spec, +1, bounds, progress);
  FitSearch minus = search_side(job, part, faces, checks, spec, -1, bounds, progress);
  const bool first = mean_score(plus, job.tolerance_mm) >= mean_score(minus, job.tolerance_mm);
  FitSearch& best = first ? plus : minus;
  best.fit.notes.push_back(
      fmt::format("open sheet: both sides were tried, side {} covers more; choose with --side", first ? "+" : "-"));
  return std::move(best);
}

}  // namespace flank::internal
