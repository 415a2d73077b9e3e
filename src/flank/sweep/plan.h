/// The plan of a sweep (docs/schema/sweep.md): faces, tools and variants of options, each combination a job of its own.
#pragma once

#include <string>
#include <vector>

#include "flank/job.h"

namespace flank::internal {

/// One job of a sweep.
struct SweepTask {
  std::string face, tool, variant;
  std::string name;                 ///< of its folder, unique in the sweep: "F1-2-fine"
  std::vector<std::string> words;   ///< of the command that does it, without -o
  std::vector<std::string> inputs;  ///< files and folders that it reads beside the part
};

struct SweepPlan {
  std::string file;         ///< as it was given
  std::string command;      ///< "fit" or "cover"
  std::string part;         ///< file, absolute
  std::string part_sha256;  ///< of its bytes
  std::vector<std::string> faces, tools, variants;
  int retries = 0;               ///< how often a task that failed or took too long is begun again
  double timeout_s = 0.0;        ///< of an attempt; 0: none
  std::vector<SweepTask> tasks;  ///< faces, then tools, then variants, in the plan's order

  /// Where files of the plan are looked for: its own folder, absolute.
  [[nodiscard]] std::string folder() const;
};

/// Reads a plan and its part, and checks every job of it, so that nothing that would be refused is begun. Throws
/// InputError naming file, line and column: no TOML, an unknown key, a face that the part has not, a tool that is none, an
/// option that the command has not or does not take.
[[nodiscard]] SweepPlan read_plan(const std::string& file);

}  // namespace flank::internal
