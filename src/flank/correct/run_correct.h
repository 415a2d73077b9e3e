/// `flank correct`: a new motion from what was measured of the tool or of the face (docs/algorithms/correct.md).
#pragma once

#include <optional>
#include <string>

#include "flank/correct/correction.h"
#include "flank/progress.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// The faces that are neither machined nor checked, as F2,F5; none if there are none. The mirrored part is sheets: a solid that the job
/// names is none there, but its faces keep their numbers.
[[nodiscard]] std::optional<std::string> faces_not_checked(const Setup& setup);

/// Measures, and fits the new motion. Files that the new job reads (the tool as ground, the mirrored face, a guide) are written to `output`, which
/// is made, once nothing is left to be refused. Throws UsageError and InputError.
[[nodiscard]] Correction run_correct(const CorrectJob& job, const std::string& output, const Progress& progress);

/// The result, and correct.json and correct.txt beside it.
void write_correction(const Correction& correction, const std::string& output);

}  // namespace flank::internal
