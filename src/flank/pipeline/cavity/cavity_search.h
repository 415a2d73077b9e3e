/// The search for a cavity's tool, side paths and program: from thick tools to thin ones.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "flank/pipeline/cavity/cavity_faces.h"
#include "flank/trochoid/program.h"
#include "flank/trochoid/sides/side_fit.h"

namespace flank::internal {

/// What the judge finds of a program.
struct CavityFinding {
  bool meets = false;    ///< all that is asked
  double covered = 0.0;  ///< of what is reachable
  int number = 0;        ///< of the judge's, to find it again
};

struct CavityPlan {
  SideFit sides;                         ///< no motions: no start was free
  CavityProgram program;                 ///< none if the tool is not legitimate
  double largest_radius_mm = 0.0;        ///< the bound under which the tool was found
  int tools = 0;                         ///< bounds that were tried
  std::optional<CavityFinding> finding;  ///< none: its cycles do not get through, or nobody judged it
};

/// Judges a plan whose cycles get through; none where it was stopped. Estimates of what is covered are a percent off beside walls,
/// where what is reachable ends, so they do not say whether the verdict will be met.
using CavityJudge = std::function<std::optional<CavityFinding>(const CavityPlan&)>;

/// Bounds of the radius that are tried, mm, from thick to thin: a thick tool makes a short path. The narrowest place has room for
/// one of them; where most of the cavity is much wider, thicker ones come first, unless the job has a bound: a tool that is
/// thin at one end may have the room of most places at the other. None below the least radius that is asked for.
[[nodiscard]] std::vector<double> bounds_of(const TrochoidJob& job, const CavityWidth& width);

/// What a free tool begins with under a bound of its radius: all but as thick as that. A cylinder that is thicker than most of the tool
/// will be stays against the bound between walls that bulge, whose tool has a waist: where little is covered so, a thinner one begins. `tip_mm`: of a
/// cone to begin with, where a cylinder leaves too much of what is to be reached.
[[nodiscard]] std::vector<RadiusStart> starts_under(double bound_mm, double least_mm,
                                                    const std::optional<double>& tip_mm = {});

/// How many layers are tried after so many, which cover less than is asked for. Of a band what a straight line leaves goes with the
/// square of its height: with twice as many layers what is now within four tolerances may be finished, and other shares lie between
/// and beyond.
[[nodiscard]] int layers_after(int layers, const CoverageEstimate& found, double asked);

/// What a plan is measured by.
struct CavityDemand {
  const TrochoidJob& job;  ///< with a tolerance
  const CavityFaces& faces;
};

/// Whether sides cut and enter nothing and cover the share that is asked for of what a ball of the tool's least radius reaches, or all
/// but what other faces keep from a tool of these radii: no other fit mends that.
[[nodiscard]] bool fills_reach(const SideFit& sides, const CavityDemand& demand);

/// Whether sides are so far from what is asked, too deep in a face or with most of their way uncovered, that no cycles make up for it.
[[nodiscard]] bool is_hopeless(const SideFit& sides, const CavityDemand& demand);

/// Whether the judge finds all that is asked. Where nobody has judged it, whether cycles get through, enter nothing, and the verdict
/// may be expected to find the share that is asked for: of what a ball of the least radius reaches. Some of that a tool that is thicker
/// elsewhere leaves beside a wall, and cycles what no step there keeps the limit for: a thinner one may get nearer.
[[nodiscard]] bool meets(const CavityPlan& plan, const CavityDemand& demand);

/// The greater one is better. In this order: the judge finds all that is asked; there are sides; cycles get through and enter
/// nothing; they get through; what is covered as far as they got, in thousandths; how deep anything is cut beyond the tolerance, in steps
/// of a fifth; whether the sides fill what the tool reaches; the score of the sides, in steps of 0.002.
using CavityRank = std::tuple<bool, bool, bool, bool, int, int, bool, int>;
[[nodiscard]] CavityRank rank(const CavityPlan& plan, const CavityDemand& demand);

/// Whether all that is missing is what the tool's thin end would reach beside other faces and its thicker one does not: a tool as thick at
/// that end as at the other is asked for no more than it reaches, and is stiffer.
[[nodiscard]] bool wants_even_tool(const CavityPlan& plan, const CavityDemand& demand);

/// Whether cycles got stuck for what is not the radius': where the sides lead along the axis, or before any of them reached the sides,
/// though the tool has a way across there (cycles of one that hardly has, or leaves too much of the sides, are not looked for while there
/// is a thinner one). No other tool, no other lean and no longer search is then tried. Of a tool that is the last, or given, only the former
/// says so: it may hardly have a way across.
[[nodiscard]] bool ends_search(const CavityProgram& program, bool thinner);

/// Why a plan has no cycles: its sides are hopeless, its tool has hardly a way across, or the search ended before it got so far.
enum class NoCycles : std::uint8_t { kFarOff, kNarrow, kEnded };
struct WhyNoCycles {
  NoCycles why = NoCycles::kEnded;
  double way_across = 0.0;  ///< where it is shortest, in diameters of the tool
  int tools = 0;            ///< whose sides were looked for
};
[[nodiscard]] WhyNoCycles why_no_cycles(const CavityPlan& plan, const CavityDemand& demand);

/// Thinner tools are slower, too: whether no more are tried after so many in a row that gained nothing. One may be unlucky where
/// the cycles of the best got stuck; where they got `through`, none is.
[[nodiscard]] bool is_in_vain(int in_a_row, bool through);

/// The first tool whose plan meets the demand; if there is none, the best by its rank. The search ends where thinner bounds gain nothing. A
/// tool that is given is tried alone. Sides that are hopeless get no cycles.
[[nodiscard]] CavityPlan search_cavity(const TrochoidJob& job, const CavityFaces& faces, const ToolModel& tool,
                                       const SideFitOptions& options, const CavityJudge& judge,
                                       const Progress& progress);

}  // namespace flank::internal
