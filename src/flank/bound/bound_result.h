/// What `flank bound` found out.
#pragma once

#include <string>
#include <vector>

#include "flank/bound/contact/contact_map.h"
#include "flank/job/bound_job.h"
#include "flank/tool.h"

namespace flank::internal {

/// One target: faces that are joined.
struct BoundTarget {
  std::string faces;
  double diagonal_mm = 0.0;
  ContactMap map;
};

struct BoundResult {
  BoundJob job;  ///< with the tolerance that was used
  std::string part_sha256;
  Tool tool;
  std::vector<BoundTarget> targets;
  std::vector<std::string> notes;
  double seconds = 0.0;
  [[nodiscard]] bool complete() const;
  /// Some of a face is proved to be out of the tool's reach.
  [[nodiscard]] bool blocked() const;
};

/// bound.json (docs/schema/bound.md).
[[nodiscard]] std::string bound_json(const BoundResult& result);
/// A few lines for people.
[[nodiscard]] std::string bound_text(const BoundResult& result);

}  // namespace flank::internal
