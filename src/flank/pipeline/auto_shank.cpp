#include "flank/pipeline/auto_shank.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "flank/error.h"
#include "flank/pipeline/run_journal.h"
#include "flank/results/acceptance.h"
#include "flank/setup/shank_reach.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

bool fails_by(const Acceptance& acceptance, Figure figure) {
  return std::any_of(acceptance.reasons.begin(), acceptance.reasons.end(),
                     [&](const auto& reason) { return reason.figure == figure_name(figure); });
}

void note_chosen_shank(const Tool& tool, const ObstacleRequest& chosen, std::vector<std::string>& notes) {
  if (chosen.shank_length_mm)
    notes.push_back(
        fmt::format("the shank was chosen: diameter {:.4g} mm, {:g} mm above the flank, where it is out of the part; "
                    "`shank_length_mm` gives another one, `shank` none leaves it out",
                    tool.shank.empty() ? 0.0 : 2.0 * tool.shank.back().y(), *chosen.shank_length_mm));
}

/// By how much the shank of a tool is nearer than it must be, and than `least_mm`; <= 0: nowhere. None: something else comes too near, which no
/// thinner shank helps.
std::optional<double> missing_room(const ClearanceScene& scene, const Tool& tool, const Path& path, double least_mm) {
  double missing = 0.0;
  for (const ClearanceFigure& figure : measure_clearance(scene, tool, path).figures) {
    if (figure.body == ToolBody::kShank)
      missing = std::max(missing, std::max(figure.required_mm, least_mm) - (figure.clearance_mm - figure.bound_mm));
    else if (!figure.kept)
      return std::nullopt;
  }
  return missing;
}

Tool with_shank(const ObstacleRequest& obstacles, Tool flank) {
  equip_tool(obstacles, flank);
  return flank;
}

/// The radius at which the chosen shank is clear, by as much thinner as it comes too near.
std::optional<double> clear_radius(const ClearanceScene& scene, const Path& path, double slenderest, const Tool& flank,
                                   double least_mm, ObstacleRequest chosen) {
  constexpr int kMost = 5;           // times: the nearest place changes
  constexpr double kWhole = 100.0;   // radii to a hundredth of a millimetre
  constexpr double kThinnest = 0.1;  // of the first radius: thinner ones hold nothing (judge_hold)
  const double thick = with_shank(chosen, flank).shank.back().y();
  for (int k = 0; k < kMost; ++k) {
    const Tool tool = with_shank(chosen, flank);
    if (!(stiffness(tool).slenderness <= slenderest)) return std::nullopt;
    const std::optional<double> missing = missing_room(scene, tool, path, least_mm);
    if (!missing) return std::nullopt;
    const double radius = tool.shank.back().y();
    if (*missing <= 0.0) return radius;
    chosen.shank_radius_mm = std::floor(kWhole * (radius - *missing)) / kWhole;
    if (!(*chosen.shank_radius_mm > kThinnest * thick)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

void choose_clear_shank(const ClearanceScene& scene, const Path& path, const Box3& part, double slenderest,
                        const Tool& flank, ObstacleRequest& obstacles) {
  const bool open = !obstacles.shank_radius_mm;
  choose_shank(flank, path, part, obstacles);
  obstacles.shank = "given";
  if (!open) return;
  const double thick = with_shank(obstacles, flank).shank.back().y();
  // Out of contact, or else no deeper than is allowed.
  for (const double least_mm : {0.0, -1e300}) {
    const std::optional<double> radius = clear_radius(scene, path, slenderest, flank, least_mm, obstacles);
    if (radius && *radius < thick) obstacles.shank_radius_mm = radius;
    if (radius) return;
  }
}

void take_clear_shank(const ClearanceScene& scene, const Box3& part, double slenderest, ObstacleRequest& obstacles,
                      Result& result) {
  Tool flank = result.tool;
  flank.shank.clear();
  choose_clear_shank(scene, result.path, part, slenderest, flank, obstacles);
  equip_tool(obstacles, result.tool);
}

std::string default_shank(const ObstacleRequest& request, bool own_body) {
  const bool given = own_body || request.shank_length_mm || request.holder;
  return request.shank == "given" && !given ? "auto" : request.shank;
}

namespace {

/// The plan with the shank in the way; nothing if it was stopped, however early.
template <class Job>
std::optional<Result> whole_of(const ShankPlan<Job>& plan, const Job& job, const Progress& progress) {
  try {
    Result result = plan(job, true, progress);
    if (result.complete) return result;
  } catch (const Stopped&) {  // what was found without it in the way stays
  }
  return std::nullopt;
}

}  // namespace

template <class Job>
Result with_room_for_shank(const Job& job, bool always, const ShankPlan<Job>& plan, const Progress& asked) {
  constexpr double kFirst = 0.8;  // of the progress
  const Progress progress = with_journal(asked);
  Result found = plan(job, false, progress.part(0.0, kFirst));
  const ObstacleRequest made = std::get<Job>(found.job).obstacles;
  const bool chosen = made.shank_length_mm && !job.obstacles.shank_length_mm;
  const Acceptance first = found.acceptance();
  // Where nothing at all could hold the tool there is no room for any shank.
  const bool in_the_way = fails_by(first, Figure::kClearance) && !fails_by(first, Figure::kHold);
  if (found.complete && made.shank_length_mm && (chosen || !always) && in_the_way) {
    Job with = job;
    with.obstacles = made;
    const std::optional<Result> again = whole_of(plan, with, progress.part(kFirst, 1.0));
    if (!again) {
      found.complete = false;
      found.journal = progress.journal;
    } else if (again->acceptance().reasons.size() < first.reasons.size()) {
      found = *again;
    }
  }
  if (chosen) note_chosen_shank(found.tool, std::get<Job>(found.job).obstacles, found.notes);
  return found;
}

template Result with_room_for_shank<FitJob>(const FitJob&, bool, const ShankPlan<FitJob>&, const Progress&);
template Result with_room_for_shank<CoverJob>(const CoverJob&, bool, const ShankPlan<CoverJob>&, const Progress&);
template Result with_room_for_shank<TrochoidJob>(const TrochoidJob&, bool, const ShankPlan<TrochoidJob>&,
                                                 const Progress&);

}  // namespace flank::internal
