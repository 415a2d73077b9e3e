/// What a folder of results was made for, with what is asked for now.
#pragma once

#include <string>

#include "flank/job.h"
#include "flank/manifest/result_folder.h"
#include "flank/tool.h"

namespace flank::internal {

struct FolderJob {
  PlanJob job;             ///< of job.json, files followed where they moved with the folder, and the request's changes
  std::string named_part;  ///< the part, as job.json has it
};

/// Throws InputError where there is no job.json, or none that can be read.
[[nodiscard]] FolderJob read_folder_job(const VerifyJob& request, const ResultFolder& folder);

/// A tool's file with shank and holder as `asked`; `merged` is the job's with that in its place.
[[nodiscard]] Tool read_and_equip(const std::string& file, const ObstacleRequest& asked, const ObstacleRequest& merged);

}  // namespace flank::internal
