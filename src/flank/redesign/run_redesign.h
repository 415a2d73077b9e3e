/// `flank redesign`: the nearest surface that is exactly millable (docs/algorithms/redesign.md).
#pragma once

#include <string>

#include "flank/progress.h"
#include "flank/redesign/redesign.h"

namespace flank::internal {

/// Searches a tool and motions, makes their envelope nearest to the faces, and puts it in their place. The new part is written to `output`,
/// which is made, to be checked as other programs will read it. Throws UsageError and InputError before any work is done, Stopped
/// without a result.
[[nodiscard]] Redesign run_redesign(const RedesignJob& job, const std::string& output, const Progress& progress);

/// The result, and redesign.json, redesign.txt, deviation.csv, sections.csv, face.step and guide.txt beside it; report.html where the page is
/// built.
void write_redesign(const Redesign& redesign, const std::string& output);

}  // namespace flank::internal
