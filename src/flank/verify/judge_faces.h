/// The judge over faces whose samples come in tiles.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/judge.h"

namespace flank::internal::verify {

/// One face that is judged.
struct JudgedFace {
  std::string face;
  bool target = false;
  double size_mm = 0.0;  ///< diagonal of a box about it, about
  std::size_t tiles = 1;
  /// Calls its argument with the samples of a tile, with their reachable shares.
  std::function<void(std::size_t tile, const std::function<void(const FaceSamples&)>& use)> samples;
  const FaceShape* shape = nullptr;  ///< null: not known, so nothing is proved
};

/// judge() of flank/judge.h. Where the targets are measured to be covered by `least_coverage` of what is reachable, and not
/// proved to be, and the verdict hangs on that alone, the proof of coverage goes on, finer.
[[nodiscard]] VerifyReport judge_faces(const Tool& tool, const Path& path, const std::vector<JudgedFace>& faces,
                                       const JudgeOptions& options, double least_coverage = 0.0);

}  // namespace flank::internal::verify
