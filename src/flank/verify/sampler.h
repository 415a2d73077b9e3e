/// The judge's samples of a face in tiles of bounded size, so that fine samples of a large face need no more memory than
/// coarse ones.
#pragma once

#include <cstddef>
#include <span>

#include "flank/judge.h"

namespace flank::internal::verify {

/// Made by make_sampler: of a trimmed face (sample_face.h) or of a mesh (sample_mesh.h).
class Sampler {
 public:
  virtual ~Sampler() = default;
  [[nodiscard]] virtual std::size_t tiles() const = 0;
  /// The samples of one tile; all tiles in their order are sample_face's or sample_mesh's.
  [[nodiscard]] virtual FaceSamples tile(std::size_t k) const = 0;
  /// The cells of these of a tile's samples, each cut into kCut^2 of its shape, as samples; the normals as of a tile.
  [[nodiscard]] virtual FaceSamples cut(const FaceSamples& samples, std::span<const std::size_t> which) const = 0;
  static constexpr int kCut = 4;
  /// About how many samples there are in all; a cell on the border may count although none is in it.
  [[nodiscard]] virtual double count() const = 0;
  /// Diagonal of a box about the face, mm, about.
  [[nodiscard]] virtual double size_mm() const = 0;
};

}  // namespace flank::internal::verify
