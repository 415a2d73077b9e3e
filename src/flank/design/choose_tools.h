/// Which few of many tools: the set that finishes most faces, and of these sets the fastest. Exact.
#pragma once

#include <limits>
#include <vector>

namespace flank::internal {

/// A tool does not finish a face.
inline constexpr double kNeverFinishes = std::numeric_limits<double>::infinity();

struct SetProblem {
  int tools = 0, faces = 0;
  std::vector<double> minutes;  ///< of tool t on face f at t * faces + f: >= 0, or kNeverFinishes
  double tool_minutes = 0.0;    ///< that each tool of the set costs, >= 0
  [[nodiscard]] double at(int tool, int face) const { return minutes[static_cast<std::size_t>(tool * faces + face)]; }
};

struct ToolSet {
  std::vector<int> tools;         ///< ascending; each finishes at least one face
  std::vector<int> tool_of_face;  ///< the fastest of them, -1: none finishes it
  int unfinished = 0;             ///< faces that none of them finishes
  double minutes = 0.0;           ///< of all faces that are finished, and of the tools
};

/// The set of at most `most` tools that leaves the fewest faces unfinished and takes the least time among these: the
/// p-median problem with a price per tool, by branch and bound. Bounds are Lagrangian (each face by one tool is relaxed;
/// Cornuejols, Fisher and Nemhauser 1977), so that tens of tools for tens of faces take a fraction of a second, as a rule.
/// Proved to a billionth of the objective. Throws InternalError for times below 0 or not a number.
[[nodiscard]] ToolSet choose_tools(const SetProblem& problem, int most);

/// The same with the fewest tools that leave as few faces unfinished as all tools together.
[[nodiscard]] ToolSet choose_fewest(const SetProblem& problem);

}  // namespace flank::internal
