#include "flank/pipeline/auto_shank.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/results/acceptance.h"
#include "flank/setup/shank_reach.h"

namespace flank::internal {
namespace {

/// The progress of one of several plans, a share of the whole: its steps are in no journal.
Progress run_of_its_own(const Progress& progress, double from, double to) {
  Progress part = progress.part(from, to);
  part.journal.reset();
  return part;
}

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

}  // namespace

void take_shank(const Path& path, const Box3& part, ObstacleRequest& obstacles, Tool& tool) {
  choose_shank(tool, path, part, obstacles);
  obstacles.shank = "given";
  equip_tool(obstacles, tool);
}

template <class Job>
Result with_auto_shank(const Job& job, const Progress& progress,
                       const std::function<Result(const Job&, const Progress&)>& plan) {
  Result found = plan(job, run_of_its_own(progress, 0.0, 0.5));
  const Acceptance first = found.acceptance();
  if (found.complete && fails_by(first, Figure::kClearance)) {
    Job with = job;
    with.obstacles = std::get<Job>(found.job).obstacles;
    Result again = plan(with, run_of_its_own(progress, 0.5, 1.0));
    if (again.acceptance().reasons.size() < first.reasons.size()) found = std::move(again);
  }
  note_chosen_shank(found.tool, std::get<Job>(found.job).obstacles, found.notes);
  return found;
}

template Result with_auto_shank<FitJob>(const FitJob&, const Progress&,
                                        const std::function<Result(const FitJob&, const Progress&)>&);
template Result with_auto_shank<CoverJob>(const CoverJob&, const Progress&,
                                          const std::function<Result(const CoverJob&, const Progress&)>&);
template Result with_auto_shank<TrochoidJob>(const TrochoidJob&, const Progress&,
                                             const std::function<Result(const TrochoidJob&, const Progress&)>&);

}  // namespace flank::internal
