/// The judge's samples of a trimmed face (flank/judge.h: sample_face), tile by tile.
#pragma once

#include <cstddef>
#include <memory>

#include "flank/face.h"
#include "flank/verify/sampler.h"

namespace flank::internal::verify {

/// Rows of cells, as many in a tile as hold about `most_samples` (at least one row). The face must outlive the sampler.
/// Throws as sample_face.
[[nodiscard]] std::unique_ptr<Sampler> make_sampler(const Face& face, double spacing_mm, bool target,
                                                    std::size_t most_samples);

}  // namespace flank::internal::verify
