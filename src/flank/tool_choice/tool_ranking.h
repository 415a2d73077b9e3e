/// Given tools, ranked for a surface: how much of it each finishes, in how many strips and in what time
/// (docs/algorithms/catalogue.md).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "flank/base/step_codec.h"
#include "flank/cover.h"
#include "flank/progress.h"
#include "flank/tool_choice/tool_screen.h"

namespace flank::internal {

/// What is to be machined, and what is in the tool's way there. Both must outlive the call; neither may be null.
struct RankingTarget {
  const Target* target = nullptr;
  const Obstacles* obstacles = nullptr;
};

/// What machining time is reckoned with. It breaks ties between tools only, so the ratio of the two matters more than
/// the values. Set them to those of the machine and the material.
struct MachiningRates {
  double feed_mm_min = 1000.0;   ///< mm/min, > 0: along a strip, of the mean of both ends of the axis
  double rapid_mm_min = 5000.0;  ///< mm/min, > 0: along links
};

struct RankingOptions {
  CoverOptions cover;  ///< of the full covers; the stages before them take fewer seeds and do not smooth
  MachiningRates rates;
  /// Tools that get a full cover, >= 1. The time of a ranking is mostly theirs. 3 had the best three of 37 tools; raise
  /// it if the first ones of a ranking are close.
  int finalists = 3;
  /// Seeds of the first round: places, and directions of the grid where no admissible one leads on; >= 1. About half of
  /// what a cover has (CoverOptions), since this round only has to find the better half.
  int quick_places = 16;
  int quick_directions = 8;
  /// Places of each target at which tools are screened, >= 1. Raise it for targets with small hollows: the screen sees
  /// one place in so many of the area.
  int screen_places = 150;
  /// cover(), unless a caller has another way to find strips. Called from several threads at once.
  std::function<CoverResult(const Target&, const Tool&, const Obstacles&, const CoverOptions&, const Progress&)>
      cover_with = flank::cover;
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
  ToolScreen screen;                 ///< shares of all targets together
  std::vector<CoverResult> results;  ///< one per target
  double reachable = 0.0;            ///< share of the area of all targets, in [0, 1]
  double coverage = 0.0;             ///< share of that, in [0, 1], by the planner's own estimate
  int strips = 0;
  double strips_mm = 0.0, links_mm = 0.0;  ///< travel, as strip_length and link_length have it
  double minutes = 0.0;                    ///< at the rates; no lead-in and no retract
  std::string reason;                      ///< why it cannot work; empty for a tool that covers something, or may
  [[nodiscard]] double covered() const { return reachable * coverage; }  ///< share of all
};

/// Among the values of a finished step (base/step_codec.h), as cover_stage returns it: without index and screen.
void code(StepCodec& codec, RankedTool& ranked);

/// Travel of the axis along a motion, mm: the mean of its two ends, by 200 chords.
[[nodiscard]] double strip_length(const RuledMotion& motion);

/// Best first, sorted by (1) the stage reached (a full cover before a quick one), (2) ranking_value, rounded to steps
/// of one strip price, so that smaller differences tie, (3) machining time, (4) the order in which they were given.
/// Tools with a reason come last, those that are nearest to working first.
///
/// Screens every tool, covers those that may work with few seeds and without smoothing, the better half of them with
/// all seeds, and the best `finalists` in full: successive halving. Same result for any number of threads. A ranking
/// that is cancelled has what it got to.
[[nodiscard]] std::vector<RankedTool> rank_tools(std::span<const RankingTarget> targets, std::span<const Tool> tools,
                                                 const RankingOptions& options, const Progress& progress);

/// One tool covered as a stage of rank_tools does it, for searches over tools. kFull smooths if the cover's options say
/// so. The result has no index and no screen.
[[nodiscard]] RankedTool cover_stage(std::span<const RankingTarget> targets, const Tool& tool, RankingStage stage,
                                     const RankingOptions& options, const Progress& progress);
/// Covered share of all targets minus the price of the strips: what rankings sort by. May be negative.
[[nodiscard]] double ranking_value(const RankedTool& ranked, const RankingOptions& options);

}  // namespace flank::internal
