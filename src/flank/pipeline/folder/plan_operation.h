/// One operation of a program before it is posted: a folder's tool and path, with the links around its strips.
#pragma once

#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/machine/post.h"
#include "flank/pipeline/folder/judged_links.h"
#include "flank/pipeline/program/operation_words.h"
#include "flank/run.h"
#include "flank/setup/setup.h"
#include "flank/tool.h"

namespace flank::internal {

struct PlannedOperation {
  PostJob request;            ///< of this folder alone, with the spindle and the feed that its material gives
  std::string name;           ///< for people
  int copies = 1;             ///< how often it is run, turned
  std::string judged_in;      ///< the folder whose verdict holds for it: its own, or that of its wheel
  bool tells_verdict = true;  ///< of a wheel's operations the first one does for all
  int tool_number = 1;
  Setup setup;
  Tool tool;
  std::string tool_text;  ///< tool.json
  PostTool facts;
  std::size_t strips = 0;  ///< of the path
  ObstacleRequest obstacles;
  double feed = 0.0;  ///< mm/s, where nothing is known of the load
  LinkOptions way;    ///< of the links
  JudgedLinks links;  ///< known of them: the least time for a mm, s
  std::vector<std::string> notes;
};

/// What an operation is called unless its words say it: the folder's own name, else the part's.
[[nodiscard]] std::string operation_name(const std::string& folder, const Setup& setup);

/// Throws UsageError unless spindle and feed are given, or a material that gives them, or a dry run is asked for.
void require_cutting_data(const PostJob& request);

/// Reads the folder of `request` and plans its links. Throws UsageError where spindle and feed are not known, InputError for a folder
/// that is none.
[[nodiscard]] PlannedOperation plan_operation(const PostJob& request, const OperationWords& words);

}  // namespace flank::internal
