/// Every candidate on every face.
#pragma once

#include "flank/design/candidates.h"

namespace flank::internal {

/// Fills `pairs` of the tools from `first_tool` on: each on each face, by the path of the fit that found it if that
/// finishes the face, else by a cover with it, else by a fit of the motion alone. Of equal faces only one is planned so,
/// that which the tool was fitted to; the others have its path, moved, and where that does not finish them a fit of the
/// motion from there, one from anywhere, and a cover of their own. All are judged where they are. Needs `tools` and all
/// before.
void judge_pairs(DesignResult& result, const DesignFolder& folder, std::size_t first_tool);

}  // namespace flank::internal
