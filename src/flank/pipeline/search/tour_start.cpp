#include "flank/pipeline/search/tour_start.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "flank/fit/rank.h"
#include "flank/motion/motion_part.h"
#include "flank/tour/tour.h"

namespace flank::internal {
namespace {

/// The tours of all groups, with one tool; none if one of them has none.
struct Tours {
  std::vector<FitTask> tasks;
  std::vector<std::size_t> group_of_motion;
  std::optional<RadialFunction> tool;
  double twist_rad = 0.0;
  std::vector<std::string> notes;
};

std::optional<Tour> tour_of(const Setup& setup, const TargetGroup& group, const ToolModel& tool,
                            const FlankFitOptions& options, const std::optional<double>& length) {
  TourRequest request;
  for (const int face : group.indices) request.walls.push_back(setup.part.faces[static_cast<std::size_t>(face)]);
  request.tool = [&](double axis_length) { return tool.make(axis_length, tool.radius.value_or(1.0)); };
  request.axis_length_mm = length;
  request.obstacles = group.obstacles.get();
  request.is_free_line = options.is_free_line;
  request.tolerance_mm = options.tolerance_mm;
  request.allowance_mm = setup.allowance_mm;
  return make_tour(request);
}

std::optional<Tours> tours_of(const Setup& setup, const std::vector<TargetGroup>& groups, const ToolModel& tool,
                              const FlankFitOptions& options) {
  const bool given = tool.make && tool.free_parameters.empty();
  if (!given || setup.part.is_mesh()) return {};
  Tours tours;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::optional<double> length = tool.axis_length ? tool.axis_length : options.axis_length_mm;
    if (tours.tool) length = tours.tool->axis_length();  // the first group says how long it is
    std::optional<Tour> tour = tour_of(setup, groups[g], tool, options, length);
    if (!tour) return {};
    tours.tool = tour->tool;
    for (RuledMotion& motion : tour->motions) {
      tours.tasks.push_back({groups[g].target.get(), std::move(motion), groups[g].obstacles.get()});
      tours.group_of_motion.push_back(g);
    }
    tours.twist_rad = std::max(tours.twist_rad, tour->twist_rad);
    tours.notes.insert(tours.notes.end(), tour->notes.begin(), tour->notes.end());
  }
  return tours;
}

/// What tours do, by the estimate. That knows a motion at so many poses, and a tour has a hundred rounds and levels: it is shown part by
/// part, and stays whole.
GroupFits estimated(const Tours& tours, const ToolModel& tool, const FlankFitOptions& options) {
  constexpr int kPolesAtOnce = 32;
  std::vector<FitTask> parts;
  for (const FitTask& task : tours.tasks) {
    const int count = 1 + task.motion.tip.count() / kPolesAtOnce;
    for (int k = 0; k < count; ++k)
      parts.push_back(
          {task.target, motion_part(task.motion, static_cast<double>(k) / count, (k + 1.0) / count), task.obstacles});
  }
  GroupFits fits{fit_as_found(parts, *tours.tool, tool, options), tours.group_of_motion};
  fits.fit.motions.clear();
  for (const FitTask& task : tours.tasks) fits.fit.motions.push_back(task.motion);
  fits.fit.candidates = 1;
  fits.fit.notes.insert(fits.fit.notes.end(), tours.notes.begin(), tours.notes.end());
  return fits;
}

}  // namespace

ToursOrFits fit_groups_after_tours(const Setup& setup, const std::vector<TargetGroup>& groups, const ToolModel& tool,
                                   const FlankFitOptions& options, const GroupDemand& demand,
                                   const Progress& progress) {
  constexpr double kNoTwist = 1e-4;  // rad
  const double wanted = *std::max_element(demand.wanted.begin(), demand.wanted.end());
  std::optional<ToursOrFits> best;
  const std::optional<Tours> tours = tours_of(setup, groups, tool, options);
  const int asked = demand.strips * static_cast<int>(groups.size());
  if (tours && (asked <= 0 || asked == static_cast<int>(tours->tasks.size()))) {
    best = ToursOrFits{estimated(*tours, tool, options), tours->twist_rad <= kNoTwist};
    if (meets(best->found.fit.after, wanted, options) || progress.stop()) return std::move(*best);
  }
  GroupFits found = fit_groups(groups, tool, options, demand, progress);
  if (!best || is_better(found.fit.after, best->found.fit.after, options)) return {std::move(found)};
  return std::move(*best);
}

}  // namespace flank::internal
