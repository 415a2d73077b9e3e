/// Whether the rapid moves of a program keep off the material.
#pragma once

#include <string>

#include "flank/job.h"
#include "flank/machine/backplot.h"
#include "flank/run.h"
#include "flank/setup/setup.h"
#include "flank/tool.h"

namespace flank::internal {

/// What a rapid keeps off faces and fixtures at least, mm; and the tolerance, where that is more. What is nearer has cut, or is
/// cutting.
inline constexpr double kRapidRoomMm = 0.1;

/// The rapid moves of a program: strips of their poses, and the line of each of these.
struct RapidMoves {
  Path path;
  std::vector<std::vector<std::int32_t>> lines;
};
[[nodiscard]] RapidMoves rapid_moves(const Backplot& plot);

/// Adds each body of the tool that comes too near to the judged faces or to a fixture on a rapid move, by `file` and line, where
/// that happens first; by the judge's own distances, between the poses too.
void accept_rapids(const std::string& file, const Setup& setup, const ObstacleRequest& obstacles, const Tool& tool,
                   const Backplot& plot, Acceptance& acceptance);

}  // namespace flank::internal
