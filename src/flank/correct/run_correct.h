/// `flank correct`: a new motion from what was measured of the tool or of the face (docs/algorithms/correct.md).
#pragma once

#include <string>

#include "flank/correct/correction.h"
#include "flank/progress.h"

namespace flank::internal {

/// Measures, and fits the new motion. Files that the new job reads (the tool as ground, the mirrored face, a guide) are written to `output`, which
/// is made, once nothing is left to be refused. Throws UsageError and InputError.
[[nodiscard]] Correction run_correct(const CorrectJob& job, const std::string& output, const Progress& progress);

/// The result, and correct.json and correct.txt beside it.
void write_correction(const Correction& correction, const std::string& output);

}  // namespace flank::internal
