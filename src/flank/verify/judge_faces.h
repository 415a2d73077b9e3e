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
  /// Calls its last argument with the samples of a tile, with their reachable shares. `fine`: where the border of what is reachable
  /// runs, of cells that are a part of the others' size.
  std::function<void(std::size_t tile, bool fine, const std::function<void(const FaceSamples&)>& use)> samples;
  const FaceShape* shape = nullptr;  ///< null: not known, so nothing is proved
  int copies = 1;                    ///< as FaceVerdict's
};

/// The shares of the targets' area, of what is reachable and of the whole, that are asked for; 0: none.
struct LeastCoverage {
  double reachable = 0.0, whole = 0.0;
};

/// judge() of flank/judge.h. Where the targets are measured to be covered by `least` and not proved to be, and the verdict hangs on that
/// alone, the proof of coverage goes on, finer. Where they are measured to be covered by less, one finer look says how much of that is
/// proved. Where it may hang on the cells that are reachable in part, these are cut first.
[[nodiscard]] VerifyReport judge_faces(const Tool& tool, const Path& path, const std::vector<JudgedFace>& faces,
                                       const JudgeOptions& options, const LeastCoverage& least = {});

}  // namespace flank::internal::verify
