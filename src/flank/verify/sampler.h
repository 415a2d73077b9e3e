/// The judge's samples of a face in tiles of bounded size, so that fine samples of a large face need no more memory than
/// coarse ones.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "flank/judge.h"

namespace flank::internal::verify {

class Sampler {
 public:
  virtual ~Sampler() = default;
  [[nodiscard]] virtual std::size_t tiles() const = 0;
  /// The samples of one tile; all tiles in their order are sample_face's or sample_mesh's.
  [[nodiscard]] virtual FaceSamples tile(std::size_t k) const = 0;
  /// About how many samples there are in all; a cell on the border may count although none is in it.
  [[nodiscard]] virtual double count() const = 0;
  /// Diagonal of a box about the face, mm, about.
  [[nodiscard]] virtual double size_mm() const = 0;
};

/// Tiles of about `most_samples` (at least a row of cells). Face and mesh must outlive the sampler. Throw as sample_face.
[[nodiscard]] std::unique_ptr<Sampler> make_sampler(const Face& face, double spacing_mm, bool target,
                                                    std::size_t most_samples);
[[nodiscard]] std::unique_ptr<Sampler> make_sampler(const std::string& id, const TriangleMesh& mesh, double spacing_mm,
                                                    bool target, std::size_t most_samples);

}  // namespace flank::internal::verify
