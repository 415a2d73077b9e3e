/// What a tool must not enter at one target: other faces of the part, and fixtures.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flank/obstacles.h"
#include "flank/part.h"

namespace flank::internal {

/// What is in the way, as the user says it.
struct ObstacleChoice {
  std::vector<int> own;                ///< indices of the target's faces
  std::vector<int> others;             ///< ascending: faces that must not be entered, other targets among them
  std::span<const Part> fixtures;      ///< not owned
  std::optional<double> clearance_mm;  ///< --clearance: all of the tool from fixtures, shank and holder from `others`
  double tolerance_mm = 0.01;          ///< of the job: how deep the judge lets a tool go if no clearance is given
  double allowance_mm = 0.0;           ///< left on every face of the part, not on fixtures
};

/// How much of it a planner looks at, and in which form. Forms that are not wanted cost nothing.
struct ObstacleDetail {
  std::optional<double> faces_within_mm;   ///< as surfaces, if their box is this near to the target
  std::optional<double> meshes_within_mm;  ///< as triangles and solids, if they are this near
  double deviation_mm = 0.01;              ///< of the triangles
  /// Given if the tool has a shank or holder: the target as triangles as well, of this deviation, for these, with
  /// `own_spare_mm` held back besides, for a judge who wants it kept for sure.
  std::optional<double> own_deviation_mm;
  double own_spare_mm = 0.0;
};

/// For the target `own`, one of `targets`: the faces to check and the other targets.
[[nodiscard]] ObstacleChoice choose_obstacles(const std::vector<int>& own, const std::vector<int>& targets,
                                              const std::vector<int>& checks);

/// The obstacles at `target`; those of a mesh are its triangles.
[[nodiscard]] Obstacles make_obstacles(const Part& part, const Target& target, const ObstacleChoice& choice,
                                       const ObstacleDetail& detail);

/// Reads fixtures; `unit` is that of meshes, whose files say none. Throws InputError as read_part does.
[[nodiscard]] std::vector<Part> read_fixtures(const std::vector<std::string>& files,
                                              const std::optional<std::string>& unit);

}  // namespace flank::internal
