/// The search for a cavity's tool, side paths and program: from thick tools to thin ones.
#pragma once

#include <functional>
#include <optional>
#include <string>
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
/// will be stays against the bound between walls that bulge, whose tool has a waist: where little is covered so, a thinner one begins.
[[nodiscard]] std::vector<RadiusStart> starts_under(double bound_mm, double least_mm);

/// Are sides so much better than others, a score of 0.002, that more layers or another lean are worth it? What no fit mends any
/// more is a gain on what falls short, however little more it covers: less may be in reach of its tool.
[[nodiscard]] bool is_gain(const SideFit& sides, const SideFit& other, const CavityFaces& faces,
                           const TrochoidJob& job);

/// How many layers are tried after so many, which cover less than is asked for. Of a band what a straight line leaves goes with the
/// square of its height: with twice as many layers what is now within four tolerances may be finished, and other shares lie between
/// and beyond.
[[nodiscard]] int layers_after(int layers, const CoverageEstimate& found, double asked);

/// Whether the judge finds all that is asked. Where nobody has judged it, whether cycles get through, enter nothing, and the verdict
/// may be expected to find the share that is asked for: of what a ball of the least radius reaches. Some of that a tool that is thicker elsewhere leaves beside a wall, and cycles what no step there keeps the limit
/// for: a thinner one may get nearer.
[[nodiscard]] bool is_done(const CavityPlan& plan, const CavityFaces& faces, const TrochoidJob& job);

/// What is better comes first: cycles that get through, then what they let the sides cover, then what enters faces less
/// deep, if both have cycles, then sides.
[[nodiscard]] bool is_better(const CavityPlan& a, const CavityPlan& b, double tolerance);

/// Whether all that is missing is what the tool's thin end would reach beside other faces and its thicker one does not: a tool as thick at
/// that end as at the other is asked for no more than it reaches, and is stiffer.
[[nodiscard]] bool wants_even_tool(const CavityPlan& plan, const CavityFaces& faces, const TrochoidJob& job);

/// Whether cycles got stuck for what is not the radius': where the sides lead along the axis, or before any of them reached the sides,
/// though the tool has a way across there (cycles of one that hardly has, or leaves too much of the sides, are not looked for while there
/// is a thinner one). No other tool, no other lean and no longer search is then tried. Of a tool that is the last, or given, only the former
/// says so: it may hardly have a way across.
[[nodiscard]] bool ends_search(const CavityProgram& program, bool thinner);

/// How long thinner tools are tried, which are slower, too.
class SearchPatience {
 public:
  /// After a tool that is the best so far, or is not. Ends at the first that gains nothing once the cycles of the best get
  /// `through`, and at the second in a row where they get stuck.
  [[nodiscard]] bool ends_after(bool gained, bool through);

 private:
  int in_vain_ = 0;
};

/// The first tool whose sides are done and whose cycles get through and enter nothing; if there is none, the one whose cycles
/// get through and whose sides are best; else the one that gets farthest. The search ends where thinner bounds gain
/// nothing (SearchPatience). A tool that is given is tried alone.
[[nodiscard]] CavityPlan search_cavity(const TrochoidJob& job, const CavityFaces& faces, const ToolModel& tool,
                                       const SideFitOptions& options, const CavityJudge& judge,
                                       const Progress& progress);

}  // namespace flank::internal
