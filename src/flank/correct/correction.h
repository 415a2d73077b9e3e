/// What a correction found and made, as files (docs/schema/correct.md).
#pragma once

#include <optional>
#include <string>

#include "flank/correct/measure/face_error.h"
#include "flank/correct/measure/ground_tool.h"
#include "flank/job/correct_job.h"
#include "flank/run.h"

namespace flank::internal {

struct Correction {
  CorrectJob job;
  double tolerance_mm = 0.0;
  std::optional<GroundTool> ground;
  std::optional<FaceError> error;
  /// As ground: the tool as ground on the old motion. As cut: the new motion against the nominal face, which it leaves on purpose.
  VerifyReport other;
  Result result;  ///< the new motion; as cut: judged against the mirrored face
};

/// correct.json (docs/schema/correct.md), and a few lines for people.
[[nodiscard]] std::string correction_json(const Correction& correction);
[[nodiscard]] std::string correction_text(const Correction& correction);

}  // namespace flank::internal
