/// Several ways to keep a flank clear of the other faces, and the choice among them.
///
/// A fit that avoids the other faces from the start finds motions that a fit without them cannot (a channel, a hub). It
/// can also be driven off a motion that was all but clear. So where it does not give what was asked, others follow:
/// the fit as if nothing were in the way, which is free where it enters nothing; the same led clear by the last
/// passes; and the same on the part of the axis, or of the path, that enters nothing.
#pragma once

#include <functional>
#include <optional>

#include "flank/fit.h"
#include "flank/fit/polished.h"

namespace flank::internal {

/// What a search from all starts gives under these options; their obstacles may be null.
using StartSearch = std::function<FlankFitResult(const FlankFitOptions&)>;

/// FlankFitOptions::least_coverage_for_last_passes for a search that is only to beat this rival.
[[nodiscard]] double least_to_win(const CoverageEstimate& rival, const FlankFitOptions& options);
/// Whether no last look (repair_closely(), polish.h) at a way makes it better than a rival that has been looked at.
[[nodiscard]] bool cannot_win(const CoverageEstimate& way, const CoverageEstimate& rival,
                              const FlankFitOptions& options);

/// The draft on the longest part of the axis that enters obstacles by no more than a depth, mm. None if that is all of
/// it or less than a third, or if the tool is given. The draft has an obstacle field for every motion.
[[nodiscard]] std::optional<FitDraft> shortened_axis(const FitDraft& draft, double depth_mm);

/// The same of each motion's path, from time to time; the tool stays.
[[nodiscard]] std::optional<FitDraft> shortened_path(const FitDraft& draft, double depth_mm);

/// The best of `first`, which was found with options.obstacles (not null) in the way, and the other ways. The result's
/// notes say which it is if it is not the first.
[[nodiscard]] FlankFitResult best_way(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                                      FlankFitResult first, const StartSearch& search, const Progress& progress);

}  // namespace flank::internal
