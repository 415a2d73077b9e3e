/// What came out of a design: tools, every tool on every face, and the set that was chosen.
#pragma once

#include <string>
#include <vector>

#include "flank/design/choose_tools.h"
#include "flank/design/equal_faces.h"
#include "flank/job/design_job.h"
#include "flank/sweep/task_batch.h"
#include "flank/tool.h"

namespace flank::internal {

/// A tool that may be in the set.
struct DesignTool {
  std::string name;                 ///< "T1"
  std::string source;               ///< "fit of F1,F3", or "catalogue NAME"
  std::string file;                 ///< in the folder of the design
  std::string folder;               ///< of the fit that found it; empty: of a catalogue
  std::vector<std::size_t> fitted;  ///< faces of that fit, by their places in the list
  Tool tool;
};

/// How a tool machines a face, as the judge has it.
struct DesignPair {
  TaskRow row;
  std::string folder;  ///< of the result; empty: there is none
  std::string way;     ///< "fit", "cover", "motion", or "as F1": the path of an equal face, moved
  double coverage_reachable = 0.0, coverage = 0.0, overcut_mm = 0.0, other_faces_overcut_mm = 0.0;
  int strips = 0;
  double minutes = 0.0;  ///< strips at the feed, links at the rapid rate
  [[nodiscard]] bool finishes() const { return row.status == TaskStatus::kMeets; }
};

struct DesignResult {
  DesignJob job;
  std::string part_sha256;
  double reach_radius_mm = 0.0;
  std::vector<std::string> faces;  ///< in the order of the job
  std::vector<EqualFace> equal;    ///< of each face
  std::vector<DesignTool> tools;
  std::vector<DesignPair> pairs;  ///< of tool t on face f at t * faces + f
  ToolSet choice;
  bool complete = true;  ///< false: stopped before everything was judged
  [[nodiscard]] const DesignPair& pair(std::size_t tool, std::size_t face) const {
    return pairs[tool * faces.size() + face];
  }
  [[nodiscard]] bool pass() const { return complete && choice.unfinished == 0; }
};

/// Machining time of a path, minutes: the mean way of both ends of the axis along strips at the feed, the straight ways
/// between strips at the rapid rate; no lead-in and no retract. `axis_length_mm`: of the tool; rates in mm/min.
[[nodiscard]] double path_minutes(const Path& path, double axis_length_mm, const ChoiceRequest& rates);

}  // namespace flank::internal
