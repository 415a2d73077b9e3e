/// Given tools, ranked for a surface: how much of it each finishes, in how many strips and in what time
/// (docs/algorithms/catalogue.md).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "flank/choose/tool_screen.h"
#include "flank/cover/cover.h"
#include "flank/progress.h"

namespace flank::internal {

/// One side of a target and what is in the tool's way there.
struct RankingSide {
  const Target* target = nullptr;
  const CoverObstacles* obstacles = nullptr;
};
/// What is to be machined: one side, or the better of two (an open sheet).
using RankingTarget = std::vector<RankingSide>;

struct MachiningRates {
  double feed_mm_min = 1000.0;   ///< of the contact along a strip
  double rapid_mm_min = 5000.0;  ///< along links
};

struct RankingOptions {
  CoverOptions cover;  ///< of the full covers
  MachiningRates rates;
  int finalists = 3;      ///< tools that get a full cover
  int quick_places = 16;  ///< seeds of the first round: places and directions of the grid
  int quick_directions = 8;
  int screen_places = 150;
  /// cover(), unless a caller has another way to find strips.
  std::function<CoverResult(const Target&, const Tool&, const CoverObstacles&, const CoverOptions&, const Progress&)>
      cover_with = flank::internal::cover;
};

/// The farthest that a tool came.
enum class RankingStage {
  kScreened,  ///< no strip was tried: it cannot work, or the ranking was interrupted
  kQuick,     ///< few seeds, strips as they grew
  kThorough,  ///< all seeds, strips as they grew
  kFull       ///< smoothed: the strips that would be milled
};

struct RankedTool {
  std::size_t tool = 0;  ///< index into the tools that were given
  RankingStage stage = RankingStage::kScreened;
  ToolScreen screen;                 ///< shares of all targets together; the better side of each
  std::vector<CoverResult> results;  ///< one a target
  std::vector<std::size_t> side;     ///< of each target
  double reachable = 0.0;            ///< share of the area of all targets
  double coverage = 0.0;             ///< share of that
  int strips = 0;
  double strips_mm = 0.0, links_mm = 0.0;  ///< ways of the mean of both ends of the axis
  double minutes = 0.0;
  std::string reason;  ///< why it cannot work; empty for a tool that covers something, or may
  [[nodiscard]] double covered() const { return reachable * coverage; }  ///< share of all
};

/// Way of the axis along a motion, mm: the mean of both of its ends (as link_length).
[[nodiscard]] double strip_length(const RuledMotion& motion);

/// Best first, in this order: those that came farthest (a full cover before a quick one); most covered share of all
/// targets, less the price of the strips, in steps of that price: less than a strip is worth is no difference; shortest
/// time; the order in which they were given. Tools with a reason come last, those that are nearest to working first.
///
/// Screens every tool, covers those that may work with few seeds and without smoothing, the better half of them with all
/// seeds, and the best `finalists` in full: successive halving. Same result for any number of threads. A ranking that is
/// cancelled has what it got to.
[[nodiscard]] std::vector<RankedTool> rank_tools(std::span<const RankingTarget> targets, std::span<const Tool> tools,
                                                 const RankingOptions& options, const Progress& progress);

/// What rank_tools is made of, for a search over tools: one tool, covered as a stage does it.
[[nodiscard]] RankedTool cover_stage(std::span<const RankingTarget> targets, const Tool& tool, RankingStage stage,
                                     const RankingOptions& options, const Progress& progress);
/// Covered share less the price of the strips.
[[nodiscard]] double ranking_value(const RankedTool& ranked, const RankingOptions& options);

}  // namespace flank::internal
