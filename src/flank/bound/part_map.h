/// `flank bound --map`: every face of a part by what is proved of it, as a page and as data (docs/schema/bound.md).
#pragma once

#include <string>
#include <vector>

#include "flank/job/bound_job.h"
#include "flank/part.h"
#include "flank/progress.h"
#include "flank/tool.h"

namespace flank::internal {

/// What the proofs leave open: they say what a tool cannot do, never that it can.
enum class MappedKind {
  kOnePass,        ///< nothing proves that one pass is too few
  kSeveralPasses,  ///< at least two passes
  kNotByFlank,     ///< half of the face is out of reach, or it takes at least kMostFlankPasses
  kNotExamined,    ///< not read, or the run was stopped before
};
inline constexpr int kMostFlankPasses = 12;

struct MappedFace {
  int index = 0;
  std::string id;
  MappedKind kind = MappedKind::kNotExamined;
  double area_mm2 = 0.0, not_finished_mm2 = 0.0;
  double longest_mm = 0.0;  ///< of the contacts, by the bounds
  int least_passes = 0, points = 0;
};

struct PartMap {
  BoundJob job;  ///< with the tolerance that was used
  Part part;
  Tool tool;
  std::vector<MappedFace> faces;  ///< in the order of the part
  std::vector<std::string> notes;
  bool complete = true;
};

/// "one pass", "several passes", "not by flank", "not examined".
[[nodiscard]] std::string kind_name(MappedKind kind);

/// Every face by itself, all others in its way. About job.points points for the whole part. Throws as run_bound.
[[nodiscard]] PartMap run_part_map(const BoundJob& job, const Progress& progress);

/// map.json and a few lines for people.
[[nodiscard]] std::string map_json(const PartMap& map);
[[nodiscard]] std::string map_text(const PartMap& map);
/// map.json, map.txt and, where the page is built, map.html.
void write_part_map(const PartMap& map, const std::string& folder);

}  // namespace flank::internal
